// What stands behind a ridge and rises above it, docs/decisions/0119-what-lies-over-is-seen-by-its-own-height.md, and
// what lands there from afar.
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

constexpr double ridge_elevation_deg = 10.0, block_height_m = 30.0, front_m = 6.0;

/// Ground that hardly answers, with a block in its middle whose lowest `hidden_m` a ridge to the south hides.
scene::Scene block_behind_ridge(double hidden_m) {
  scene::Scene scene =
      level_scene({.name = "dark", .model = scatter::ConstantGammaParameters{1e-7, {0.1, 0.5}}, .source = {}}, 512.0);
  constexpr double spacing_m = 4.0, ridge_m = 96.0, half_width_m = 60.0;
  constexpr std::size_t nodes = 129;
  scene.terrain = {-256.0, 256.0, spacing_m, Array2D<float>(nodes, nodes)};
  // A parabola of this height, which the line of sight to the wall touches behind its crest.
  const double tangent = std::tan(radians_from_deg(ridge_elevation_deg));
  const double above_foot_m = hidden_m + (ridge_m - front_m) * tangent;
  const double height =
      0.5 * (above_foot_m + std::sqrt(above_foot_m * above_foot_m - std::pow(half_width_m * tangent, 2.0)));
  for (std::size_t row = 0; row < nodes; ++row) {
    const double to_crest = (256.0 - spacing_m * static_cast<double>(row) + ridge_m) / half_width_m;
    for (std::size_t column = 0; column < nodes; ++column)
      scene.terrain.height_m(column, row) = static_cast<float>(std::max(0.0, height * (1.0 - to_crest * to_crest)));
  }
  const scatter::Material wall{.name = "wall", .model = scatter::LambertParameters{0.5, {0.1, 0.5}}, .source = {}};
  scene.prototypes.push_back(scene::box_mesh(
      {20.0F, static_cast<float>(2.0 * front_m), static_cast<float>(block_height_m)}, scene.material_index(wall)));
  scene.instances.push_back({.x_m = 0.0F, .y_m = 0.0F});
  return scene;
}

radar::Radar radar_seeing_the_middle() {
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(ridge_elevation_deg), 200e3);
  radar.frequency_hz = frequency_hz;
  radar.range_resolution_m = 2.0;
  radar.beam_width_rad = 2.0 * std::sqrt(2.0) / 200e3;
  return radar;
}

/// VV of all bins from a range on.
double rcs_beyond_m2(const radar::RangeAzimuthImage& image, double range_m) {
  double total = 0.0;
  for (std::size_t range = 0; range < image.grid.ranges; ++range) {
    if (image.grid.first_range_m + static_cast<double>(range) * image.grid.range_step_m < range_m) continue;
    for (std::size_t azimuth = 0; azimuth < image.grid.azimuths; ++azimuth)
      total += static_cast<double>(image.rcs_m2(azimuth, range).vv);
  }
  return total;
}

/// Power beyond a range, rendered from a bake of the very look, over the same traced.
double baked_over_traced(const scene::Scene& scene, std::uint32_t samples, int max_bounces, double beyond_range_m) {
  bake::BakeSettings settings;
  settings.aspects = {{pi}, {radians_from_deg(ridge_elevation_deg)}, {frequency_hz}};
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = samples;
  settings.max_bounces = max_bounces;
  const ScratchFolder folder;
  SilentProgress silent;
  bake::bake(scene, settings, folder.path("atlas"), silent);
  const atlas::Atlas atlas = atlas::load_atlas(atlas::Store::open(folder.path("atlas")));

  const radar::Radar radar = radar_seeing_the_middle();
  const radar::Rectangle area{-40, -40, 40, 40};
  render::RenderCounts rendered;
  const auto baked = simulate::baked_image(atlas, scene.terrain, radar, area, {}, rendered);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  trace::TraceCounts counts;
  const auto traced = simulate::traced_image(scene, geometry, radar, area,
                                             {.samples_per_cell = samples, .max_bounces = max_bounces}, counts);
  return rcs_beyond_m2(baked, beyond_range_m) / rcs_beyond_m2(traced, beyond_range_m);
}

// The wall answers from texels before its foot, on which nothing stands and which the ridge hides.
TEST(BehindARidge, AWallThatRisesAboveItKeepsItsPower) {
  for (const double hidden_m : {4.0, 10.0, 20.0}) {
    validation::expect_close(
        {.group = "Baked on its own ground",
         .name = fmt::format("block of {:g} m of which a ridge hides {:g} m", block_height_m, hidden_m),
         .expected = 0.0,
         .measured = db_from_linear(baked_over_traced(block_behind_ridge(hidden_m), 32, 1, 0.0)),
         .tolerance = 0.05,
         .unit = "dB over the same traced",
         .source = "the path tracer"});
  }
}

/// Two blocks, one behind the other, on the edge of high ground that falls away behind them more steeply than the radar
/// looks: from the hinder one to the other and back, echoes come as late as those of the ground that it hides.
scene::Scene street_above_a_slope() {
  scene::Scene scene =
      level_scene({.name = "dark", .model = scatter::ConstantGammaParameters{1e-7, {0.1, 0.5}}, .source = {}}, 512.0);
  constexpr double spacing_m = 4.0, edge_m = 8.0, fall = 0.5, depth_m = 50.0;
  constexpr std::size_t nodes = 129;
  scene.terrain = {-256.0, 256.0, spacing_m, Array2D<float>(nodes, nodes)};
  for (std::size_t row = 0; row < nodes; ++row) {
    const double beyond_edge_m = 256.0 - spacing_m * static_cast<double>(row) - edge_m;
    for (std::size_t column = 0; column < nodes; ++column)
      scene.terrain.height_m(column, row) = static_cast<float>(-std::clamp(fall * beyond_edge_m, 0.0, depth_m));
  }
  const scatter::Material wall{.name = "wall", .model = scatter::LambertParameters{0.5, {0.1, 0.5}}, .source = {}};
  const scene::MaterialIndex material = scene.material_index(wall);
  scene.prototypes.push_back(scene::box_mesh({40.0F, 4.0F, 20.0F}, material));
  scene.prototypes.push_back(scene::box_mesh({40.0F, 2.0F, 8.0F}, material));
  scene.instances.push_back({.prototype = 0, .x_m = 0.0F, .y_m = 2.0F});
  scene.instances.push_back({.prototype = 1, .x_m = 0.0F, .y_m = -15.0F});
  return scene;
}

// Nothing of the slope is seen: docs/decisions/0131-what-comes-from-afar-is-not-hidden.md.
TEST(BehindARidge, WhatComesLateFromAfarIsNotHidden) {
  const double face_m = length(radar_seeing_the_middle().position), late_m = 10.0;
  validation::expect_close(
      {.group = "Baked on its own ground",
       .name = "echoes between two blocks, late onto a hidden slope behind them",
       .expected = 0.0,
       .measured = db_from_linear(baked_over_traced(street_above_a_slope(), 256, 4, face_m + late_m)),
       .tolerance = 0.3,
       .unit = "dB over the same traced",
       .source = "the path tracer"});
}

}  // namespace
}  // namespace sigmascape::physics_test
