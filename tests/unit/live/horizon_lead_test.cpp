#include "sigmascape/live/horizon_lead.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

#include "made_obstacles.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/live/horizon_map.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/terrain/height_field.h"
#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::live {
namespace {

/// Level ground between a radar 120 m high and bins 5 km from it, and what stands there on squares of 4 m.
class LeadTest : public testing::Test {
 protected:
  static constexpr atlas::PatchGrid patches{.texel_m = 4.0};
  static constexpr Vec3d radar{0.0, -4000.0, 120.0};

  static HorizonGrid grid() {
    HorizonGrid grid;
    grid.first_azimuth_rad = -0.4;
    grid.azimuths = 200;
    grid.azimuth_step_rad = 0.8 / 199.0;
    grid.near_m = 5000.0;
    grid.step_m = 4.0;
    grid.distances = 200;
    return grid;
  }

  static MadeObstacles made(const std::function<radar::Obstacle(Vec2d)>& obstacle) {
    return {patches, {.level = 0, .west = -4, .north = 3, .across = 8, .down = 8}, obstacle};
  }
  static MadeObstacles halved(const ObstacleMosaic& fine) {
    const double quarter_m = fine.grid().cell_m / 2.0;
    const atlas::TileBlock& block = fine.block();
    return {patches,
            {block.level + 1, block.west / 2, (block.north - 1) / 2, block.across / 2, block.down / 2},
            [&](Vec2d p) {
              const auto at = [&](double east, double north) {
                return fine.at(p + Vec2d{east * quarter_m, north * quarter_m}).unpacked();
              };
              return radar::merged(at(-1.0, 1.0), at(1.0, 1.0), at(-1.0, -1.0), at(1.0, -1.0), fine.grid().cell_m);
            }};
  }

  static Vec2d towards(std::size_t azimuth) {
    return radar::horizontal_direction(grid().first_azimuth_rad +
                                       static_cast<double>(azimuth) * grid().azimuth_step_rad);
  }

  static terrain::TerrainView level_ground() {
    static const terrain::HeightField field{
        .west_m = -5000.0, .north_m = 5000.0, .spacing_m = 100.0, .height_m = Array2D<float>(101, 101, 0.0F)};
    return terrain::view_of(field);
  }

  /// Of the ground under the bins, where nothing stands, the part that is hidden along each direction.
  static std::vector<double> hidden_exactly(const ObstacleMosaic& obstacles) {
    std::vector<double> hidden;
    for (std::size_t azimuth = 0; azimuth < grid().azimuths; ++azimuth) {
      terrain::ObstacleSweep sweep(radar.z);
      for (double distance_m = 2.0; distance_m < grid().near_m - 1.0; distance_m += 4.0) {
        const Vec2d point = Vec2d{radar.x, radar.y} + towards(azimuth) * distance_m;
        sweep.advance(distance_m, 0.0, obstacles.at(point).unpacked(), 4.0);
      }
      hidden.push_back(0.0);
      for (std::size_t k = 0; k < grid().distances; ++k) {
        const double distance_m = grid().near_m + grid().step_m * static_cast<double>(k);
        hidden.back() += 1.0 - static_cast<double>(sweep.advance(distance_m, 0.0, {}, 4.0).ground);
      }
    }
    return hidden;
  }
  /// The same as a map has it that is walked in so many steps up to its first node, over these squares.
  static std::vector<double> hidden_by(const ObstacleMosaic& before, std::size_t steps) {
    HorizonGrid grid = LeadTest::grid();
    grid.before_near = steps;
    ObstacleMosaic nothing;
    nothing.reset(patches, {});
    const Occluders occluders{
        .terrain = level_ground(), .obstacles = &nothing, .tallest_m = 20.0F, .obstacles_before_near = &before};
    HorizonMap map(grid);
    map.reset(grid, true);
    std::vector<double> hidden;
    for (std::size_t azimuth = 0; azimuth < grid.azimuths; ++azimuth) {
      map.sweep(azimuth, radar, occluders);
      hidden.push_back(0.0);
      for (std::size_t k = 0; k < grid.distances; ++k) {
        const double slope = -radar.z / (grid.near_m + grid.step_m * static_cast<double>(k)) + 1e-6;
        const bool open = slope >= static_cast<double>(map.solid_slopes(azimuth)[k]);
        hidden.back() += open ? 1.0 - static_cast<double>(map.through(azimuth)[k]) : 1.0;
      }
    }
    return hidden;
  }
};

/// Blocks on a part of all places.
std::function<radar::Obstacle(Vec2d)> blocks(double side_m, float part, const radar::Obstacle& obstacle) {
  return [=](Vec2d p) {
    const auto key = hashed(static_cast<std::int64_t>(std::floor(p.x / side_m)),
                            static_cast<std::int64_t>(std::floor(p.y / side_m)));
    return unit_float(key) < part ? obstacle : radar::Obstacle{};
  };
}

/// Sum of what is hidden over what should be, and of the differences along each direction over the same.
struct Comparison {
  double sum = 0.0, difference = 0.0;

