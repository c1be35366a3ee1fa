#include "sigmascape/atlas/patch_grid.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/error.h"

namespace sigmascape::atlas {
namespace {

TEST(PatchGrid, StoresLevelsDownToOneTile) {
  EXPECT_EQ((PatchGrid{1.0, 256}).stored_levels(), 1U);
  EXPECT_EQ((PatchGrid{1.0, 512}).stored_levels(), 2U);
  EXPECT_EQ((PatchGrid{1.0, 4096}).stored_levels(), 5U);
}

TEST(PatchGrid, TheFirstPatchLiesNorthEastOfTheOrigin) {
  const radar::Rectangle extent = PatchGrid{2.0, 256}.texels_of({0, 0}).extent();
  EXPECT_EQ(extent, (radar::Rectangle{0.0, 0.0, 512.0, 512.0}));
  const radar::Rectangle south_west = PatchGrid{2.0, 256}.texels_of({-1, -1}).extent();
  EXPECT_EQ(south_west, (radar::Rectangle{-512.0, -512.0, 0.0, 0.0}));
}

TEST(PatchGrid, NeighboursShareTheirBorder) {
  const PatchGrid grid{0.5, 512};
  const auto here = grid.texels_of({3, -2}).extent();
  EXPECT_DOUBLE_EQ(grid.texels_of({4, -2}).extent().west_m, here.east_m);
  EXPECT_DOUBLE_EQ(grid.texels_of({3, -1}).extent().south_m, here.north_m);
}

TEST(PatchGrid, APointIsInItsPatch) {
  const PatchGrid grid{2.0, 256};
  EXPECT_EQ(grid.patch_at({1.0, 1.0}), (PatchIndex{0, 0}));
  EXPECT_EQ(grid.patch_at({-1.0, 513.0}), (PatchIndex{-1, 1}));
}

TEST(PatchGrid, PatchesCoverARectangleRowByRowFromTheNorthWest) {
  const PatchGrid grid{1.0, 256};
  const auto patches = grid.covering({-10.0, -300.0, 300.0, 100.0});
  const std::vector<PatchIndex> expected{{-1, 0}, {0, 0},   {1, 0},  {-1, -1}, {0, -1},
                                         {1, -1}, {-1, -2}, {0, -2}, {1, -2}};
  EXPECT_EQ(patches, expected);
}

TEST(PatchGrid, ABlockHoldsThePatchesOfARectangleInTheSameOrder) {
  const PatchGrid grid{1.0, 256};
  const PatchBlock block = grid.block_over({-10.0, -300.0, 300.0, 100.0});
  EXPECT_EQ(block.columns(), 3U);
  EXPECT_EQ(block.rows(), 3U);
  EXPECT_EQ(block[0], (PatchIndex{-1, 0}));
  EXPECT_EQ(block[5], (PatchIndex{1, -1}));
  EXPECT_EQ(grid.block_over({5.0, 5.0, 5.0, 9.0}).size(), 0U);
}

TEST(PatchGrid, ARectangleOfWholePatchesNeedsNoMore) {
  const PatchGrid grid{1.0, 256};
  EXPECT_EQ(grid.covering({-256.0, 0.0, 256.0, 256.0}).size(), 2U);
  EXPECT_TRUE(grid.covering({5.0, 5.0, 5.0, 9.0}).empty());
  // Sides that are no binary fractions.
  EXPECT_EQ((PatchGrid{0.1, 256}.covering({76.8, 76.8, 102.4, 102.4}).size()), 1U);
  EXPECT_EQ((PatchGrid{0.3, 256}.covering({0.0, 0.0, 691.2, 76.8}).size()), 9U);
}

TEST(PatchGrid, TheLatticeDoesNotDependOnWhatIsCovered) {
  const PatchGrid grid{0.7, 256};
  const auto small = grid.covering({100.0, 100.0, 110.0, 110.0});
  const auto large = grid.covering({-900.0, -900.0, 900.0, 900.0});
  ASSERT_EQ(small.size(), 1U);
  EXPECT_NE(std::find(large.begin(), large.end(), small.front()), large.end());
}

TEST(PatchGrid, SidesOtherThanPowersOfTwoAreRefused) {
  EXPECT_NO_THROW(check(PatchGrid{0.5, 1024}, "test"));
  for (const std::size_t side : {0U, 128U, 300U, 768U, 32768U})
    EXPECT_THROW(check(PatchGrid{1.0, side}, "test"), Error);
  for (const double texel_m : {0.0, -1.0, std::nan("")}) EXPECT_THROW(check(PatchGrid{texel_m, 256}, "test"), Error);
}

}  // namespace
}  // namespace sigmascape::atlas
