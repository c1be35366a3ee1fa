#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <vector>

#include "unit/geo/read_features.h"
#include "unit/scene/made_up_place.h"

#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/polygon_overlay.h"
#include "sigmascape/geo/raster.h"
#include "sigmascape/geo/vector_source.h"
#include "sigmascape/scene/scene_file.h"

namespace sigmascape::scene {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  const char* stated = std::getenv("SIGMASCAPE_DATA");
  return stated != nullptr && *stated != '\0' ? fs::path(stated) : fs::path(SIGMASCAPE_SOURCE_DIR) / "../shared/data";
}

fs::path example(const std::string& name) {
  return fs::path(SIGMASCAPE_SOURCE_DIR) / "examples" / name / (name + ".toml");
}

Vec2d in_frame(const Scene& scene, const std::string& crs, Vec2d position) {
  geo::CoordinateTransform(crs, scene.frame, "test").to_frame({&position, 1});
  return position;
}

/// Area of roofs: what horizontal triangles of the buildings cover.
double roof_area_m2(const Scene& scene) {
  double sum = 0.0;
  const Mesh& mesh = scene.buildings.mesh;
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    if (a.z > 0.0F && b.z > 0.0F && c.z > 0.0F) sum += static_cast<double>(length(cross(b - a, c - a))) / 2.0;
  }
  return sum;
}

/// Buildings whose roof is not as large as the ground between their walls.
std::size_t open_buildings(const Scene& scene) {
  const Mesh& mesh = scene.buildings.mesh;
  std::vector<double> missing_m2(scene.buildings.items.size()), plan_m2(missing_m2.size());
  std::vector<std::size_t> building(mesh.vertices.size());
  for (std::size_t i = 0; i < missing_m2.size(); ++i) {
    const Building& item = scene.buildings.items[i];
    std::fill_n(building.begin() + item.first_vertex, item.vertex_count, i);
  }
  for (const auto& t : mesh.triangles) {
    const std::size_t i = building[t[0]];
    const Vec3d from = mesh.vertices[scene.buildings.items[i].first_vertex].to<double>();
    const Vec3d a = mesh.vertices[t[0]].to<double>() - from, b = mesh.vertices[t[1]].to<double>() - from,
                c = mesh.vertices[t[2]].to<double>() - from;
    if (a.z == 0.0 && b.z == 0.0) {
      plan_m2[i] += (a.x * b.y - a.y * b.x) / 2.0;
    } else if (a.z > 0.0 && b.z > 0.0 && c.z > 0.0) {
      missing_m2[i] -= cross(b - a, c - a).z / 2.0;
    }
  }
  std::size_t open = 0;
  for (std::size_t i = 0; i < missing_m2.size(); ++i)
    open += std::abs(plan_m2[i] + missing_m2[i]) > 0.001 * plan_m2[i] + 0.01 ? 1 : 0;
  return open;
}

class Bilbao : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (fs::exists(data_folder() / "bilbao")) scene_ = new Scene(read_scene(example("bilbao")));
  }
  static void TearDownTestSuite() {
    delete scene_;
    scene_ = nullptr;
  }
  void SetUp() override {
    if (scene_ == nullptr) GTEST_SKIP() << "the folder bilbao is not in " << data_folder() << "; set SIGMASCAPE_DATA";
  }
  static inline Scene* scene_ = nullptr;
};