  Comparison(const std::vector<double>& hidden, const std::vector<double>& exact) {
    double all = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      sum += hidden[i];
      difference += std::abs(hidden[i] - exact[i]);
      all += exact[i];
    }
    sum /= all;
    difference /= all;
  }
};

TEST_F(LeadTest, WhatStandsBeforeTheFirstNodeHidesInLongStepsAsInShortOnes) {
  struct Case {
    const char* name;
    std::function<radar::Obstacle(Vec2d)> obstacle;
    double halved_sum, halved_difference;  ///< at most, of squares twice as wide
  };
  const radar::Obstacle tree{.crown_base_m = 2.0F, .crown_top_m = 15.0F, .crown_extinction_per_m = 0.3F};
  const std::vector<Case> cases{{"houses", blocks(12.0, 0.01F, {.solid_top_m = 9.0F}), 0.1, 0.3},
                                {"blocks", blocks(40.0, 0.02F, {.solid_top_m = 15.0F}), 0.02, 0.03},
                                {"trees", blocks(8.0, 0.02F, tree), 0.03, 0.1},
                                {"woods", blocks(100.0, 0.05F, {0.0F, 2.0F, 20.0F, 0.05F}), 0.03, 0.03}};
  for (const Case& c : cases) {
    const MadeObstacles fine = made(c.obstacle), half = halved(fine.mosaic());
    const std::vector<double> exact = hidden_exactly(fine.mosaic());
    // Of 4, 13 and 26 m; the squares are of 4 and 8 m.
    for (const std::size_t steps : {256UL, 64UL, 32UL}) {
      const Comparison on_fine(hidden_by(fine.mosaic(), steps), exact), on_half(hidden_by(half.mosaic(), steps), exact);
      EXPECT_NEAR(on_fine.sum, 1.0, 0.03) << c.name << ", " << steps << " steps";
      EXPECT_LT(on_fine.difference, 0.07) << c.name << ", " << steps << " steps";
      EXPECT_NEAR(on_half.sum, 1.0, c.halved_sum) << c.name << ", " << steps << " steps";
      EXPECT_LT(on_half.difference, c.halved_difference) << c.name << ", " << steps << " steps";
    }
  }
}

/// A wood 100 m deep, 20 m high and open up to 2 m hides what stands behind it by as much of it as lies in between.
TEST_F(LeadTest, CrownsHideWhatStandsHigherByTheWayThroughThemAlone) {
  const MadeObstacles wood = made([](Vec2d p) {
    const double distance_m = length(p - Vec2d{radar.x, radar.y});
    return distance_m > 5100.0 && distance_m < 5200.0 ? radar::Obstacle{0.0F, 2.0F, 20.0F, 0.01F} : radar::Obstacle{};
  });
  const Occluders occluders{.terrain = level_ground(), .obstacles = &wood.mosaic(), .tallest_m = 20.0F};
  HorizonMap map(grid());
  map.reset(grid(), true);
  constexpr std::size_t azimuth = 100, node = 100;
  map.sweep(azimuth, radar, occluders);
  const double distance_m = grid().near_m + grid().step_m * static_cast<double>(node);
  const auto through = [&](double height_m) {
    return map.through_from(azimuth, node, (height_m - radar.z) / distance_m, radar, occluders);
  };
  EXPECT_NEAR(through(0.0), static_cast<double>(map.through(azimuth)[node]), 0.03);
  EXPECT_NEAR(through(5.0), std::exp(-1.0), 0.03);
  // 120 m − 104.2 m · d / 5400 m comes down to 20 m at 5182 m, 18 m before the end of the wood.
  EXPECT_NEAR(through(15.8), std::exp(-0.18), 0.03);
  EXPECT_EQ(through(25.0), 1.0);
  EXPECT_EQ(through(130.0), 1.0);
}

