#include "sigmascape/atlas/tile_block.h"

#include <gtest/gtest.h>

namespace sigmascape::atlas {
namespace {

/// Tiles of 256 m at level 0, of 512 m at level 1.
constexpr PatchGrid patches{.texel_m = 1.0, .texels_per_side = 1024};

TEST(TileBlock, HoldsTheTilesThatShareGroundWithAnArea) {
  static_assert(tile_side == 256);
  const TileBlock tiles = tiles_over(patches, {-1.0, 10.0, 300.0, 600.0}, 0);
  EXPECT_EQ(tiles.across, 3U);
  EXPECT_EQ(tiles.down, 3U);
  EXPECT_EQ(tiles.at(0, 0), (TileAddress{0, -1, 2})) << "north-west";
  EXPECT_EQ(tiles.at(tiles.size() - 1), (TileAddress{0, 1, 0})) << "south-east";
  const TileBlock coarser = tiles_over(patches, {-1.0, 10.0, 300.0, 600.0}, 1);
  EXPECT_EQ(coarser.size(), 4U);
  EXPECT_EQ(coarser.at(0), (TileAddress{1, -1, 1}));
}

TEST(TileBlock, TilesThatOnlyTouchAnEdgeAreNotOfIt) {
  const TileBlock tiles = tiles_over(patches, {256.0, -256.0, 512.0, 0.0}, 0);
  ASSERT_EQ(tiles.size(), 1U);
  EXPECT_EQ(tiles.at(0), (TileAddress{0, 1, -1}));
}

TEST(TileBlock, NothingIsOverNoArea) {
  EXPECT_EQ(tiles_over(patches, {0.0, 0.0, 0.0, 100.0}, 0).size(), 0U);
  EXPECT_EQ(tiles_over(patches, {100.0, 0.0, 50.0, 100.0}, 0).size(), 0U) << "as two areas apart have it in common";
}

TEST(TileBlock, ATilesNumberFindsItAgain) {
  const TileBlock tiles = tiles_over(patches, {-300.0, -300.0, 300.0, 700.0}, 0);
  for (std::size_t number = 0; number < tiles.size(); ++number) EXPECT_EQ(tiles.number_of(tiles.at(number)), number);
  EXPECT_FALSE(tiles.number_of({0, tiles.west - 1, tiles.north}));
  EXPECT_FALSE(tiles.number_of({0, tiles.west, tiles.north + 1}));
  EXPECT_FALSE(tiles.number_of({0, tiles.west + static_cast<int>(tiles.across), tiles.north}));
  EXPECT_FALSE(tiles.number_of({0, tiles.west, tiles.north - static_cast<int>(tiles.down)}));
  EXPECT_FALSE(tiles.number_of({1, tiles.west, tiles.north}));
}

}  // namespace
}  // namespace sigmascape::atlas
