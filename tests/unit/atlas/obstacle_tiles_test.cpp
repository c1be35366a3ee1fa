#include "sigmascape/atlas/obstacle_tiles.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

#include "example_obstacles.h"
#include "scratch_folder.h"
#include "sealed_item.h"

#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::atlas {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A row of tall houses one texel wide along x = 0.5 m, a tower of its own and a tree; elsewhere nothing.
constexpr float wall_m = 8.0F, tower_m = 64.0F;
constexpr radar::Obstacle tree{.crown_base_m = 2.0F, .crown_top_m = 10.0F, .crown_extinction_per_m = 0.5F};
constexpr Vec2d tower_at{-700.5, -300.5}, tree_at{900.5, 100.5};

radar::ObstacleMap wall_tower_and_tree(const Store& atlas, PatchIndex patch) {
  const radar::GroundGrid texels = atlas.description().patches.texels_of(patch);
  radar::ObstacleMap map{texels, Array2D<radar::Obstacle>(texels.columns, texels.rows)};
  for (std::size_t row = 0; row < texels.rows; ++row) {
    for (std::size_t column = 0; column < texels.columns; ++column) {
      const Vec2d centre = texels.centre_of(column, row);
      if (centre.x == 0.5) map.obstacles(column, row).solid_top_m = wall_m;
      if (centre == tower_at) map.obstacles(column, row).solid_top_m = tower_m;
      if (centre == tree_at) map.obstacles(column, row) = tree;
    }
  }
  return map;
}

class ObstacleTilesTest : public ::testing::Test {
 protected:
  template <typename Example>
  void fill(Example example) {
    for (const PatchIndex& patch : patches_) write_obstacles(atlas_, patch, example(atlas_, patch));
    obstacle_pyramid(atlas_).make_above(patches_);
  }

  /// What stands at a point, by a level.
  static radar::Obstacle at(const ObstacleTiles& tiles, std::size_t level, Vec2d point) {
    const PatchGrid& patches = tiles.description().patches;
    const double tile_m = texel_side_m(patches, level) * static_cast<double>(tile_side);
    const TileAddress tile{level, static_cast<int>(std::floor(point.x / tile_m)),
                           static_cast<int>(std::floor(point.y / tile_m))};
    radar::ObstacleMap map{texels_of(patches, tile), Array2D<radar::Obstacle>(tile_side, tile_side)};
    EXPECT_TRUE(tiles.read(tile, map.obstacles.values())) << level;
    return map.at(point);
  }

  [[nodiscard]] fs::path file_of(const PyramidTile& tile) const { return atlas_.folder() / obstacles_path(tile); }
  /// 32-bit floats without coarser levels, and an item that says nothing of the tallest.
  void write_former_kind(const PyramidTile& tile) const {
    const radar::GroundGrid grid = texels_of(atlas_.description().patches, tile);
    geo::GeoRaster raster{.placement = {grid.west_m, grid.north_m, grid.cell_m, atlas_.description().frame.proj()},
                          .bands = {},
                          .nodata = {},
                          .metadata = {}};
    for (const std::string_view band : obstacle_bands)
      raster.bands.push_back({std::string(band), Array2D<float>(grid.columns, grid.rows)});
    geo::write_geotiff(file_of(tile), raster);
    const TextureRecord record{fs::file_size(file_of(tile)), sha256_of_file(file_of(tile)), 1.0};
    std::ofstream(item_path(file_of(tile)), std::ios::binary)
        << obstacles_item_text(atlas_.description(), tile, obstacles_path(tile), record);
  }
  static void alter(const fs::path& path) {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekg(-100, std::ios::end);
    const auto byte = static_cast<char>(~file.get());
    file.seekp(-100, std::ios::end);
    file.put(byte);
  }

  ScratchFolder folder_;
  Store atlas_ = Store::create(folder_.path("a"), wide_ground_apart());
  std::vector<PatchIndex> patches_ = atlas_.description().patches.covering(atlas_.description().extent);
  std::vector<radar::Obstacle> texels_ = std::vector<radar::Obstacle>(ObstacleTiles::tile_texels);
};

