#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include "example_obstacles.h"
#include "example_texels.h"
#include "scratch_folder.h"
#include "sealed_item.h"

#include "sigmascape/atlas/levels_above.h"
#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/atlas/verify.h"
#include "sigmascape/base/error.h"

namespace sigmascape::atlas {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::vector<PatchIndex> patches_of(const Store& atlas) {
  return atlas.description().patches.covering(atlas.description().extent);
}

Store with_all_obstacles(const fs::path& folder) {
  Store atlas = Store::create(folder, wide_ground_apart());
  write_all_obstacles(atlas);
  return atlas;
}

/// Three by two of the first level, two by two of the second.
constexpr std::size_t files_above = 6 + 4;

TEST(ObstaclePyramid, WhoeverMakesItMakesTheSameBytes) {
  const ScratchFolder folder;
  const Store whole = with_all_obstacles(folder.path("whole"));
  EXPECT_EQ(obstacle_pyramid(whole).make_above(patches_of(whole)), files_above);
  EXPECT_EQ(obstacle_pyramid(whole).make_above(patches_of(whole)), 0U);

  // Three shares, one patch at a time from the end, each followed by what became possible with it.
  const Store grown = Store::create(folder.path("grown"), wide_ground_apart());
  const auto patches = patches_of(grown);
  std::size_t written = 0;
  for (std::size_t share = 0; share < 3; ++share) {
    for (std::size_t i = patches.size(); i-- > 0;) {
      if (i % 3 != share) continue;
      write_obstacles(grown, patches[i], example_obstacles(grown, patches[i]));
      written += obstacle_pyramid(grown).make_above({patches[i]});
    }
  }
  EXPECT_EQ(written, files_above);
  EXPECT_EQ(difference_of(files_of(folder.path("grown")), files_of(folder.path("whole"))), "");
}

TEST(ObstaclePyramid, FaultsAreFoundNamedAndMended) {
  const ScratchFolder folder;
  const Store atlas = with_all_obstacles(folder.path("a"));
  const LayerPyramid pyramid = obstacle_pyramid(atlas);
  EXPECT_EQ(pyramid.verify().size(), 6U) << "what can be made and is not there";
  pyramid.make_above(patches_of(atlas));
  EXPECT_TRUE(pyramid.verify().empty());
  const auto whole = files_of(atlas.folder());

  const auto altered = obstacles_path({1, {-4, -2}}), truncated = obstacles_path({1, {0, 0}}),
             missing = obstacles_path({2, {-4, -4}});
  EXPECT_EQ(altered, "pyramid_1/patch_-004_-002/obstacles.tif");
  std::fstream(atlas.folder() / altered, std::ios::binary | std::ios::in | std::ios::out).put('?');
  fs::resize_file(atlas.folder() / truncated, 100);
  fs::remove(atlas.folder() / missing);
  std::map<fs::path, std::string> faults;
  for (const StoreFault& fault : verify(atlas)) {
    if (fault.file.filename() == "obstacles.tif") faults[fault.file] = fault.what;
  }
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_THAT(faults[altered], HasSubstr("SHA-256"));
  EXPECT_THAT(faults[truncated], HasSubstr("is truncated: 100 of"));
  EXPECT_THAT(faults[missing], HasSubstr("is missing"));
  EXPECT_EQ(pyramid.make_above(patches_of(atlas), Scrutiny::Content), 3U);
  EXPECT_EQ(difference_of(files_of(atlas.folder()), whole), "");
}

TEST(ObstaclePyramid, WaitsForWhatIsMissingAndFollowsWhatWasMadeAnew) {
  const ScratchFolder folder;
  const Store atlas = with_all_obstacles(folder.path("a"));
  const LayerPyramid pyramid = obstacle_pyramid(atlas);
  fs::remove(atlas.folder() / obstacles_path({0, {0, 0}}));
  EXPECT_EQ(pyramid.make_above(patches_of(atlas)), files_above - 2);
  EXPECT_FALSE(pyramid.is_done({1, {0, 0}}));
  EXPECT_FALSE(pyramid.is_done({2, {0, 0}}));

  write_obstacles(atlas, {0, 0}, example_obstacles(atlas, {0, 0}));
  EXPECT_EQ(pyramid.make_above({{0, 0}}), 2U);
  EXPECT_TRUE(pyramid.verify().empty());

  radar::ObstacleMap other = example_obstacles(atlas, {0, 0});
  other.obstacles(1, 1).solid_top_m = 100.0F;
  write_obstacles(atlas, {0, 0}, other);
  const auto faults = pyramid.verify();
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults.front().file, obstacles_path({1, {0, 0}}));
  EXPECT_THAT(faults.front().what, HasSubstr("made from other files"));
  EXPECT_EQ(pyramid.make_above({{0, 0}}), 2U);
  EXPECT_EQ(texture_record(atlas, obstacles_path({2, {0, 0}}))->tallest_m, 100.0F);
}

// One patch without obstacles and one whose item does not say how tall they are: two files of the first level wait for
// them, and two of the second for those.
TEST(ObstaclePyramid, WhatIsLeftOutIsToldWithItsCause) {
  const ScratchFolder folder;
  const Store atlas = with_all_obstacles(folder.path("a"));
  const fs::path missing = obstacles_path({0, {-3, 0}}), former = obstacles_path({0, {1, -1}});
  fs::remove(atlas.folder() / missing);
  fs::remove(item_path(atlas.folder() / missing));
  rewrite_item(item_path(atlas.folder() / former), "sigmascape:tallest_m", "sigmascape:something");

  const LevelsAbove made = make_levels_above(atlas);
  EXPECT_EQ(made.written.all(), files_above - 4);
  std::map<fs::path, std::string> causes;
  for (const StoreFault& fault : made.hindrances) {
    if (fault.file.filename() == "obstacles.tif") causes[fault.file] = fault.what;
  }
  ASSERT_EQ(causes.size(), 2U);
  EXPECT_EQ(causes[missing], "is missing");
  EXPECT_THAT(causes[former], HasSubstr("former kind"));
  // Of σ0 the atlas has nothing at all, nor of the ground's own.
  EXPECT_EQ(made.left_out, 4U + files_above + 1U);
  EXPECT_EQ(made.hindrances.size(), 2U + patches_of(atlas).size() + 1U);
}

TEST(ObstaclePyramid, OfAnAtlasThatLostItsGroundThatAloneIsLeftOut) {
  const ScratchFolder folder;
  const Store atlas = with_all_obstacles(folder.path("a"));
  for (const Unit& unit : atlas.units()) atlas.write(unit.patch, unit.look, example_texels(512, unit.look), {});
  const LevelsAbove made = make_levels_above(atlas);
  EXPECT_EQ(made.written.looks, files_above);
  EXPECT_EQ(made.written.obstacles, files_above);
  EXPECT_EQ(made.written.ground, 0U);
  EXPECT_EQ(made.left_out, 1U);
  ASSERT_EQ(made.hindrances.size(), 1U);
  EXPECT_EQ(made.hindrances.front().file, "ground/collection.json");
  EXPECT_EQ(made.hindrances.front().what, "is missing");
}

}  // namespace
}  // namespace sigmascape::atlas
