#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>
#include <vector>

#include "live_ground_example.h"
#include "recorded_locks.h"

#include "sigmascape/live/live_renderer.h"
#include "sigmascape/terrain/pyramid_builder.h"
#include "sigmascape/terrain/pyramid_files.h"

namespace sigmascape::live {
namespace {

// Frames of a renderer without helpers, so that all other threads are those that load, from the very first one on:
// pages, windows of terrain and obstacles come and go meanwhile.
TEST(FrameLocks, NothingThatAFrameLocksIsEverLockedByThoseWhoLoad) {
  if (!can_record_locks()) GTEST_SKIP() << "locks are not recorded under a sanitizer";
  const ScratchFolder folder;
  ExampleGround example;
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
  example.bare_sigma0 = example.sigma0;
  example.obstacle = [](Vec2d) { return radar::Obstacle{.solid_top_m = 5.0F}; };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  terrain::build_pyramid(folder.path("terrain"), example.terrain(), {43.0, -3.0});
  const auto ground = std::make_shared<LiveGround>(store,
                                                   std::shared_ptr<terrain::TerrainPyramid>(new terrain::TerrainPyramid(
                                                       terrain::open_pyramid(folder.path("terrain"), 1U << 20U))),
                                                   10e9, CacheOptions{.budget_bytes = std::size_t{64} << 20U});
  ExampleView view{.target = example.middle()};
  LiveRenderer renderer(ground, view.settings(FrameContent::Amplitudes, 1));
  const auto loaded = [&ground] { return ground->pages().report().loaded; };
  const std::uint64_t before = loaded();
  LockedMutexes locked;
  for (int turn = 0; turn < 200 && (loaded() < before + 10 || locked.by_others.empty()); ++turn) {
    const LockedMutexes more = locked_during([&] {
      for (int frame = 0; frame < 10; ++frame) {
        view.azimuth_deg += 3.0;
        view.target.x += 20.0;
        if (frame % 2 == 0)
          renderer.render(view.pose());
        else
          renderer.scan(view.pose(), 8, 16);
      }
    });
    locked.by_caller.insert(more.by_caller.begin(), more.by_caller.end());
    locked.by_others.insert(more.by_others.begin(), more.by_others.end());
  }
  EXPECT_GT(locked.by_others.size(), 2U) << "caches lock what is theirs";
  std::vector<const void*> both;
  std::ranges::set_intersection(locked.by_caller, locked.by_others, std::back_inserter(both));
  EXPECT_TRUE(both.empty()) << both.size() << " mutexes";
  EXPECT_LE(locked.by_caller.size(), 1U) << "there is one of the renderer's own threads";
}

}  // namespace
}  // namespace sigmascape::live
