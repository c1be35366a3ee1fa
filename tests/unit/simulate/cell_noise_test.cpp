#include "sigmascape/simulate/cell_noise.h"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <utility>

namespace sigmascape::simulate {
namespace {

constexpr std::uint32_t most = 8;

/// 32 × 32 cells of 2 m, of which bins of a level radar far in the south cover the western half; every bin holds 1 m².
class CellNoiseTest : public testing::Test {
 protected:
  CellNoiseTest() {
    for (std::int32_t j = 0; j < 32; ++j) {
      for (std::int32_t i = 0; i < 32; ++i) launch_.cells.push_back({i, j});
    }
    radar::RangeAzimuthImage image{grid_, {32.0, -distance_m, 0.0}, {grid_.azimuths, grid_.ranges}};
    for (radar::Channels& bin : image.rcs_m2.values()) bin.vv = 1.0F;
    map_.add(image);
  }

  /// An echo of a ray of that cell, from its middle.
  void bring(CellNoise& noise, const trace::LaunchCell& cell, double rcs_m2, std::uint8_t bounces = 1) const {
    const double x_m = 2.0 * cell.i + 1.0 - 32.0, y_m = 2.0 * cell.j + 1.0 + distance_m;
    const radar::Echo echo{.range_m = std::hypot(x_m, y_m),
                           .cross = std::atan2(x_m, y_m),
                           .rcs_m2 = {.vv = static_cast<float>(rcs_m2)},
                           .bounces = bounces};
    noise.add(cell, {&echo, 1}, 0);
  }

  /// By cell, but for LaunchCell::share.
  [[nodiscard]] static std::map<std::pair<int, int>, double> rays(const CellNoise& noise) {
    std::map<std::pair<int, int>, double> rays;
    for (const LaunchShare& share : noise.shares(most)) {
      for (const trace::LaunchCell& cell : share.cells)
        rays[{cell.i, cell.j}] = static_cast<double>(share.samples_per_cell) / share.one_in;
    }
    return rays;
  }

  static constexpr double distance_m = 20e3;
  radar::RangeAzimuthGrid grid_{.first_range_m = distance_m - 20.0,
                                .range_step_m = 1.0,
                                .ranges = 104,
                                .first_azimuth_rad = -52.0 / distance_m,
                                .azimuth_step_rad = 1.0 / distance_m,
                                .azimuths = 104};
  trace::LaunchArea launch_{.cell_m = 2.0,
                            .plane_height_m = 0.0,
                            .top_height_m = 0.0,
                            .cells = {},
                            .viewpoint = trace::Viewpoint::located({32.0, -distance_m, 0.0}),
                            .target = {0.0, 0.0, 32.0, 64.0},
                            .reach = {},
                            .rings = {},
                            .shares = {}};
  PassSums map_{grid_, {32.0, -distance_m, 0.0}, {0.0, 0.0, 32.0, 64.0}, 0.0};
};

TEST_F(CellNoiseTest, RaysAreForTheArea) {
  CellNoise noise(launch_, map_, most, 1);
  for (const trace::LaunchCell& cell : launch_.cells) bring(noise, cell, 1.0);
  const auto given = rays(noise);
  ASSERT_EQ(given.size(), launch_.cells.size());
  EXPECT_EQ(given.at({8, 16}), most);
  EXPECT_EQ(given.at({24, 16}), 0.25);
}

TEST_F(CellNoiseTest, WhatACellHasNotSeenItsNeighboursMayHave) {
  CellNoise noise(launch_, map_, most, 1);
  bring(noise, {8, 16}, 1.0);
  const auto given = rays(noise);
  for (const int away : {-2, 2}) {
    EXPECT_EQ(given.at({8 + away, 16}), most);
    EXPECT_EQ(given.at({8, 16 + away}), most);
  }
  EXPECT_EQ(given.at({11, 16}), 0.25);
  EXPECT_EQ(given.at({8, 13}), 0.25);
}

TEST_F(CellNoiseTest, QuietCellsGetTheirPart) {
  CellNoise noise(launch_, map_, most, 1);
  for (const trace::LaunchCell& cell : launch_.cells) bring(noise, cell, cell.j < 10 ? std::sqrt(0.2) : 1.0);
  const auto given = rays(noise);
  EXPECT_EQ(given.at({8, 20}), most);
  // Twice its noise over the median's, of 8 rays: 3.2, rounded up.
  EXPECT_EQ(given.at({8, 4}), 4.0);
}

TEST_F(CellNoiseTest, WhatIsSeenDirectlyIsNotLeftToLots) {
  for (const std::uint8_t bounces : {std::uint8_t{1}, std::uint8_t{2}}) {
    CellNoise noise(launch_, map_, most, 1);
    for (const trace::LaunchCell& cell : launch_.cells) bring(noise, cell, cell.j < 10 ? 0.01 : 1.0, bounces);
    EXPECT_EQ(rays(noise).at({8, 4}), bounces == 1 ? 1.0 : 0.25);
  }
}

TEST_F(CellNoiseTest, CellsAboutTheTargetGetNoMoreThanTheirShare) {
  for (trace::LaunchCell& cell : launch_.cells) cell.share = cell.j < 10 ? 0.125F : 1.0F;
  CellNoise noise(launch_, map_, most, 1);
  // What one ray in place of eight brings counts eightfold.
  for (const trace::LaunchCell& cell : launch_.cells) bring(noise, cell, cell.j < 10 ? 0.1 : 1.0, 2);
  const auto given = rays(noise);
  EXPECT_EQ(given.at({8, 20}), most);
  EXPECT_EQ(given.at({8, 4}), most);
}

TEST_F(CellNoiseTest, WhereNothingAnswersAFewRaysGoOnLooking) {
  const CellNoise noise(launch_, map_, most, 1);
  const auto shares = noise.shares(most);
  ASSERT_EQ(shares.size(), 1U);
  EXPECT_EQ(shares.front().samples_per_cell, 1U);
  EXPECT_EQ(shares.front().one_in, 4U);
  EXPECT_EQ(shares.front().cells.size(), launch_.cells.size());
}

}  // namespace
}  // namespace sigmascape::simulate
