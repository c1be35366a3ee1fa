#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "live_ground_example.h"

namespace sigmascape::live {
namespace {

ExampleGround even_square(int patches_a_side) {
  ExampleGround ground = even_example();
  ground.patches_a_side = patches_a_side;
  return ground;
}

/// γ sin ψ over the ground of all bins but a few at the edges.
double error_within_edges_db(const Frame& frame, double height_m) {
  constexpr std::size_t margin = 4;
  double sum = 0.0, expected = 0.0;
  for (std::size_t range = margin; range + margin < frame.grid.ranges; ++range) {
    for (std::size_t beam = margin; beam + margin < frame.grid.azimuths; ++beam) {
      sum += static_cast<double>(frame.powers_m2[(beam * frame.grid.ranges + range) * 4]);
      expected += example_gamma * height_m * frame.grid.range_step_m * frame.grid.azimuth_step_rad;
    }
  }
  return db_from_linear(sum / expected);
}

TEST(LiveFlight, NoStepShowsWhereTheLevelOfDetailChanges) {
  const ScratchFolder folder;
  const ExampleGround example = even_square(4);
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  ExampleView view{.target = example.middle()};
  view.bin_m = 30.0;
  view.beams = 40;
  view.ranges = 40;
  LiveSettings settings = view.settings(FrameContent::Powers);
  settings.beam_step_rad *= 0.4;
  LiveRenderer renderer(ground, settings);
  const Pose first = view.pose();
  std::vector<std::size_t> levels;
  double last = 0.0;
  for (int step = 0; step < 90; ++step) {
    // Away from the middle, so that the beams grow wider there until coarser texels do.
    Pose pose = first;
    pose.first_range_m += 60.0 * step;
    pose.position = Vec3d{view.target.x, view.target.y, 0.0} +
                    (first.position - Vec3d{view.target.x, view.target.y, 0.0}) * (1.0 + 60.0 * step / 4000.0);
    pose.velocity_mps = normalized(first.position - Vec3d{view.target.x, view.target.y, 0.0}) * 250.0;
    const Frame& frame = renderer.render(pose);
    ground->wait_until_loaded();
    const double error = error_within_edges_db(frame, pose.position.z);
    EXPECT_NEAR(error, 0.0, 0.05) << "step " << step;
    if (step > 0) {
      EXPECT_NEAR(error, last, 0.05) << "step " << step;
    }
    last = error;
    levels.push_back(frame.report.level);
  }
  EXPECT_GT(levels.back(), levels.front());
  EXPECT_TRUE(std::ranges::is_sorted(levels));
}

TEST(LiveFlight, WhatLiesAheadIsThereWhenItComesIntoView) {
  const ScratchFolder folder;
  ExampleGround example = even_square(3);
  (void)example.store(folder.path("atlas"));
  ExampleView view{.target = example.middle() - Vec2d{0.0, 1000.0}};
  view.azimuth_deg = 180.0;
  const auto lacking_after_a_second = [&](Vec3d velocity_mps) {
    const auto fresh = example.over(atlas::Store::open(folder.path("atlas")));
    LiveRenderer renderer(fresh, view.settings(FrameContent::Powers));
    Pose pose = view.pose();
    pose.velocity_mps = velocity_mps;
    for (int frame = 0; frame < 3; ++frame) {
      renderer.render(pose);
      fresh->wait_until_loaded();
    }
    pose.position.y += 1200.0;
    const FrameReport& report = renderer.render(pose).report;
    return report.coarse + report.dark;
  };
  EXPECT_GT(lacking_after_a_second({0.0, 0.0, 0.0}), 0U);
  EXPECT_EQ(lacking_after_a_second({0.0, 1200.0, 0.0}), 0U);
}

TEST(LiveFlight, AScanAsksForTheBeamsToCome) {
  const ScratchFolder folder;
  ExampleGround example = even_square(3);
  const atlas::Store store = example.store(folder.path("atlas"));
  const auto ground = example.over(store);
  LiveSettings settings;
  settings.content = FrameContent::Powers;
  settings.beams = 64;
  settings.beam_step_rad = 2.0 * pi / 64.0;
  settings.ranges = 64;
  settings.range_step_m = 12.0;
  settings.cells_per_bin = 3.0;
  LiveRenderer renderer(ground, settings);
  const Pose pose{.position = {example.middle().x, example.middle().y, 300.0}, .first_range_m = 500.0};
  renderer.scan(pose, 0, 1);
  ground->wait_until_loaded();
  // Half a turn, at sixty steps a second.
  for (std::size_t beam = 1; beam < 32; ++beam) {
    const FrameReport& report = renderer.scan(pose, beam, 1).report;
    EXPECT_EQ(report.coarse + report.dark, 0U) << beam;
  }
}

}  // namespace
}  // namespace sigmascape::live
