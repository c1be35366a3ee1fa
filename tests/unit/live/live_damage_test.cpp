#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>

#include "frame_numbers.h"
#include "live_ground_example.h"

#include "sigmascape/atlas/pyramid.h"

namespace sigmascape::live {
namespace {

/// What can happen to a texture on a disk.
enum class Damage { Missing, Truncated, Altered };

void damage(const std::filesystem::path& file, Damage how) {
  const auto size = std::filesystem::file_size(file);
  if (how == Damage::Missing) std::filesystem::remove(file);
  if (how == Damage::Truncated) std::filesystem::resize_file(file, size / 2);
  if (how != Damage::Altered) return;
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekg(static_cast<std::streamoff>(size / 2));
  const auto was = static_cast<char>(stream.get());
  stream.seekp(static_cast<std::streamoff>(size / 2));
  stream.put(static_cast<char>(was ^ 0x55));
}

class LiveDamage : public testing::TestWithParam<Damage> {};

TEST_P(LiveDamage, OfATextureGivesALowerLevelAndIsTold) {
  const ScratchFolder folder;
  ExampleGround example;
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(example_gamma, look); };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const ExampleView view;

  const auto whole = example.over(store);
  LiveRenderer before(whole, view.settings(FrameContent::Powers));
  const Frame& sound = settled_frame(before, *whole, view.pose());
  ASSERT_EQ(sound.report.coarse + sound.report.dark, 0U);
  EXPECT_EQ(whole->pages().report().damaged, 0U);
  const double power = total_vv(sound);

  // One look of one patch; the pyramid above was made of it when it was sound.
  const atlas::LookIndex look = store.description().aspects.index_of(0, 1, 0);
  damage(store.folder() / store.texture_path({0, 0}, look), GetParam());
  const auto ground = example.over(store);
  LiveRenderer after(ground, view.settings(FrameContent::Powers));
  const Frame& frame = settled_frame(after, *ground, view.pose());
  EXPECT_EQ(frame.report.dark, 0U);
  EXPECT_GT(frame.report.coarse, 0U);
  EXPECT_LT(frame.report.coarse, frame.report.cells);
  EXPECT_NEAR(db_from_linear(total_vv(frame) / power), 0.0, 0.01);
  const CacheReport report = ground->pages().report();
  EXPECT_GT(report.absent, 0U);
  EXPECT_EQ(report.damaged, 1U);
}

/// Bare ground with blocks of houses on it, 24 m wide.
ExampleGround blocks_of_houses() {
  ExampleGround example;
  example.sigma0 = [](const radar::Look&) { return radar::Channels{}; };
  example.bare_sigma0 = [](const radar::Look& look) { return constant_gamma(example_gamma, look); };
  example.obstacle = [](Vec2d p) {
    return std::abs(std::remainder(p.x, 96.0)) < 12.0 && std::abs(std::remainder(p.y, 96.0)) < 12.0
               ? radar::Obstacle{.solid_top_m = 12.0F}
               : radar::Obstacle{};
  };
  return example;
}

class LiveObstacleDamage : public LiveDamage {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    (void)blocks_of_houses().store(folder_->path("sound"));
  }
  static void TearDownTestSuite() { folder_.reset(); }

  /// Of the middle of an atlas, settled.
  struct Seen {
    double power = 0.0;
    FrameReport report;
    CacheReport obstacles;
  };
  static Seen seen_of(const std::filesystem::path& atlas) {
    const ExampleView view{.elevation_deg = 8.6};
    const auto ground = blocks_of_houses().over(atlas::Store::open(atlas));
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    const Frame& frame = settled_frame(renderer, *ground, view.pose());
    return {total_vv(frame), frame.report, ground->obstacles()->cache().report()};
  }

  static inline std::unique_ptr<ScratchFolder> folder_;
};

TEST_P(LiveObstacleDamage, GivesTheShadowsOfALowerLevelAndIsTold) {
  const auto atlas = folder_->path("altered");
  std::filesystem::remove_all(atlas);
  std::filesystem::copy(folder_->path("sound"), atlas, std::filesystem::copy_options::recursive);
  const Seen sound = seen_of(atlas);
  EXPECT_EQ(sound.report.coarse_obstacles, 0U);
  EXPECT_EQ(sound.obstacles.damaged, 0U);

  for (const char* patch : {"patch_+000_+000", "patch_+001_+000", "patch_+000_+001", "patch_+001_+001"}) {
    damage(atlas / patch / "obstacles.tif", GetParam());
  }
  const Seen damaged = seen_of(atlas);
  EXPECT_EQ(damaged.report.dark + damaged.report.coarse, 0U);
  EXPECT_GE(damaged.report.coarse_obstacles, 4U);
  EXPECT_EQ(damaged.obstacles.damaged, 4U);

  damage(atlas / "pyramid_1" / "patch_+000_+000" / "obstacles.tif", GetParam());
  const Seen bare = seen_of(atlas);
  EXPECT_EQ(bare.obstacles.damaged, 5U);
  // Coarser obstacles keep the shadowed area, but hide ground beside them.
  const double hidden = bare.power - sound.power;
  EXPECT_GT(hidden / bare.power, 0.2);
  EXPECT_NEAR((bare.power - damaged.power) / hidden, 1.0, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Damages, LiveObstacleDamage,
                         testing::Values(Damage::Missing, Damage::Truncated, Damage::Altered));

INSTANTIATE_TEST_SUITE_P(Damages, LiveDamage, testing::Values(Damage::Missing, Damage::Truncated, Damage::Altered));

TEST(LiveDamage, OfTheCoarsestLevelLeavesTheRest) {
  const ScratchFolder folder;
  ExampleGround example;
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(example_gamma, look); };
  const atlas::Store store = example.store(folder.path("atlas"));
  const atlas::Pyramid pyramid(store);
  pyramid.make_above(store.units());
  for (const atlas::PyramidTile& tile : pyramid.tiles(pyramid.levels())) {
    for (atlas::LookIndex look = 0; look < store.description().aspects.look_count(); ++look) {
      damage(store.folder() / pyramid.texture_path(tile, look), Damage::Truncated);
    }
  }
  const auto ground = example.over(store);
  const ExampleView view;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  EXPECT_EQ(frame.report.dark + frame.report.coarse, 0U);
}

}  // namespace
}  // namespace sigmascape::live