TEST_F(Bilbao, TreesAreAllButThoseInWaterAndAtTheEdge) {
  EXPECT_EQ(remark_count(*scene_, "trees standing in water"), 84U);
  EXPECT_EQ(scene_->instances.size() + 84U + remark_count(*scene_, "trees outside the scene"), 14'567U);
  EXPECT_LT(remark_count(*scene_, "trees outside the scene"), 100U);
}

TEST_F(Bilbao, BuildingsAreAsManyAsTheFileHolds) {
  EXPECT_NEAR(static_cast<double>(scene_->buildings.items.size()), 3343.0, 100.0);
  EXPECT_NEAR(tallest_object_m(*scene_), 51.0, 1.0);
  EXPECT_GT(remark_count(*scene_, "overlapping footprints"), 800U);
}

TEST_F(Bilbao, RoofsCoverTheUnionOfTheFootprints) {
  const auto found = geo::read_features({.file = data_folder() / "bilbao" / "buildings_utm30n.geojson"}, scene_->frame);
  geo::Polygons all;
  for (const auto& feature : found) {
    Vec2d middle;
    for (const Vec2d& corner : feature.polygons[0].outer)
      middle = middle + corner * (1.0 / static_cast<double>(feature.polygons[0].outer.size()));
    if (!scene_->extent.contains(middle)) continue;
    for (const auto& part : geo::repaired(feature.polygons[0]).polygons) all.push_back(part);
  }
  const double sum_m2 = geo::area_m2(all), union_m2 = geo::area_m2(geo::united_all(all));
  EXPECT_GT(sum_m2, 1.004 * union_m2);
  EXPECT_NEAR(roof_area_m2(*scene_) / union_m2, 1.0, 0.001);
}

TEST_F(Bilbao, EveryBuildingHasItsRoof) {
  EXPECT_EQ(open_buildings(*scene_), 0U);
}

TEST_F(Bilbao, TerrainIsSmoothedWithinHalfAMetreOfItsSource) {
  const geo::Raster raster({data_folder() / "bilbao" / "dem_5m_utm30n.tif", 1, ""});
  const auto& field = scene_->terrain;
  const auto source = raster.heights_on(
      {field.west_m, field.north_m, field.spacing_m, field.height_m.columns(), field.height_m.rows()}, scene_->frame);
  std::size_t level = 0, equal_steps = 0, steps = 0;
  for (std::size_t row = 0; row < source.rows(); ++row) {
    for (std::size_t column = 0; column < source.columns(); ++column) {
      const auto height = static_cast<double>(field.height_m(column, row)),
                 before = static_cast<double>(source(column, row));
      if (height == 0.0) {
        ++level;
      } else {
        ASSERT_LE(std::abs(height - before), 0.501) << column << " " << row;
      }
      if (column == 0 || height == 0.0) continue;
      ++steps;
      equal_steps += std::abs(height - static_cast<double>(field.height_m(column - 1, row))) < 1e-4 ? 1U : 0U;
    }
  }
  // 72 % of neighbouring cells of the source are equal; a smooth surface has next to none.
  EXPECT_LT(static_cast<double>(equal_steps), 0.2 * static_cast<double>(steps));
  EXPECT_GT(level, 20'000U);
  EXPECT_LT(level, 80'000U);
}

TEST_F(Bilbao, HeightsStandWhereTheRasterHasThem) {
  // gdallocationinfo -geoloc dem_5m_utm30n.tif on hills and in the river.
  const auto height = [&](double east, double north) {
    return scene_->terrain.height_at(in_frame(*scene_, "EPSG:25830", {east, north}));
  };
  EXPECT_NEAR(height(502'600.0, 4'795'000.0), 91.0, 2.0);
  EXPECT_NEAR(height(502'650.0, 4'794'300.0), 59.0, 2.0);
  EXPECT_NEAR(height(500'300.0, 4'796'300.0), 4.0, 1.0);
  EXPECT_NEAR(height(500'300.0, 4'795'900.0), 0.0, 1e-6);
}

TEST_F(Bilbao, WaterLiesAtItsPixelsAndIsLevel) {
  // gdallocationinfo of the land cover: 80 in the river, 10 on the slope north of it.
  EXPECT_EQ(material_at(*scene_, in_frame(*scene_, "EPSG:25830", {500'300.0, 4'795'900.0})), "water");
  EXPECT_NE(material_at(*scene_, in_frame(*scene_, "EPSG:25830", {500'300.0, 4'796'300.0})), "water");
}

TEST(SanFrancisco, DowntownStandsWithItsTowers) {
  if (!fs::exists(data_folder() / "san_francisco"))
    GTEST_SKIP() << "the folder san_francisco is not in " << data_folder() << "; set SIGMASCAPE_DATA";
  const Scene scene = read_scene(example("san_francisco"));
  EXPECT_NEAR(tallest_object_m(scene), 326.0, 0.5);
  EXPECT_NEAR(scene.extent.width_m(), 1945.0, 25.0);
  EXPECT_NEAR(scene.extent.height_m(), 2020.0, 25.0);
  EXPECT_GT(scene.buildings.items.size(), 2000U);
  EXPECT_EQ(open_buildings(scene), 0U);
  // 433 of the 2,096 OpenStreetMap buildings carry neither height nor levels.
  EXPECT_NEAR(static_cast<double>(remark_count(scene, "buildings without a height")), 433.0, 15.0);
  // The stations beneath Market Street.
  EXPECT_EQ(remark_count(scene, "buildings underground"), 4U);
  // gdallocationinfo: 71.3 m on the slope of Nob Hill in the west; the bay lies level in the north-east.
  const Vec2d bay = geo::position_in_frame(scene.frame, {37.7990, -122.3910});
  EXPECT_EQ(material_at(scene, bay), "water");
  EXPECT_NEAR(scene.terrain.height_at(bay), 0.0, 1e-6);
  const Vec2d nob_hill = geo::position_in_frame(scene.frame, {37.7930, -122.4100});
  EXPECT_NEAR(scene.terrain.height_at(nob_hill), 71.3, 3.0);
  // The Transamerica Pyramid, 260 m by its tag.
  const Vec2d pyramid = geo::position_in_frame(scene.frame, {37.79515, -122.40279});
  double top = 0.0;
  for (const Vec3f& v : scene.buildings.mesh.vertices) {
    if (std::hypot(static_cast<double>(v.x) - pyramid.x, static_cast<double>(v.y) - pyramid.y) < 45.0)
      top = std::max(top, static_cast<double>(v.z));
  }
  EXPECT_NEAR(top, 260.0, 0.1);
}

}  // namespace
}  // namespace sigmascape::scene
