#include "sigmascape/simulate/map_tracer.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "physics/level_scene.h"
#include "scratch_folder.h"

namespace sigmascape::simulate {
namespace {

TEST(MapTracer, OneMapKnowsNothingOfThoseBefore) {
  const scatter::Material ground{.name = "ground", .model = scatter::LambertParameters{0.5, {0.0, 1.0}}, .source = {}};
  scene::Scene scene = physics_test::level_scene(ground, 128.0);
  scene.prototypes.push_back(scene::box_mesh({8.0F, 6.0F, 7.0F}, 0));
  scene.instances.push_back({});
  scene.point_targets.push_back({.name = "corner", .position = {20.0, 0.0}, .rcs_m2 = {1.0F, 1.0F, 0.0F, 1.0F}});
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(30.0), 20e3);
  radar.range_resolution_m = 3.0;
  radar.beam_width_rad = 3.0 / 20e3;
  MapTracer tracer(scene, geometry, radar, {-30.0, -30.0, 30.0, 30.0}, {.cell_m = 2.0, .threads = 2});
  const LaunchShare all{tracer.launch().cells, 4};
  trace::TraceCounts counts;
  const auto traced = [&](std::uint64_t seed) { return tracer.map({&all, 1}, seed, counts).front(); };
  const auto first = traced(1), other = traced(2), again = traced(1);
  EXPECT_TRUE(std::ranges::equal(first.rcs_m2.values(), again.rcs_m2.values()));
  EXPECT_FALSE(std::ranges::equal(first.rcs_m2.values(), other.rcs_m2.values()));

  // Half of the cells, and the others: together what all of them bring.
  LaunchShare west{{}, 4}, east{{}, 4};
  for (const trace::LaunchCell& cell : all.cells) (cell.i < 0 ? west : east).cells.push_back(cell);
  const LaunchShare halves[] = {west, east};
  const auto in_halves = tracer.map(halves, 1, counts).front();
  EXPECT_TRUE(std::ranges::equal(first.rcs_m2.values(), in_halves.rcs_m2.values()));
}

// Rays past the highest point come down behind the map at its height times the distance over what the radar has above
// it.
TEST(MapTracer, ARadarHardlyAboveTheSceneIsRefused) {
  const scatter::Material ground{.name = "ground", .model = scatter::LambertParameters{0.5, {0.0, 1.0}}, .source = {}};
  scene::Scene scene = physics_test::level_scene(ground, 128.0);
  scene.prototypes.push_back(scene::box_mesh({8.0F, 6.0F, 70.0F}, 0));
  scene.instances.push_back({});
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  radar::Radar radar;
  radar.range_resolution_m = 3.0;
  radar.beam_width_rad = 3.0 / 20e3;
  const auto fault_from = [&](double above_m) {
    radar.position = {0.0, -5000.0, geometry.highest_m() + above_m};
    return message_of_error([&] {
      static_cast<void>(MapTracer(scene, geometry, radar, {-30.0, -30.0, 30.0, 30.0}, {.cell_m = 0.5, .threads = 2}));
    });
  };
  EXPECT_EQ(fault_from(200.0), "");
  EXPECT_THAT(fault_from(1.0001),
              ::testing::HasSubstr("stands 1 m above the highest point of the scene, and of the ground that answers"));
  EXPECT_THAT(fault_from(0.5), ::testing::HasSubstr("and the highest point of the scene at 70.0 m; place"));
}

// A spotlight is steered to its aim, a strip points abeam: neither scans.
TEST(MapTracer, OnlyARealBeamHasToScanWhatIsMapped) {
  const scatter::Material ground{.name = "ground", .model = scatter::LambertParameters{0.5, {0.0, 1.0}}, .source = {}};
  const scene::Scene scene = physics_test::level_scene(ground, 128.0);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(30.0), 20e3);
  radar.range_resolution_m = 3.0;
  radar.beam_width_rad = 3.0 / 20e3;
  radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = pi / 2.0};
  const auto fault_of = [&](radar::Mode mode) {
    radar.mode = mode;
    return message_of_error([&] {
      static_cast<void>(MapTracer(scene, geometry, radar, {-30.0, -30.0, 30.0, 30.0}, {.cell_m = 2.0, .threads = 1}));
    });
  };
  EXPECT_THAT(fault_of(radar::Mode::RealBeam), ::testing::HasSubstr("never points to what is to be mapped"));
  EXPECT_EQ(fault_of(radar::Mode::Spotlight), "");
  EXPECT_EQ(fault_of(radar::Mode::Stripmap), "");
}

// Past the mast's top rays come down millions of kilometres behind, and meet nothing of it where paths to the map
// begin.
TEST(MapTracer, WhatIsHighElsewhereIsNotAimedPast) {
  const scatter::Material ground{.name = "ground", .model = scatter::LambertParameters{0.5, {0.0, 1.0}}, .source = {}};
  scene::Scene scene = physics_test::level_scene(ground, 4096.0);
  scene.prototypes.push_back(scene::box_mesh({8.0F, 6.0F, 70.0F}, 0));
  scene.instances.push_back({.prototype = 0, .x_m = 0.0F, .y_m = 1900.0F});
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  radar::Radar radar;
  radar.range_resolution_m = 8.0;
  radar.beam_width_rad = 8.0 / 5e3;
  radar.position = {0.0, -5000.0, geometry.highest_m() + 1.0001};
  const radar::Rectangle area{-32.0, -32.0, 32.0, 32.0};
  const MapTracer tracer(scene, geometry, radar, area, {.cell_m = 4.0, .threads = 2});
  const auto& cells = tracer.launch().cells;
  const double farthest_m = 4.0 * (std::ranges::max(cells, {}, &trace::LaunchCell::j).j + 1);
  EXPECT_GT(farthest_m, area.north_m);
  EXPECT_LT(farthest_m, 700.0);  // 5 km of 1 m below 71 m, what the beam takes in and tiles
  const auto far_behind = trace::launch_outline(tracer.launch().viewpoint, area, 4.0, 0.0, 71.0, {});
  EXPECT_GT(trace::aimed_area_m2(far_behind), 1e12);
}

}  // namespace
}  // namespace sigmascape::simulate