// What the merging rule makes of them in closed form: a wall of one texel is 3/4 as high on squares twice as large, a
// tower half; a tree keeps base and top, and of the larger square half of the lines across and three quarters of those
// upwards miss it.
TEST_F(ObstacleTilesTest, LevelsWithinPatchesAndAboveFollowTheMergingRule) {
  fill(wall_tower_and_tree);
  const ObstacleTiles tiles(atlas_);
  ASSERT_EQ(tiles.levels(), 4U) << "two of patches, two above them";
  auto kappa = static_cast<double>(tree.crown_extinction_per_m);
  const auto height_m = static_cast<double>(tree.crown_top_m - tree.crown_base_m);
  for (std::size_t level = 0; level < tiles.levels(); ++level) {
    const auto k = static_cast<float>(level);
    for (const double y : {-400.0, -100.0, 300.0}) {
      EXPECT_EQ(at(tiles, level, {0.5, y}), (radar::Obstacle{.solid_top_m = wall_m * std::pow(0.75F, k)})) << level;
    }
    EXPECT_EQ(at(tiles, level, tower_at).solid_top_m, tower_m * std::pow(0.5F, k)) << level;
    const radar::Obstacle grove = at(tiles, level, tree_at);
    EXPECT_EQ(grove.crown_base_m, tree.crown_base_m) << level;
    EXPECT_EQ(grove.crown_top_m, tree.crown_top_m) << level;
    EXPECT_NEAR(grove.crown_extinction_per_m, kappa, 1e-3 * kappa) << level;
    const double side_m = texel_side_m(atlas_.description().patches, level);
    kappa = (2.0 * -std::log((1.0 + std::exp(-kappa * side_m)) / 2.0) / (2.0 * side_m) +
             -std::log((3.0 + std::exp(-kappa * height_m)) / 4.0) / height_m) /
            3.0;
    EXPECT_EQ(at(tiles, level, {700.5, -300.5}), radar::Obstacle{}) << "not mirrored";
  }
  EXPECT_EQ(tiles.damaged(), 0U);
}

TEST_F(ObstacleTilesTest, FinestTilesAreThePatchesTexels) {
  fill(example_obstacles);
  const ObstacleTiles tiles(atlas_);
  for (const PatchIndex patch : {PatchIndex{-3, -1}, PatchIndex{0, 0}, PatchIndex{1, -1}}) {
    const Array2D<radar::Obstacle> whole = read_obstacles(atlas_, patch);
    for (const int north : {0, 1}) {
      for (const int east : {0, 1}) {
        ASSERT_TRUE(tiles.read({0, 2 * patch.x + east, 2 * patch.y + north}, texels_));
        for (std::size_t row = 0; row < tile_side; ++row) {
          for (std::size_t column = 0; column < tile_side; ++column) {
            const auto& expected = whole(column + (east == 1 ? 256U : 0U), row + (north == 0 ? 256U : 0U));
            ASSERT_EQ(texels_[row * tile_side + column], expected) << column << ", " << row;
          }
        }
      }
    }
  }
}

TEST_F(ObstacleTilesTest, WhereTheAtlasHasNoPatchNothingStands) {
  fill(example_obstacles);
  const ObstacleTiles tiles(atlas_);
  for (const TileAddress& tile : {TileAddress{0, 4, 0}, TileAddress{0, -7, 0}, TileAddress{1, 0, 1},
                                  TileAddress{1, 0, -2}, TileAddress{2, -3, 0}, TileAddress{3, 1, 0}}) {
    std::ranges::fill(texels_, radar::Obstacle{.solid_top_m = 1.0F});
    EXPECT_TRUE(tiles.read(tile, texels_)) << tile.level << " " << tile.x << " " << tile.y;
    EXPECT_TRUE(std::ranges::all_of(texels_, [](const auto& texel) { return texel == radar::Obstacle{}; }));
  }
  EXPECT_FALSE(tiles.read({4, 0, 0}, texels_)) << "there is no such level";
  EXPECT_FALSE(tiles.read({0, 0, 0}, std::span(texels_).first(10)));
  EXPECT_EQ(tiles.damaged(), 0U);
}

TEST_F(ObstacleTilesTest, DamageIsCountedAndNotRead) {
  fill(example_obstacles);
  alter(file_of({0, {0, 0}}));
  fs::resize_file(file_of({0, {-1, -1}}), 1000);
  fs::remove(file_of({0, {1, 0}}));
  fs::remove(item_path(file_of({0, {-3, 0}})));
  alter(file_of({1, {0, 0}}));
  fs::remove(file_of({1, {-2, -2}}));
  fs::resize_file(file_of({2, {-4, -4}}), 1000);
  const ObstacleTiles tiles(atlas_);
  std::size_t damaged = 0;
  for (const TileAddress& tile :
       {TileAddress{0, 1, 0}, TileAddress{0, -1, -2}, TileAddress{1, 1, 0}, TileAddress{1, -3, 0}, TileAddress{2, 0, 0},
        TileAddress{2, -1, -1}, TileAddress{3, -1, -1}}) {
    EXPECT_FALSE(tiles.read(tile, texels_)) << tile.level << " " << tile.x << " " << tile.y;
    EXPECT_EQ(tiles.damaged(), ++damaged);
  }
  EXPECT_FALSE(tiles.read({0, 0, 1}, texels_)) << "another tile of a file that is counted";
  EXPECT_EQ(tiles.damaged(), damaged);
  EXPECT_TRUE(tiles.read({0, -3, 0}, texels_));
  EXPECT_TRUE(tiles.read({3, 0, 0}, texels_));
  // What was missing may be baked meanwhile.
  write_obstacles(atlas_, {-3, 0}, example_obstacles(atlas_, {-3, 0}));
  EXPECT_TRUE(tiles.read({1, -3, 0}, texels_));
  EXPECT_EQ(tiles.damaged(), damaged - 1);
}