/// Also where the radar flies below the top of a hill somewhere else.
TEST_F(LeadTest, CrownsHideGroundHoweverHighTheTerrainIsElsewhere) {
  const MadeObstacles wood = made([](Vec2d p) {
    const double distance_m = length(p - Vec2d{radar.x, radar.y});
    return distance_m > 5100.0 && distance_m < 5200.0 ? radar::Obstacle{0.0F, 2.0F, 20.0F, 0.01F} : radar::Obstacle{};
  });
  constexpr std::size_t azimuth = 100, behind = 75;
  for (const float highest_m : {0.0F, 115.0F, 125.0F, 500.0F}) {
    terrain::TerrainView ground = level_ground();
    ground.highest_m = highest_m;
    const Occluders occluders{.terrain = ground, .obstacles = &wood.mosaic(), .tallest_m = 20.0F};
    HorizonMap map(grid());
    map.reset(grid(), true);
    map.sweep(azimuth, radar, occluders);
    // From 5300 m the line of sight is 4.5 to 2.3 m above the ground within the wood.
    EXPECT_NEAR(map.through(azimuth)[behind], std::exp(-1.0), 0.02) << highest_m;
    EXPECT_EQ(map.through(azimuth)[20], 1.0F) << highest_m;
  }
}

/// A point is hidden by what stands before it, wherever between two nodes it lies.
TEST_F(LeadTest, WhatStandsBetweenANodeAndAPointHidesIt) {
  const auto seen = [](const MadeObstacles& obstacles, double first_m, double distance_m, double height_m) {
    HorizonGrid coarse = grid();
    coarse.near_m = first_m;
    coarse.step_m = 40.0;
    coarse.distances = 20;
    const Occluders occluders{.terrain = level_ground(), .obstacles = &obstacles.mosaic(), .tallest_m = 20.0F};
    HorizonMap map(coarse);
    map.reset(coarse, true);
    constexpr std::size_t azimuth = 100;
    map.sweep(azimuth, radar, occluders);
    const auto node = static_cast<std::size_t>((distance_m - first_m) / coarse.step_m);
    const double slope = (height_m - radar.z) / distance_m;
    if (map.is_behind_solid(azimuth, distance_m, slope, 0.0, radar, occluders)) return 0.0;
    return map.through_from(azimuth, node, slope, radar, occluders) *
           map.through_beyond(azimuth, node, distance_m, slope, radar, occluders);
  };
  const auto between = [](double near_m, double far_m, const radar::Obstacle& obstacle) {
    return made([=](Vec2d p) {
      const double distance_m = length(p - Vec2d{radar.x, radar.y});
      return distance_m > near_m && distance_m < far_m ? obstacle : radar::Obstacle{};
    });
  };
  const MadeObstacles wood = between(5100.0, 5200.0, {0.0F, 0.0F, 20.0F, 0.02F}),
                      house = between(5160.0, 5172.0, {.solid_top_m = 12.0F});
  for (double first_m = 4960.0; first_m < 5000.0; first_m += 3.0) {
    EXPECT_NEAR(seen(wood, first_m, 5175.0, 5.0), std::exp(-0.02 * 75.0), 0.03) << first_m;
    EXPECT_EQ(seen(house, first_m, 5178.0, 1.0), 0.0) << first_m;
    EXPECT_EQ(seen(house, first_m, 5178.0, 20.0), 1.0) << first_m;
    EXPECT_EQ(seen(house, first_m, 5155.0, 1.0), 1.0) << first_m;
  }
}

TEST_F(LeadTest, AMapOfNoLengthBelowTheRadarHasNoLead) {
  HorizonGrid grid = LeadTest::grid();
  grid.near_m = grid.step_m = 0.0;
  EXPECT_EQ(lead_of(grid, radar, {.terrain = level_ground()}).count, 0U);
}

}  // namespace
}  // namespace sigmascape::live
