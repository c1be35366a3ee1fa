#include "sigmascape/live/terrain_windows.h"

#include <array>
#include <chrono>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include "sigmascape/base/error.h"

namespace sigmascape::live {
namespace {

using terrain::HeightTile;
using terrain::TileKey;

/// Two levels of flat ground; `reading` is asked before a tile is read.
class TerrainWindowsTest : public ::testing::Test {
 protected:
  static constexpr terrain::PyramidLayout layout{
      .west_m = 0.0, .north_m = 1024.0, .spacing_m = 2.0, .tiles_across = 2, .tiles_down = 2};

  std::shared_ptr<terrain::TerrainPyramid> pyramid() {
    std::vector<Array2D<terrain::TileSummary>> summaries;
    for (int level = 0; level < layout.levels(); ++level)
      summaries.emplace_back(layout.across(level), layout.down(level), terrain::TileSummary{3.0F, 3.0F, 1.0F});
    return std::make_shared<terrain::TerrainPyramid>(
        layout, layout.extent(), std::move(summaries),
        [this](TileKey key) {
          reading(key);
          return std::make_shared<const HeightTile>(
              HeightTile{std::vector<float>(HeightTile::nodes * HeightTile::nodes, 3.0F), {3.0F, 3.0F, 0.0F}});
        },
        64 * HeightTile::bytes, std::chrono::milliseconds(1));
  }

  std::function<void(TileKey)> reading = [](TileKey) {};
  const std::array<WindowWish, 1> whole{WindowWish{0, {10.0, 10.0, 1000.0, 1000.0}}};
};

TEST_F(TerrainWindowsTest, AreMadeAnewWhenTilesThatCouldNotBeHadAreThere) {
  bool is_short = true;
  reading = [&](TileKey key) {
    if (is_short && key == TileKey{0, 1, 1}) throw Error("0_1_1", "cannot be read", "try again");
  };
  TerrainWindows windows(pyramid(), 64U << 20U);
  windows.load(whole);
  {
    const TerrainWindows::View view = windows.view();
    const GroundWindow* const part = view.find(whole[0]);
    ASSERT_NE(part, nullptr);
    EXPECT_GT(part->error_m, 0.0F);
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    EXPECT_TRUE(part->is_worth_another_try());
  }
  is_short = false;
  windows.load(whole);
  const TerrainWindows::View view = windows.view();
  const GroundWindow* const found = view.find(whole[0]);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->error_m, 0.0F);
  EXPECT_FALSE(found->is_worth_another_try());
}

TEST_F(TerrainWindowsTest, DoNotGatherWhereATileIsNeverThere) {
  reading = [](TileKey key) {
    if (key == TileKey{0, 1, 1}) throw Error("0_1_1", "cannot be read", "try again");
  };
  TerrainWindows windows(pyramid(), 64U << 20U);
  windows.load(whole);
  const std::size_t of_one = windows.bytes();
  for (int again = 0; again < 6; ++again) {
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    windows.load(whole);
  }
  EXPECT_LE(windows.bytes(), 2 * of_one) << "the last and one that may still be looked at";
}

TEST_F(TerrainWindowsTest, GoOnWhereThereIsNoMemoryForOne) {
  bool is_short = false;
  reading = [&](TileKey) {
    if (is_short) throw std::bad_alloc();
  };
  TerrainWindows windows(pyramid(), 64U << 20U);
  is_short = true;
  windows.load(whole);
  EXPECT_EQ(windows.view().find(whole[0]), nullptr);
  is_short = false;
  windows.load(whole);
  EXPECT_NE(windows.view().find(whole[0]), nullptr);
}

}  // namespace
}  // namespace sigmascape::live