// As after a shortage of open files, or when somebody bakes anew what was damaged.
TEST_F(ObstacleTilesTest, ADamagedFileIsLookedAtAgainAfterAWhile) {
  fill(example_obstacles);
  const fs::path file = obstacles_path({0, {0, 0}});
  const VouchedFiles patient(atlas_, Scrutiny::Content, std::chrono::hours(1));
  const VouchedFiles files(atlas_, Scrutiny::Content, std::chrono::milliseconds(0));
  alter(atlas_.folder() / file);
  for (const VouchedFiles* of : {&patient, &files}) {
    EXPECT_FALSE(of->record_of(file));
    EXPECT_EQ(of->damaged(), 1U);
  }
  alter(atlas_.folder() / file);
  EXPECT_FALSE(patient.record_of(file)) << "not at once";
  EXPECT_TRUE(files.record_of(file));
  EXPECT_EQ(files.damaged(), 0U);
}

TEST_F(ObstacleTilesTest, BySizeAloneAlteredContentIsNotFound) {
  fill(example_obstacles);
  fs::resize_file(file_of({0, {-1, -1}}), 1000);
  const ObstacleTiles tiles(atlas_, Scrutiny::Size);
  EXPECT_FALSE(tiles.read({0, -1, -2}, texels_));
  EXPECT_EQ(tiles.damaged(), 1U);
}

TEST_F(ObstacleTilesTest, TallestIsThatOfTheFinestTexels) {
  fill(wall_tower_and_tree);
  EXPECT_EQ(ObstacleTiles(atlas_).tallest_m(), tower_m) << "though it is 8 m high at the coarsest level";
  // Without the pyramid the items of the patches tell it.
  fs::remove_all(atlas_.folder() / "pyramid_2");
  EXPECT_EQ(ObstacleTiles(atlas_).tallest_m(), tower_m);
  fs::remove_all(atlas_.folder() / "pyramid_1");
  EXPECT_EQ(ObstacleTiles(atlas_).tallest_m(), tower_m);
  fs::remove_all(atlas_.folder() / "patch_-002_-001");
  EXPECT_EQ(ObstacleTiles(atlas_).tallest_m(), tree.crown_top_m) << "a crown counts as well";
}

TEST_F(ObstacleTilesTest, NothingIsTallerThanTheTallest) {
  fill(example_obstacles);
  const ObstacleTiles tiles(atlas_);
  float tallest_m = 0.0F;
  for (std::size_t level = 0; level < tiles.levels(); ++level) {
    for (int y = -4; y < 2; ++y) {
      for (int x = -6; x < 6; ++x) {
        ASSERT_TRUE(tiles.read({level, x, y}, texels_));
        for (const radar::Obstacle& texel : texels_) tallest_m = std::max(tallest_m, texel.top_m());
      }
    }
  }
  EXPECT_EQ(tallest_m, tiles.tallest_m());
}

TEST_F(ObstacleTilesTest, AFormerKindIsToldWhenItIsOpened) {
  fill(example_obstacles);
  fs::remove_all(atlas_.folder() / "pyramid_1");
  fs::remove_all(atlas_.folder() / "pyramid_2");
  const fs::path item = item_path(file_of({0, {1, -1}}));
  rewrite_item(item, "sigmascape:tallest_m", "sigmascape:something");
  EXPECT_THAT(message_of_error([&] { const ObstacleTiles tiles(atlas_); }),
              ::testing::AllOf(HasSubstr("patch_+001_-001/obstacles.tif"), HasSubstr("former kind"),
                               HasSubstr("bake again with the same settings and --verify")));
}

// The levels above do not tell that a patch under them was put there by a former program.
TEST_F(ObstacleTilesTest, AFormerKindUnderNewLevelsIsCountedAndNotRead) {
  fill(example_obstacles);
  const PyramidTile patch{0, {0, 0}};
  write_former_kind(patch);
  const ObstacleTiles tiles(atlas_);
  EXPECT_EQ(tiles.damaged(), 0U);
  EXPECT_FALSE(tiles.read({0, 0, 0}, texels_));
  EXPECT_EQ(tiles.damaged(), 1U);
  EXPECT_FALSE(tiles.read({0, 1, 0}, texels_)) << "another tile of it";
  EXPECT_EQ(tiles.damaged(), 1U);
}

TEST_F(ObstacleTilesTest, ManyThreadsReadWhatOneReads) {
  fill(example_obstacles);
  alter(file_of({0, {0, 0}}));
  const ObstacleTiles tiles(atlas_);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      std::vector<radar::Obstacle> texels(ObstacleTiles::tile_texels);
      for (int x = -6; x < 6; ++x) EXPECT_EQ(tiles.read({0, x, 0}, texels), x != 0 && x != 1);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(tiles.damaged(), 1U);
}

}  // namespace
}  // namespace sigmascape::atlas
