#include "sigmascape/bake/buildings_of.h"

#include <cmath>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/surface_sigma0.h"
#include "sigmascape/scene/building_extrusion.h"
#include "sigmascape/scene/imported_mesh.h"

namespace sigmascape::bake {
namespace {

scene::Scene house_on_a_hill() {
  scene::Scene scene;
  scene.name = "house";
  scene.extent = {-64.0, -64.0, 64.0, 64.0};
  scene.terrain = {-64.0, 64.0, 128.0, Array2D<float>(2, 2, 30.0F)};
  const auto diffuse = [&](const char* name, double albedo) {
    return scene.material_index({.name = name, .model = scatter::LambertParameters{albedo, {0.0, 1.0}}, .source = {}});
  };
  scene.ground = {{-64.0, 64.0, 128.0, 1, 1}, Array2D<scene::MaterialIndex>(1, 1, diffuse("ground", 0.1))};
  const geo::Polygon outline{{{-6.0, -4.0}, {6.0, -4.0}, {6.0, 4.0}, {-6.0, 4.0}}, {}};
  scene::append_building(scene.buildings, outline, 9.0, 30.0, diffuse("wall", 0.4), diffuse("roof", 0.2));
  return scene;
}

constexpr double frequencies_hz[] = {10e9};

TEST(BuildingsOf, StandOnTheirFootingAndKeepTheirOwnMaterials) {
  const atlas::Buildings kept = buildings_of(house_on_a_hill(), frequencies_hz);
  ASSERT_EQ(kept.triangles.size(), 10U);
  ASSERT_EQ(kept.materials.size(), 2U);
  EXPECT_EQ(kept.materials[0].name, "wall");
  EXPECT_EQ(kept.materials[1].name, "roof");
  for (const Vec3f& vertex : kept.vertices) EXPECT_TRUE(vertex.z == 30.0F || vertex.z == 39.0F) << vertex.z;
}

/// 4π (ρ/π) cos² θ.
TEST(BuildingsOf, ReturnByAngleWhatTheirMaterialsDo) {
  const atlas::Buildings kept = buildings_of(house_on_a_hill(), frequencies_hz);
  for (const double off_deg : {0.0, 17.3, 45.0, 80.0}) {
    const double cosine = std::cos(radians_from_deg(off_deg));
    EXPECT_NEAR(kept.materials[0].reflectivity[0].at(cosine).vv, 4.0 * 0.4 * cosine * cosine, 1e-4) << off_deg;
    EXPECT_NEAR(kept.materials[1].reflectivity[0].at(cosine).hh, 4.0 * 0.2 * cosine * cosine, 1e-4) << off_deg;
  }
  EXPECT_EQ(kept.materials[0].reflectivity[0].at(-0.1), radar::Channels{});
}

// A mirror of a thousandth, whose lobe is a tenth of a degree wide: its power over all angles is that of its own BRDF.
TEST(BuildingsOf, ReturnTheLobesOfNarrowMirrors) {
  scene::Scene scene = house_on_a_hill();
  for (scatter::Material& material : scene.materials)
    material.model = scatter::CookTorranceParameters{{5.0, 0.0, 0.01, 0.0}, 0.001};
  const atlas::Buildings kept = buildings_of(scene, frequencies_hz);
  const scatter::SurfaceModel surface(scene.materials[1], 10e9);
  double kept_sum = 0.0, own_sum = 0.0;
  for (double off_rad = 1e-5; off_rad < 0.01; off_rad += 1e-5) {
    kept_sum += static_cast<double>(kept.materials[0].reflectivity[0].at(std::cos(off_rad)).vv) * off_rad;
    own_sum += static_cast<double>(scatter::surface_sigma0(surface, 0.5 * pi - off_rad).vv) * off_rad;
  }
  EXPECT_NEAR(db_from_linear(kept_sum / own_sum), 0.0, 0.1);
}

// As any program that knows glTF reads them, y up and z to the south.
TEST(BuildingsOf, AreReadByOthers) {
  const ScratchFolder folder;
  SilentProgress silent;
  BakeSettings settings;
  settings.aspects = {{0.0}, {radians_from_deg(20.0)}, {10e9}};
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = 2;
  settings.buildings = Buildings::Apart;
  bake(house_on_a_hill(), settings, folder.path("atlas"), silent);
  const scene::ImportedMesh mesh = scene::read_gltf(folder.path("atlas") / atlas::buildings_name);
  const atlas::Buildings kept = atlas::read_buildings(atlas::Store::open(folder.path("atlas")));
  ASSERT_EQ(mesh.triangles.size(), kept.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3d theirs = mesh.vertices[mesh.triangles[i][corner]];
      const Vec3d ours = kept.vertices[kept.triangles[i][corner]].to<double>();
      EXPECT_EQ(theirs, (Vec3d{ours.x, ours.z, -ours.y}));
    }
    EXPECT_EQ(mesh.material_names[mesh.materials[i]], kept.materials[kept.material_of[i]].name);
  }
}

TEST(BuildingsOf, ApartWantsShadowsAtRunTimeAndTerrain) {
  BakeSettings settings;
  settings.buildings = Buildings::Apart;
  EXPECT_EQ(message_of_error([&] { check(settings); }), "");
  settings.shadows = Shadows::Baked;
  EXPECT_NE(message_of_error([&] { check(settings); }).find("buildings"), std::string::npos);
  settings.shadows = Shadows::RunTime;
  settings.footing = trace::Footing::LevelPlane;
  EXPECT_NE(message_of_error([&] { check(settings); }).find("buildings"), std::string::npos);
}

}  // namespace
}  // namespace sigmascape::bake
