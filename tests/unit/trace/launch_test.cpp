#include "sigmascape/trace/launch.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>
#include <vector>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::trace {
namespace {

constexpr radar::Rectangle target{-310.0, -140.0, 120.0, 190.0};
constexpr double top_m = 60.0;

double radians(double degrees) {
  return radians_from_deg(degrees);
}

/// Where on the plane z = 0 an echo of a point stands for a radar that knows nothing of heights.
struct Landing {
  Viewpoint viewpoint;
  Vec3d radar;  // a located one
  bool distant = true;
  radar::Aspect aspect;

  [[nodiscard]] Vec2d operator()(Vec3d p) const {
    const double range = viewpoint.range_of(p), across = viewpoint.cross_of(p);
    if (distant) {
      const Vec2d towards = radar::horizontal_direction(aspect.azimuth_rad);
      return towards * (-range / std::cos(aspect.elevation_rad)) + Vec2d{-towards.y, towards.x} * across;
    }
    const double ground = std::sqrt(range * range - radar.z * radar.z);
    return Vec2d{radar.x, radar.y} + radar::horizontal_direction(across) * ground;
  }
};

std::vector<Landing> viewpoints() {
  std::vector<Landing> all;
  for (const double elevation_deg : {5.0, 21.0, 60.0, 85.0}) {
    for (const double azimuth_deg : {0.0, 33.0, 90.0, 215.0}) {
      const radar::Aspect aspect{radians(azimuth_deg), radians(elevation_deg)};
      all.push_back({Viewpoint::distant(aspect), {}, true, aspect});
      for (const double range_m : {1500.0, 20'000.0}) {
        const Vec3d place = radar::position_seeing({}, aspect.azimuth_rad, aspect.elevation_rad, range_m);
        if (place.z > 2.0 * top_m) all.push_back({Viewpoint::located(place), place, false, aspect});
      }
    }
  }
  return all;
}

std::string description(const Landing& landing) {
  return fmt::format("{} from azimuth {}°, elevation {}°, height {} m", landing.distant ? "distant" : "located",
                     deg_from_radians(landing.aspect.azimuth_rad), deg_from_radians(landing.aspect.elevation_rad),
                     landing.radar.z);
}

bool covers(const LaunchArea& area, Vec2d point) {
  return area.share_at(point) > 0.0F;
}

TEST(LaunchArea, EveryRayThatLandsInTheTargetIsLaunched) {
  for (const Landing& landing : viewpoints()) {
    const LaunchArea area = launch_area(landing.viewpoint, target, 4.0, 0.0, top_m, {});
    const std::set<std::pair<int, int>> cells = [&] {
      std::set<std::pair<int, int>> set;
      for (const LaunchCell cell : area.cells) set.insert({cell.i, cell.j});
      return set;
    }();
    std::size_t landed = 0;
    for (std::uint64_t k = 0; k < 20'000; ++k) {
      const auto draw = [k](std::uint64_t dimension) { return static_cast<double>(unit_float(hashed(k, dimension))); };
      const Vec3d hit{-1200.0 + 2400.0 * draw(0), -1200.0 + 2400.0 * draw(1), top_m * draw(2)};
      if (!target.contains(landing(hit))) continue;
      ++landed;
      const Vec2d aim = landing.viewpoint.shadow_on_plane(hit, 0.0);
      ASSERT_TRUE(covers(area, aim)) << description(landing) << ": hit " << hit.x << " " << hit.y << " " << hit.z;
      ASSERT_TRUE(
          cells.contains({static_cast<int>(std::floor(aim.x / 4.0)), static_cast<int>(std::floor(aim.y / 4.0))}))
          << description(landing) << ": hit " << hit.x << " " << hit.y << " " << hit.z;
    }
    EXPECT_GT(landed, 100U) << description(landing);
  }
}

// What is told of a cell once is what every place says that its rays can come to.
TEST(LaunchArea, CellsCountAlwaysWhereAllThatTheirRaysMeetCounts) {
  std::size_t always = 0, not_always = 0;
  for (const Landing& landing : viewpoints()) {
    const LaunchArea area = launch_area(landing.viewpoint, target, 4.0, 0.0, top_m, {});
    for (std::size_t k = 0; k < area.cells.size(); k += 7) {
      const LaunchCell& cell = area.cells[k];
      if (!area.counts_always({&cell, 1})) {
        ++not_always;
        continue;
      }
      ++always;
      for (const Vec2d within : {Vec2d{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {0.3, 0.6}}) {
        const Vec3d aim{(cell.i + within.x) * 4.0, (cell.j + within.y) * 4.0, 0.0};
        const Vec3d to_radar = landing.viewpoint.direction_from(aim);
        for (const double height_m : {0.0, 0.4 * top_m, top_m})
          ASSERT_TRUE(area.counts_from(aim + to_radar * (height_m / to_radar.z))) << description(landing);
      }
    }
  }
  EXPECT_GT(always, 1000U);
  EXPECT_GT(not_always, 1000U);
}

TEST(LaunchArea, CoversExactlyTheCellsListed) {
  for (const Landing& landing : viewpoints()) {
    const LaunchArea area = launch_area(landing.viewpoint, target, 8.0, 0.0, top_m, {16.0, 16.0});
    std::set<std::pair<int, int>> cells;
    for (const LaunchCell cell : area.cells) cells.insert({cell.i, cell.j});
    EXPECT_EQ(cells.size(), area.cells.size()) << "a cell is listed twice: " << description(landing);
    std::size_t covered = 0;
    for (int j = -300; j < 300; ++j) {
      for (int i = -300; i < 300; ++i) {
        const Vec2d corner{8.0 * i, 8.0 * j};
        const bool listed = cells.contains({i, j});
        covered += listed ? 1U : 0U;
        EXPECT_EQ(covers(area, corner + Vec2d{0.1, 7.9}), listed);
        EXPECT_EQ(covers(area, corner + Vec2d{7.9, 0.1}), listed);
      }
    }
    EXPECT_EQ(covered, cells.size()) << description(landing);
  }
}

TEST(LaunchArea, LaunchesNothingBeforeTheTargetAndLittleBeside) {
  const LaunchArea area = launch_area(Viewpoint::distant({radians(180.0), radians(10.0)}), target, 1.0, 0.0, top_m, {});
  const double reach_m = top_m / std::tan(radians(10.0)) + top_m * std::tan(radians(10.0));
  EXPECT_FALSE(covers(area, {0.0, target.south_m - 3.0}));
  EXPECT_TRUE(covers(area, {0.0, target.north_m + reach_m - 3.0}));
  EXPECT_FALSE(covers(area, {0.0, target.north_m + reach_m + 3.0}));
  EXPECT_FALSE(covers(area, {target.west_m - 3.0, 0.0}));
  EXPECT_NEAR(static_cast<double>(area.cells.size()), (target.width_m() + 2.0) * (target.height_m() + 2.0 + reach_m),
              1500.0);
}

TEST(LaunchArea, AimsAtTheTargetAndBehindItAlone) {
  const double elevation = radians(10.0);
  const double reach_m = top_m / std::tan(elevation) + top_m * std::tan(elevation);
  const LaunchArea distant =
      launch_outline(Viewpoint::distant({radians(180.0), elevation}), target, 1.0, 0.0, top_m, {});
  // Of lines of sight along its edges, and askew over them: as wide as the target looks from there, times the reach.
  EXPECT_NEAR(aimed_area_m2(distant), target.width_m() * (target.height_m() + reach_m), 1e-3 * aimed_area_m2(distant));
  const LaunchArea askew = launch_outline(Viewpoint::distant({radians(230.0), elevation}), target, 1.0, 0.0, top_m, {});
  const double looks_wide_m = target.width_m() * std::cos(radians(50.0)) + target.height_m() * std::sin(radians(50.0));
  EXPECT_NEAR(aimed_area_m2(askew), target.width_m() * target.height_m() + looks_wide_m * reach_m,
              3e-3 * aimed_area_m2(askew));
  // Seen from a place the shadow of the top over the far edge is longer by the ratio of heights: similar triangles.
  const Vec3d radar{0.0, -2000.0, 80.0};
  const LaunchArea behind = launch_area(Viewpoint::located(radar), target, 4.0, 0.0, top_m, {});
  const double far_m = target.north_m - radar.y, stands_m = std::sqrt(far_m * far_m + 80.0 * 80.0 - 20.0 * 20.0);
  const double end_m = radar.y + stands_m * 80.0 / 20.0;
  EXPECT_TRUE(covers(behind, {0.0, end_m - 6.0}));
  EXPECT_FALSE(covers(behind, {0.0, end_m + 26.0}));  // four times the rim
  EXPECT_FALSE(covers(behind, {0.0, target.south_m - 9.0}));
}

// Cells are listed in a rim of one about what rays are aimed at.
TEST(LaunchArea, AimsAtAsManyCellsAsItLists) {
  for (const Landing& landing : viewpoints()) {
    const LaunchArea area = launch_area(landing.viewpoint, target, 2.0, 0.0, top_m, {24.0, 16.0});
    const double listed_m2 = static_cast<double>(area.cells.size()) * 4.0;
    EXPECT_LT(aimed_area_m2(area), listed_m2) << description(landing);
    EXPECT_GT(aimed_area_m2(area), 0.95 * listed_m2) << description(landing);
  }
}

// Below 900 m the strip is fifteen times as long. Askew to the lattice the rectangle about it would be larger still.
TEST(LaunchArea, ListsNoMoreThanWhatLiesBehindTheHighestThatCounts) {
  for (const double azimuth_deg : {90.0, 130.0, 135.0}) {
    const auto viewpoint = Viewpoint::distant({radians(azimuth_deg), radians(2.0)});
    LaunchArea outline = launch_outline(viewpoint, target, 4.0, 0.0, 900.0, {});
    outline.highest_m = top_m;
    list_cells(outline);
    const LaunchArea low = launch_area(viewpoint, target, 4.0, 0.0, top_m, {});
    // Whole tiles of 64 m, and some about them.
    const double across_m = std::hypot(target.width_m(), target.height_m()) + 6.0 * 64.0;
    const double along_m = top_m / std::tan(radians(2.0)) + top_m * std::tan(radians(2.0)) + across_m;
    EXPECT_LT(static_cast<double>(outline.cells.size()), across_m * along_m / 16.0) << azimuth_deg;
    for (const LaunchCell& cell : low.cells)
      ASSERT_TRUE(covers(outline, Vec2d{cell.i + 0.5, cell.j + 0.5} * 4.0)) << azimuth_deg;
  }
}

// Echoes of several bounces land behind where they begin, and midway across.
TEST(LaunchArea, ReachWidensTheTargetBeforeAndBeside) {
  const LaunchArea area =
      launch_area(Viewpoint::distant({radians(180.0), radians(60.0)}), target, 1.0, 0.0, top_m, {32.0, 16.0});
  const double behind_m = top_m / std::tan(radians(60.0)) + top_m * std::tan(radians(60.0));
  EXPECT_TRUE(covers(area, {target.west_m - 15.0, 0.0}));
  EXPECT_FALSE(covers(area, {target.west_m - 18.0, 0.0}));
  EXPECT_TRUE(covers(area, {0.0, target.south_m - 31.0}));
  EXPECT_FALSE(covers(area, {0.0, target.south_m - 34.0}));
  EXPECT_TRUE(covers(area, {0.0, target.north_m + behind_m - 3.0}));
  EXPECT_FALSE(covers(area, {0.0, target.north_m + behind_m + 3.0}));
}

TEST(LaunchArea, EveryDoublingOfTheDistanceHalvesTheRays) {
  const auto from_south = Viewpoint::distant({radians(180.0), radians(60.0)});
  const LaunchArea area = launch_area(from_south, target, 1.0, 0.0, top_m, {100.0, 40.0});
  const auto share_before = [&](double metres) { return area.share_at({0.0, target.south_m - metres}); };
  EXPECT_EQ(share_before(-1.0), 1.0F);
  EXPECT_EQ(share_before(24.0), 1.0F);
  EXPECT_EQ(share_before(28.0), 0.5F);
  EXPECT_EQ(share_before(48.0), 0.5F);
  EXPECT_EQ(share_before(53.0), 0.25F);
  EXPECT_EQ(share_before(99.0), 0.25F);
  EXPECT_EQ(share_before(103.0), 0.0F);
  double sum = 0.0;
  for (const LaunchCell& cell : area.cells) {
    EXPECT_EQ(cell.share, area.share_at({cell.i + 0.5, cell.j + 0.5}));
    sum += static_cast<double>(cell.share);
  }
  EXPECT_EQ(area.whole_cells(), sum);
}

// Not the rectangle about the way there, which would be twice as large.
TEST(LaunchArea, ReachIsStraightTowardsTheRadar) {
  const radar::Rectangle square{-50, -50, 50, 50};
  const LaunchArea area =
      launch_area(Viewpoint::distant({radians(45.0), radians(60.0)}), square, 1.0, 0.0, 0.0, {200.0, 50.0});
  const double step_m = std::sqrt(0.5);
  EXPECT_TRUE(covers(area, {50.0 + 198.0 * step_m, 50.0 + 198.0 * step_m}));
  EXPECT_FALSE(covers(area, {50.0 + 204.0 * step_m, 50.0 + 204.0 * step_m}));
  EXPECT_TRUE(covers(area, {50.0 + 48.0 * step_m, -50.0 - 48.0 * step_m}));
  EXPECT_FALSE(covers(area, {180.0, -60.0}));
  EXPECT_FALSE(covers(area, {-60.0, 180.0}));
}

TEST(LaunchArea, NothingBeginsWhereNothingStands) {
  const auto from_south = Viewpoint::distant({radians(180.0), radians(60.0)});
  const radar::Rectangle within{target.west_m - 5.0, target.south_m - 20.0, target.east_m, target.north_m};
  const LaunchArea area = launch_area(from_south, target, 1.0, 0.0, top_m, {100.0, 50.0, within});
  EXPECT_TRUE(covers(area, {0.0, target.south_m - 19.0}));
  EXPECT_FALSE(covers(area, {0.0, target.south_m - 22.0}));
  EXPECT_TRUE(covers(area, {target.west_m - 4.0, 0.0}));
  EXPECT_FALSE(covers(area, {target.west_m - 7.0, 0.0}));
  EXPECT_FALSE(covers(area, {target.east_m + 2.0, 0.0}));
}

// So that patches and shards agree on their rays: the same place has the same cell, whichever target asks.
TEST(LaunchArea, CellsAreNumberedFromTheOriginOfTheFrame) {
  const auto viewpoint = Viewpoint::distant({radians(180.0), radians(60.0)});
  const LaunchArea one = launch_area(viewpoint, {100.25, 50.0, 101.0, 51.0}, 0.5, 0.0, 0.0, {});
  for (const LaunchCell cell : one.cells) {
    EXPECT_NEAR((cell.i + 0.5) * 0.5, 100.6, 1.5);
    EXPECT_NEAR((cell.j + 0.5) * 0.5, 50.5, 1.5);
  }
  const LaunchArea west = launch_area(viewpoint, {-101.0, -51.0, -100.0, -50.0}, 0.5, 0.0, 0.0, {});
  for (const LaunchCell cell : west.cells) EXPECT_LT(cell.i, -198);
}

/// Corners of an area that looks at a square of 400 m from the south-west, and the sector of 100 m in its middle.
struct NarrowArea {
  Vec3d radar = radar::position_seeing({}, radians(225.0), radians(20.0), 5000.0);
  double over_ground_m = std::hypot(radar.x, radar.y);
  HeardSector heard{.radar = radar,
                    .middle_azimuth_rad = radians(45.0),
                    .half_width_rad = 50.0 / over_ground_m,
                    .near_range_m = 4950.0,
                    .far_range_m = 5050.0};
  LaunchArea wide =
      launch_area(Viewpoint::located(radar), {-200.0, -200.0, 200.0, 200.0}, 4.0, 0.0, top_m, {10.0, 10.0});
};

TEST(LaunchArea, NarrowedToASectorLosesNoRayThatIsHeard) {
  NarrowArea area;
  LaunchArea narrow = area.wide;
  narrow_to(narrow, area.heard);
  std::set<std::pair<int, int>> launched;
  for (const LaunchCell& cell : narrow.cells) launched.insert({cell.i, cell.j});
  std::size_t heard = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const auto drawn = [i](std::uint64_t what) { return static_cast<double>(unit_float(hashed(i, what))); };
    const Vec3d point{400.0 * drawn(0) - 200.0, 400.0 * drawn(1) - 200.0, top_m * drawn(2)};
    const Vec3d away = point - area.radar;
    const double range_m = length(away);
    const double beside_m = std::abs(azimuth_of(away) - radians(45.0)) * area.over_ground_m;
    if (range_m < 4950.0 || range_m > 5050.0 || beside_m > 50.0) {
      // Well outside nothing counts, so that no path is found from one end alone.
      if (beside_m > 70.0 || range_m > 5070.0) {
        EXPECT_FALSE(narrow.counts_from(point));
      }
      continue;
    }
    ++heard;
    EXPECT_EQ(narrow.counts_from(point), area.wide.counts_from(point));
    const Vec2d aim = narrow.viewpoint.shadow_on_plane(point, 0.0);
    EXPECT_TRUE(
        launched.contains({static_cast<int>(std::floor(aim.x / 4.0)), static_cast<int>(std::floor(aim.y / 4.0))}))
        << point.x << " " << point.y << " " << point.z;
  }
  EXPECT_GT(heard, 500U);
}

TEST(LaunchArea, NarrowedToASectorAimsAtLittleElse) {
  NarrowArea area;
  LaunchArea narrow = area.wide;
  narrow_to(narrow, area.heard);
  // 100 m across with 18 m on both sides and before, as long as the sector and what is tall reaches behind.
  EXPECT_LT(narrow.cells.size(), area.wide.cells.size() / 3);
  const double length_m = (100.0 + 36.0 + top_m * std::tan(radians(90.0 - 20.0))) / std::cos(radians(20.0));
  EXPECT_NEAR(static_cast<double>(narrow.cells.size()) * 16.0, 136.0 * length_m, 0.2 * 136.0 * length_m);
}

}  // namespace
}  // namespace sigmascape::trace
