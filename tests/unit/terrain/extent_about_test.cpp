#include "sigmascape/terrain/extent_about.h"

#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "scratch_folder.h"
#include "unit/geo/ascii_grid.h"

namespace sigmascape::terrain {
namespace {

const radar::Rectangle wanted{-5e3, -4e3, 5e3, 4e3};

class ExtentAbout : public ::testing::Test {
 protected:
  [[nodiscard]] geo::Raster raster(const geo::AsciiGrid& grid, const std::string& crs) const {
    return geo::Raster({folder_.write("heights.asc", grid.text([](double, double) { return 1.0; })), 1, crs});
  }
  ScratchFolder folder_;
};

/// What of a rectangle's rim lies beyond the raster, in places.
int beyond(const geo::Raster& raster, const geo::LocalFrame& frame, const geo::Extent& extent) {
  int count = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / 1000.0;
    const double x = std::lerp(extent.west_m, extent.east_m, t), y = std::lerp(extent.south_m, extent.north_m, t);
    for (const Vec2d place : {Vec2d{x, extent.south_m}, {x, extent.north_m}, {extent.west_m, y}, {extent.east_m, y}}) {
      count += raster.covers(frame, place) ? 0 : 1;
    }
  }
  return count;
}

// In a frame at 38 N a parallel rises by R/2 sin φ cos φ Δλ²: by 100 km at 15° to the east. The largest rectangle of
// all lies north of the place.
TEST_F(ExtentAbout, HoldsThePlaceInARasterOfAContinent) {
  struct Case {
    geo::AsciiGrid grid;
    geo::LocalFrame frame;
    double least_m;  ///< that is kept on all sides
  };
  const geo::LocalFrame san_francisco(37.77, -122.42), bilbao(43.26, -2.93);
  for (const auto& [grid, frame, least_m] :
       {Case{{-125.0, 24.0, 0.5, 118, 52}, san_francisco, 190e3},
        Case{{-124.0, 37.0, 0.1, 170, 40}, san_francisco, 60e3}, Case{{-25.0, 34.0, 0.5, 140, 76}, bilbao, 300e3}}) {
    const geo::Raster continent = raster(grid, "EPSG:4326");
    const geo::Extent plain = continent.outline_in(frame).extent_inside();
    EXPECT_GT(plain.south_m, wanted.north_m) << "or there is nothing to find";
    const auto extent = extent_about(continent, frame, wanted);
    ASSERT_TRUE(extent);
    EXPECT_LT(extent->west_m, -least_m);
    EXPECT_LT(extent->south_m, -least_m);
    EXPECT_GT(extent->east_m, least_m);
    EXPECT_GT(extent->north_m, least_m);
    EXPECT_EQ(beyond(continent, frame, *extent), 0);
  }
}

TEST_F(ExtentAbout, IsTheLargestRectangleInARasterThatLiesAlongTheFrame) {
  const geo::LocalFrame frame(43.312, -2.986);
  const geo::Raster zone = raster({480'000.0, 4'770'000.0, 100.0, 500, 500}, "EPSG:25830");
  EXPECT_EQ(extent_about(zone, frame, wanted), zone.outline_in(frame).extent_inside());
}

// Its southern edge lies over the place, which only its north has.
TEST_F(ExtentAbout, MayHoldAPartOfThePlace) {
  const geo::LocalFrame frame(43.26, -2.93);
  const geo::Raster half = raster({-5.0, 43.26, 0.01, 1000, 100}, "EPSG:4326");
  const auto extent = extent_about(half, frame, wanted);
  ASSERT_TRUE(extent);
  EXPECT_LT(extent->south_m, 500.0);
  EXPECT_GT(extent->north_m, 100e3);
  EXPECT_EQ(beyond(half, frame, *extent), 0);
  EXPECT_FALSE(extent_about(raster({-5.0, 43.4, 0.01, 1000, 100}, "EPSG:4326"), frame, wanted));
}

// Between two points of the outline of a raster 70° wide, a 1024th of its width or 5.5 km apart, lies a whole atlas.
// One edge crosses it, 400 m north or south of its middle; the raster has the ground on the other side.
TEST_F(ExtentAbout, StaysInARasterOfAContinentWhoseEdgeCrossesASmallPlace) {
  constexpr radar::Rectangle small{-2.5e3, -2e3, 2.5e3, 2e3};
  constexpr double width_deg = 70.0, between_deg = width_deg / 1024.0, metres_per_degree = 111'100.0;
  const geo::LocalFrame frame(43.26, -2.93);
  const double west_deg = frame.longitude_deg() - (512.0 + 0.5) * between_deg, aside_deg = 400.0 / metres_per_degree;
  for (const bool is_in_the_south : {true, false}) {
    const double south_deg = frame.latitude_deg() + (is_in_the_south ? aside_deg - 20.0 : -aside_deg);
    const geo::Raster continent = raster({west_deg, south_deg, 0.5, 140, 40}, "EPSG:4326");
    for (const Vec2d& point : continent.outline_in(frame).south)
      ASSERT_FALSE(small.contains(point)) << "or there is nothing to find";
    for (const Vec2d& point : continent.outline_in(frame).north)
      ASSERT_FALSE(small.contains(point)) << "or there is nothing to find";
    const auto extent = extent_about(continent, frame, small);
    ASSERT_TRUE(extent);
    EXPECT_EQ(beyond(continent, frame, *extent), 0) << is_in_the_south;
    // A southern edge rises by 75 m, a 32nd of what it leaves of the place, within 32 km to both sides.
    EXPECT_LT(extent->west_m, -25e3);
    EXPECT_GT(extent->east_m, 25e3);
    EXPECT_NEAR(is_in_the_south ? extent->north_m : extent->south_m, is_in_the_south ? 400.0 : -400.0, 400.0);
    EXPECT_GT(is_in_the_south ? -extent->south_m : extent->north_m, 100e3);
  }
}

TEST_F(ExtentAbout, ReachesAsFarAsRadarsStandInAGlobe) {
  const geo::LocalFrame frame(43.26, 179.9);
  const double half_turn_m = 6378137.0 * M_PI;
  for (const geo::Raster& globe :
       {raster({-180.0, -90.0, 1.0, 360, 180}, "EPSG:4326"),
        raster({-half_turn_m, -0.5 * half_turn_m, half_turn_m / 100.0, 200, 100}, "EPSG:3857")}) {
    EXPECT_EQ(extent_about(globe, frame, wanted), (geo::Extent{wanted.west_m - 1000e3, wanted.south_m - 1000e3,
                                                               wanted.east_m + 1000e3, wanted.north_m + 1000e3}));
  }
}

}  // namespace
}  // namespace sigmascape::terrain
