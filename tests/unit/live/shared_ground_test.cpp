#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

#include "live_ground_example.h"

#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/terrain/pyramid_builder.h"
#include "sigmascape/terrain/pyramid_files.h"

namespace sigmascape::live {
namespace {

using Amplitudes = std::vector<std::complex<float>>;

/// Flies past the middle and tells of the last frame.
Amplitudes flown(const std::shared_ptr<LiveGround>& ground, ExampleView view, double from_deg) {
  LiveRenderer renderer(ground, view.settings(FrameContent::Amplitudes, 2));
  for (int step = 0; step < 40; ++step) {
    view.azimuth_deg = from_deg + 0.5 * step;
    renderer.render(view.pose());
  }
  const Frame& last = settled_frame(renderer, *ground, view.pose());
  return {last.amplitudes_m.begin(), last.amplitudes_m.end()};
}

/// Two radars look at different ground in different ways, over one source of pages, terrain and what stands on it that
/// holds little more than what both of them need, each on a thread of its own.
class SharedGround : public testing::TestWithParam<bool> {};

TEST_P(SharedGround, TwoRenderersOnTwoThreadsSeeWhatEachSeesAlone) {
  const ScratchFolder folder;
  ExampleGround example;
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
  if (GetParam()) {
    example.bare_sigma0 = example.sigma0;
    example.obstacle = [](Vec2d p) {
      return std::remainder(p.x + 2.0 * p.y, 90.0) < -30.0 ? radar::Obstacle{.solid_top_m = 8.0F} : radar::Obstacle{};
    };
  }
  example.height_m = [](Vec2d p) { return 30.0 * std::sin(0.02 * p.x) * std::cos(0.017 * p.y); };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  terrain::build_pyramid(folder.path("terrain"), example.terrain(), {43.0, -3.0});
  const auto opened = [&] {
    return std::make_shared<LiveGround>(store,
                                        std::shared_ptr<terrain::TerrainPyramid>(new terrain::TerrainPyramid(
                                            terrain::open_pyramid(folder.path("terrain"), 1U << 20U))),
                                        10e9, CacheOptions{.budget_bytes = std::size_t{128} << 20U, .loaders = 2});
  };
  const std::array<ExampleView, 2> views{
      ExampleView{.target = example.middle() + Vec2d{200.0, 0.0}, .elevation_deg = 8.0},
      ExampleView{.target = example.middle() - Vec2d{200.0, 100.0}, .elevation_deg = 20.0, .bin_m = 40.0}};
  const std::array<double, 2> from_deg{20.0, 200.0};

  const auto shared = opened();
  std::array<Amplitudes, 2> together;
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < 2; ++i) {
      threads.emplace_back([&, i] { together[i] = flown(shared, views[i], from_deg[i]); });
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const Amplitudes alone = flown(opened(), views[i], from_deg[i]);
    ASSERT_GT(std::ranges::count_if(alone, [](auto a) { return std::norm(a) > 0.0F; }), 1000);
    EXPECT_TRUE(std::ranges::equal(together[i], alone)) << "renderer " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(GroundApart, SharedGround, testing::Bool());

}  // namespace
}  // namespace sigmascape::live
