#include "sigmascape/simulate/map_question.h"

#include <cmath>
#include <gtest/gtest.h>

#include "physics/level_scene.h"
#include "scratch_folder.h"
#include "unit/live/live_ground_example.h"

#include "sigmascape/radar/coherent_plan.h"

namespace sigmascape::simulate {
namespace {

constexpr double scene_side_m = 4096.0, radar_range_m = 20e3;
const radar::GroundGrid asked_grid{-64.0, 64.0, 2.0, 64, 64};

/// Level ground with nodes 4 m apart and a house of 12 triangles on it.
scene::Scene house() {
  scene::Scene scene = physics_test::level_scene(
      {.name = "ground", .model = scatter::LambertParameters{0.3, {0.0, 1.0}}, .source = {}}, scene_side_m);
  scene.terrain = {-scene_side_m / 2.0, scene_side_m / 2.0, 4.0, Array2D<float>(1025, 1025, 0.0F)};
  scene.prototypes.push_back(scene::box_mesh({10.0F, 10.0F, 6.0F}, 0));
  scene.instances.push_back({});
  return scene;
}

/// Flies to the east, 20 km south of the middle.
radar::Radar radar_of(radar::Mode mode) {
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(10.0), radar_range_m);
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.heading_rad = 0.5 * pi;
  radar.beam_width_rad = 0.02;
  radar.waveform.pulse_repetition_hz = 2000.0;
  radar.mode = mode;
  return radar;
}

TEST(MapQuestion, AcrossTheLineOfSightAModeIsAsSharpAsItIsPlannedToBe) {
  const scene::Scene scene = house();
  using radar::Mode;
  const auto cross_range_m = [&](Mode mode) {
    return map_question(scene, radar_of(mode), asked_grid, nullptr).cross_range_m;
  };
  const double ground_range_m = radar_range_m * std::cos(radians_from_deg(10.0));
  EXPECT_NEAR(cross_range_m(Mode::RealBeam), 0.02 * ground_range_m, 1e-6);
  // What they take where the radar file leaves it open, as far as whole pulses give it.
  EXPECT_NEAR(cross_range_m(Mode::DopplerBeamSharpening), 0.02 * ground_range_m / radar::usual_sharpening, 0.05);
  EXPECT_NEAR(cross_range_m(Mode::Spotlight), radar_of(Mode::Spotlight).range_resolution_m, 0.002);
  EXPECT_NEAR(cross_range_m(Mode::Stripmap), radar_of(Mode::Stripmap).range_resolution_m, 1e-6);
}

TEST(MapQuestion, OnlyPowerIsTraced) {
  const scene::Scene scene = house();
  EXPECT_EQ(render::choose_detail(map_question(scene, radar_of(radar::Mode::RealBeam), asked_grid, nullptr)).level, 0);
  EXPECT_GT(render::choose_detail(map_question(scene, radar_of(radar::Mode::Spotlight), asked_grid, nullptr)).level, 0);
}

TEST(MapQuestion, KnowsTheSceneAndItsTerrain) {
  const render::DetailQuestion question = map_question(house(), radar_of(radar::Mode::RealBeam), asked_grid, nullptr);
  EXPECT_NEAR(question.tallest_object_m, 6.0, 1e-6);
  EXPECT_NEAR(question.triangles_per_m2, (2.0 * 1024.0 * 1024.0 + 12.0) / (scene_side_m * scene_side_m), 1e-12);
  EXPECT_NEAR(question.area_m2, 128.0 * 128.0, 1e-6);
  EXPECT_EQ(question.terrain_spacing_m, 4.0);
  EXPECT_EQ(question.terrain_levels, 1) << "maps stand on the finest";
}

TEST(MapQuestion, KnowsWhatTheAtlasHas) {
  for (const bool apart : {false, true}) {
    const ScratchFolder folder;
    live::ExampleGround example;
    example.patches_a_side = 1;
    example.sigma0 = [](const radar::Look& look) { return live::constant_gamma(0.1, look); };
    if (apart) example.bare_sigma0 = example.sigma0;
    const atlas::Store store = example.store(folder.path("atlas"));
    const render::DetailQuestion question = map_question(house(), radar_of(radar::Mode::RealBeam), asked_grid, &store);
    EXPECT_EQ(question.ground_apart, apart);
    EXPECT_EQ(question.texel_m, example.texel_m);
    EXPECT_EQ(question.mips, 9);
  }
}

}  // namespace
}  // namespace sigmascape::simulate
