// What stands behind a ridge and rises above it: docs/decisions/0119-what-lies-over-is-seen-by-its-own-height.md.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/level_scene.h"
#include "scratch_folder.h"
#include "validation/validation_record.h"

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::physics_test {
namespace {

constexpr double elevation_deg = 10.0, height_m = 30.0, front_m = 6.0;

/// Ground that hardly answers, with a block in its middle whose lowest `hidden_m` a ridge to the south hides.
scene::Scene block_behind_ridge(double hidden_m) {
  scene::Scene scene =
      level_scene({.name = "dark", .model = scatter::ConstantGammaParameters{1e-7, {0.1, 0.5}}, .source = {}}, 512.0);
  constexpr double spacing_m = 4.0, ridge_m = 96.0, half_width_m = 60.0;
  constexpr std::size_t nodes = 129;
  scene.terrain = {-256.0, 256.0, spacing_m, Array2D<float>(nodes, nodes)};
  // A parabola of this height, which the line of sight to the wall touches behind its crest.
  const double tangent = std::tan(radians_from_deg(elevation_deg));
  const double above_foot_m = hidden_m + (ridge_m - front_m) * tangent;
  const double height =
      0.5 * (above_foot_m + std::sqrt(above_foot_m * above_foot_m - std::pow(half_width_m * tangent, 2.0)));
  for (std::size_t row = 0; row < nodes; ++row) {
    const double to_crest = (256.0 - spacing_m * static_cast<double>(row) + ridge_m) / half_width_m;
    for (std::size_t column = 0; column < nodes; ++column)
      scene.terrain.height_m(column, row) = static_cast<float>(std::max(0.0, height * (1.0 - to_crest * to_crest)));
  }
  const scatter::Material wall{.name = "wall", .model = scatter::LambertParameters{0.5, {0.1, 0.5}}, .source = {}};
  scene.prototypes.push_back(scene::box_mesh({20.0F, static_cast<float>(2.0 * front_m), static_cast<float>(height_m)},
                                             scene.material_index(wall)));
  scene.instances.push_back({.x_m = 0.0F, .y_m = 0.0F});
  return scene;
}

double total_rcs_m2(const radar::RangeAzimuthImage& image) {
  double total = 0.0;
  for (const radar::Channels& bin : image.rcs_m2.values()) total += static_cast<double>(bin.vv);
  return total;
}

// The wall answers from texels before its foot, on which nothing stands and which the ridge hides.
TEST(BehindARidge, AWallThatRisesAboveItKeepsItsPower) {
  for (const double hidden_m : {4.0, 10.0, 20.0}) {
    const scene::Scene scene = block_behind_ridge(hidden_m);
    bake::BakeSettings settings;
    settings.aspects = {{pi}, {radians_from_deg(elevation_deg)}, {frequency_hz}};
    settings.patches = {2.0, 256};
    settings.sampling.samples_per_texel = 32;
    settings.max_bounces = 1;
    const ScratchFolder folder;
    SilentProgress silent;
    bake::bake(scene, settings, folder.path("atlas"), silent);
    const atlas::Atlas atlas = atlas::load_atlas(atlas::Store::open(folder.path("atlas")));

    radar::Radar radar;
    radar.position = radar::position_seeing({}, pi, radians_from_deg(elevation_deg), 200e3);
    radar.frequency_hz = frequency_hz;
    radar.range_resolution_m = 2.0;
    radar.beam_width_rad = 2.0 * std::sqrt(2.0) / 200e3;
    const radar::Rectangle area{-40, -40, 40, 40};
    render::RenderCounts rendered;
    const double baked = total_rcs_m2(simulate::baked_image(atlas, scene.terrain, radar, area, {}, rendered));
    const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
    trace::TraceCounts counts;
    const double traced = total_rcs_m2(
        simulate::traced_image(scene, geometry, radar, area, {.samples_per_cell = 32, .max_bounces = 1}, counts));
    validation::expect_close({.group = "Baked on its own ground",
                              .name = fmt::format("block of {:g} m of which a ridge hides {:g} m", height_m, hidden_m),
                              .expected = 0.0,
                              .measured = db_from_linear(baked / traced),
                              .tolerance = 0.05,
                              .unit = "dB over the same traced",
                              .source = "the path tracer"});
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
