#include "sigmascape/live/frame_reach.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "live_ground_example.h"

namespace sigmascape::live {
namespace {

TEST(FrameReach, EndsWhereTheBinsDoOverACurvedEarth) {
  const LiveSettings settings{.ranges = 256, .range_step_m = 75.0};
  for (const auto& earth : {radar::CurvedEarth::flat(), radar::CurvedEarth{}, radar::CurvedEarth{.refraction = 1.0}}) {
    for (const double height_m : {300.0, 3000.0, 12e3}) {
      for (const double first_range_m : {13e3, 100e3, 300e3}) {
        const Pose pose{.position = {0.0, 0.0, height_m}, .first_range_m = first_range_m};
        const FrameReach reach = frame_reach(settings, pose, -10.0, 1500.0, earth);
        EXPECT_NEAR(earth.slant_range_m(height_m, -10.0, reach.near_m), first_range_m, 1e-3);
        EXPECT_NEAR(earth.slant_range_m(height_m, std::min(1500.0, height_m), reach.far_m),
                    first_range_m + 256.0 * 75.0, 1e-3);
      }
    }
  }
  const Pose high{.position = {0.0, 0.0, 12e3}, .first_range_m = 8e3};
  EXPECT_EQ(frame_reach(settings, high, 0.0, 0.0, {}).near_m, 0.0);
}

TEST(FrameReach, BeginsWithWhatTowersAboveTheRadarWhereThatIsNearer) {
  const LiveSettings settings{.ranges = 256, .range_step_m = 15.0};
  const radar::CurvedEarth earth;
  const Pose low{.position = {0.0, 0.0, 30.0}, .first_range_m = 2000.0};
  const FrameReach reach = sharing_reach(settings, low, 0.0, 3000.0, 1000.0, earth);
  EXPECT_NEAR(earth.slant_range_m(30.0, 1000.0, reach.near_m), 2000.0 - 7.5, 1e-3);
  const FrameReach among_hills = sharing_reach(settings, low, 0.0, 3000.0, 50.0, earth);
  EXPECT_NEAR(earth.slant_range_m(30.0, 0.0, among_hills.near_m), 2000.0 - 7.5, 1e-3);
}

/// A slope of 42° begins 400 m before a radar that stands at its foot, so that ground 828 m away is 900 m from it.
TEST(FrameReach, FirstBinsHoldSlopesThatRiseAboveTheRadar) {
  const ScratchFolder folder;
  ExampleGround example;
  constexpr double distance_m = 900.0;
  example.height_m = [](Vec2d way) { return 0.9 * std::max(0.0, way.y + distance_m - 400.0); };
  example.sigma0 = [](const radar::Look&) { return radar::Channels{0.1F, 0.1F, 0.01F, 0.0F}; };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  LiveSettings settings;
  settings.content = FrameContent::Powers;
  settings.beams = 16;
  settings.ranges = 16;
  settings.beam_step_rad = 0.01;
  settings.range_step_m = 10.0;
  Pose pose;
  pose.position = {example.middle().x, example.middle().y - distance_m, 30.0};
  pose.first_azimuth_rad = -8.0 * settings.beam_step_rad;
  pose.first_range_m = 900.0;
  LiveRenderer renderer(ground, settings);
  const Frame& frame = settled_frame(renderer, *ground, pose);
  const auto of_range = [&](std::size_t range) { return vv_of_range(frame, range, 4); };
  double mean = 0.0;
  for (std::size_t range = 0; range < settings.ranges; ++range)
    mean += of_range(range) / static_cast<double>(settings.ranges);
  ASSERT_GT(mean, 0.0);
  for (std::size_t range = 0; range < settings.ranges; ++range) EXPECT_GT(of_range(range) / mean, 0.5) << range;
}

/// From 12 km height the ground at a slant range of 300 km lies 200 m nearer than over a flat Earth.
TEST(FrameReach, NoBinIsDarkForTheEarthsCurvature) {
  const ScratchFolder folder;
  ExampleGround example;
  example.sigma0 = [](const radar::Look&) { return radar::Channels{0.1F, 0.1F, 0.01F, 0.0F}; };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  LiveSettings settings;
  settings.content = FrameContent::Powers;
  settings.beams = 16;
  settings.ranges = 32;
  settings.beam_step_rad = 30.0 / 300e3;
  settings.range_step_m = 30.0;
  const radar::CurvedEarth earth{.refraction = settings.refraction};
  constexpr double height_m = 12e3, distance_m = 300e3;
  Pose pose;
  pose.position = {example.middle().x, example.middle().y - distance_m, height_m};
  pose.first_azimuth_rad = -8.0 * settings.beam_step_rad;
  pose.first_range_m = earth.slant_range_m(height_m, 0.0, distance_m) - 16.0 * settings.range_step_m;
  LiveRenderer renderer(ground, settings);
  const Frame& frame = settled_frame(renderer, *ground, pose);
  const auto of_range = [&](std::size_t range) { return vv_of_range(frame, range, 4); };
  ASSERT_GT(of_range(16), 0.0);
  for (std::size_t range = 0; range < settings.ranges; ++range)
    EXPECT_NEAR(of_range(range) / of_range(16), 1.0, 0.1) << range;
}

TEST(FrameReach, TheFirstBinAndTheLastHoldAsMuchOfEvenGroundAsTheOthers) {
  const ScratchFolder folder;
  ExampleGround example;
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  ExampleView view;
  view.slant_range_m = 8000.0;
  LiveSettings settings = view.settings(FrameContent::Powers);
  settings.cells_per_bin = 3.0;
  LiveRenderer renderer(ground, settings);
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  const auto of_range = [&](std::size_t range) { return vv_of_range(frame, range); };
  for (const std::size_t range : {std::size_t{0}, view.ranges - 1})
    EXPECT_NEAR(db_from_linear(of_range(range) / of_range(view.ranges / 2)), 0.0, 0.15) << range;
}

}  // namespace
}  // namespace sigmascape::live
