#include <gtest/gtest.h>
#include <vector>

#include "counted_allocations.h"
#include "live_ground_example.h"

#include "sigmascape/live/live_renderer.h"
#include "sigmascape/live/visible_ground.h"

namespace sigmascape::live {
namespace {

TEST(SteadyMemory, VisibleGroundTakesNoneOnceItHasWorked) {
  terrain::HeightField field{
      .west_m = -500.0, .north_m = 500.0, .spacing_m = 10.0, .height_m = Array2D<float>(101, 101)};
  for (std::size_t i = 0; i < field.height_m.size(); ++i) field.height_m.values()[i] = static_cast<float>(i % 37);
  const terrain::TerrainView view = terrain::view_of(field);
  for (const auto method : {VisibilityMethod::HorizonSweep, VisibilityMethod::Rasterization}) {
    VisibleGround visible_ground({.method = method}, 2);
    WorkerTeam team(2);
    HorizonGrid grid{.azimuth_step_rad = 0.005, .azimuths = 64, .near_m = 2600.0, .step_m = 10.0, .distances = 80};
    const auto find = [&](double east_m) {
      visible_ground.reset(grid, false);
      visible_ground.find(0, grid.azimuths, {east_m, -3000.0, 700.0}, {.terrain = view}, team);
    };
    // Pictures of all places that are looked from later, and a larger one.
    for (int frame = 0; frame < 10; ++frame) find(1.0 * frame);
    grid.azimuths = 60;
    for (int frame = 0; frame < 10; ++frame) find(1.0 * frame);
    const std::size_t before = allocations();
    for (int frame = 0; frame < 10; ++frame) find(1.0 * frame);
    EXPECT_EQ(allocations(), before);
  }
}

TEST(SteadyMemory, LiveFramesTakeNoneOnceTheirPagesAreThere) {
  for (const bool apart : {false, true}) {
    const ScratchFolder folder;
    ExampleGround example;
    example.patches_a_side = apart ? 2 : 1;
    example.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
    if (apart) {
      example.bare_sigma0 = example.sigma0;
      example.obstacle = [](Vec2d) {
        return radar::Obstacle{
            .solid_top_m = 0.0F, .crown_base_m = 2.0F, .crown_top_m = 9.0F, .crown_extinction_per_m = 0.01F};
      };
    }
    const auto ground = example.over(example.store(folder.path("atlas")));
    const ExampleView view{.target = example.middle()};
    LiveRenderer renderer(ground, view.settings(FrameContent::Amplitudes));
    Pose pose = view.pose();
    std::vector<radar::Target> targets(200);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const double x = static_cast<double>(i % 20) * 20.0 - 200.0, y = static_cast<double>(i / 20) * 20.0 - 100.0;
      targets[i].track = radar::Track::straight(Vec3d{view.target.x + x, view.target.y + y, 2.0});
      targets[i].rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
      targets[i].fluctuation = radar::Swerling::Case1;
      targets[i].size_m = {8.0, 3.0, 4.0};
    }
    pose.targets = targets;
    settled_frame(renderer, *ground, pose);
    // What lies ahead of the scan and of the small way below is asked for as well.
    for (const double ahead_m : {0.0, 5.0}) {
      pose.position.x = view.pose().position.x + ahead_m;
      renderer.scan(pose, 16, 16);
      ground->wait_until_loaded();
      renderer.render(pose);
      ground->wait_until_loaded();
    }
    pose.position = view.pose().position;
    const std::size_t before = allocations();
    for (int frame = 0; frame < 10; ++frame) {
      pose.position.x += 0.5;
      const FrameReport& report = renderer.render(pose).report;
      EXPECT_EQ(report.coarse, 0U);
      EXPECT_EQ(report.terrain_error_m, 0.0);
      EXPECT_EQ(report.coarse_obstacles, 0U);
      EXPECT_GT(report.targets, 100U);
      renderer.scan(pose, 16, 16);
    }
    EXPECT_EQ(allocations(), before) << (apart ? "ground apart" : "ground in the textures");
  }
}

/// One long beam, as of an altimeter, is a frame of 4 MB, and a thread fills it in as much of its own.
TEST(Memory, OfAFrameOfOneBeamIsThatOfOneBeam) {
  const ScratchFolder folder;
  ExampleGround example;
  example.patches_a_side = 1;
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
  const auto ground = example.over(example.store(folder.path("atlas")));
  LiveSettings settings{.beams = 1, .ranges = std::size_t{1} << 17U, .beam_step_rad = 2e-3, .range_step_m = 1.0};
  settings.threads = 1;
  const std::size_t before = allocated_bytes();
  const LiveRenderer renderer(ground, settings);
  const std::size_t frame_bytes = settings.ranges * numbers_a_bin(settings.content) * sizeof(float);
  EXPECT_LT(allocated_bytes() - before, 4 * frame_bytes);
}

}  // namespace
}  // namespace sigmascape::live
