#include "sigmascape/render/face_sight.h"

#include <cmath>
#include <gtest/gtest.h>

#include "made_landscape.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::render {
namespace {

constexpr radar::Rectangle about_faces{-50.0, -50.0, 50.0, 50.0};
constexpr Vec3d south{0.0, -1.0, 0.0}, up{0.0, 0.0, 1.0};

/// In the south, far away.
Vec3d radar_at(double elevation_deg) {
  return radar::position_seeing({}, pi, radians_from_deg(elevation_deg), 100e3);
}

/// What stands on terrain, looked at from one place.
struct Landscape {
  const radar::ObstacleMap& obstacles;
  const terrain::HeightField& terrain;
  radar::CurvedEarth earth = radar::CurvedEarth::flat();
};

double passed(const Landscape& landscape, Vec3d point, Vec3d normal, Vec3d radar) {
  const FaceSight sight(landscape.obstacles, landscape.terrain, radar::Vantage(radar), about_faces, landscape.earth);
  return sight.part_passed(point, normal, radar);
}

TEST(FaceSight, AFreeWallIsSeenAndOneBelowTheGroundIsNot) {
  const auto terrain = level_ground();
  const auto bare = obstacles([](Vec2d) { return radar::Obstacle{}; });
  const Landscape landscape{bare, terrain};
  for (const double elevation_deg : {1.0, 10.0, 37.0, 80.0}) {
    EXPECT_EQ(passed(landscape, {0.0, 0.0, 0.1}, south, radar_at(elevation_deg)), 1.0) << elevation_deg;
    EXPECT_EQ(passed(landscape, {0.0, 0.0, -0.1}, south, radar_at(elevation_deg)), 0.0) << elevation_deg;
  }
}

// A square of which a house covers half is as high as its roof, before its walls too.
TEST(FaceSight, AHouseDoesNotHideItsOwnWallsAndRoof) {
  const auto terrain = level_ground();
  for (double edge_m = 0.1; edge_m < 4.0; edge_m += 0.4) {
    const auto house = obstacles(solid_bar(edge_m, edge_m + 20.0, 12.0F));
    const Landscape landscape{house, terrain};
    for (const double height_m : {0.5, 6.0, 11.5})
      EXPECT_EQ(passed(landscape, {0.0, edge_m, height_m}, south, radar_at(8.0)), 1.0) << edge_m << ", " << height_m;
    EXPECT_EQ(passed(landscape, {0.0, edge_m + 10.0, 12.0}, up, radar_at(8.0)), 1.0);
  }
}

// Nor does one that stands aslant, whose squares reach before its walls here and there, from aside.
TEST(FaceSight, AHouseThatStandsAslantDoesNotHideItsOwnWalls) {
  const auto terrain = level_ground();
  const double turn_rad = 0.5;
  const Vec2d along{std::cos(turn_rad), std::sin(turn_rad)}, inwards{-along.y, along.x};
  const auto house = obstacles([&](Vec2d place) {
    const bool within = std::abs(dot(place, along)) < 30.0 && dot(place, inwards) > 0.0 && dot(place, inwards) < 16.0;
    return radar::Obstacle{.solid_top_m = within ? 12.0F : 0.0F};
  });
  const Vec3d normal{-inwards.x, -inwards.y, 0.0};
  for (const double aside_rad : {-1.3, -0.7, 0.0, 0.7, 1.3}) {
    const double azimuth_rad = azimuth_of(normal) + aside_rad;
    const Vec3d radar = radar::position_seeing({}, azimuth_rad, radians_from_deg(6.0), 100e3);
    const FaceSight sight(house, terrain, radar::Vantage(radar), about_faces);
    for (double d = -25.0; d < 25.0; d += 0.017)
      EXPECT_EQ(sight.part_passed({along.x * d, along.y * d, 4.0}, normal, radar), 1.0) << aside_rad << ", " << d;
  }
}

// An annex as deep as a square, and nothing beyond it.
TEST(FaceSight, WhatLeansOnAWallHidesIt) {
  const auto terrain = level_ground();
  const auto annex = obstacles(solid_bar(-2.0, 0.0, 6.0F));
  const Landscape landscape{annex, terrain};
  EXPECT_EQ(passed(landscape, {0.0, 0.0, 5.0}, south, radar_at(8.0)), 0.0);
  EXPECT_EQ(passed(landscape, {0.0, 0.0, 7.0}, south, radar_at(8.0)), 1.0);
}

// Squares know the top above their own ground: uphill in its square a roof that lies level is below it.
TEST(FaceSight, AHouseOnASlopeDoesNotHideItsRoof) {
  for (const double slope : {0.1, 0.3, 0.6}) {
    const auto terrain = ground([slope](Vec2d place) { return slope * place.y; });
    const auto house = obstacles([slope](Vec2d place) {
      const bool within = std::abs(place.x) < 10.0 && std::abs(place.y) < 7.0;
      return radar::Obstacle{.solid_top_m = within ? static_cast<float>(9.0 - slope * place.y) : 0.0F};
    });
    const Landscape landscape{house, terrain};
    for (double y = -6.9; y < 6.9; y += 0.37)
      EXPECT_EQ(passed(landscape, {0.3, y, 9.0}, up, radar_at(30.0)), 1.0) << slope << ", " << y;
  }
}

// In squares of which the highest of the roof is known, as scene::obstacles_of makes them.
TEST(FaceSight, APitchedRoofDoesNotHideItself) {
  const auto terrain = level_ground();
  const double pitch = 0.7;
  const auto height_m = [&](double y) { return 8.0 + pitch * (8.0 - std::abs(y)); };
  const auto house = obstacles([&](Vec2d place) {
    const double nearest_ridge = std::max(std::abs(place.y) - 0.8, 0.0);
    const bool within = std::abs(place.x) < 12.0 && std::abs(place.y) < 8.0;
    return radar::Obstacle{.solid_top_m = within ? static_cast<float>(height_m(nearest_ridge)) : 0.0F};
  });
  const Landscape landscape{house, terrain};
  const Vec3d facing = Vec3d{0.0, -pitch, 1.0} * (1.0 / std::hypot(1.0, pitch));
  for (double y = -7.9; y < 0.0; y += 0.31)
    EXPECT_EQ(passed(landscape, {0.3, y, height_m(y)}, facing, radar_at(10.0)), 1.0) << y;
}

// What is in doubt about a roof is forgotten along its line of sight: a house before it hides it as it hides the
// ground.
TEST(FaceSight, ARoofInDoubtIsHiddenByAnotherHouse) {
  const auto terrain = ground([](Vec2d place) { return 0.3 * place.y; });
  const double edge_m = -16.0, top_m = 0.3 * edge_m + 14.0, rise = std::tan(radians_from_deg(20.0));
  const auto block = obstacles([&](Vec2d place) {
    const bool within = place.y > -32.0 && place.y < edge_m;
    return radar::Obstacle{.solid_top_m = within ? static_cast<float>(top_m - 0.3 * place.y) : 0.0F};
  });
  const Landscape landscape{block, terrain};
  const double hidden_m = top_m - (5.0 - edge_m) * rise;
  EXPECT_EQ(passed(landscape, {0.0, 5.0, hidden_m - 0.8}, up, radar_at(20.0)), 0.0);
  EXPECT_EQ(passed(landscape, {0.0, 5.0, hidden_m + 0.8}, up, radar_at(20.0)), 1.0);
}

// Of all obstacles, not of those in the area alone.
TEST(FaceSight, ATowerFarAwayHidesToo) {
  const auto terrain = level_ground();
  const auto tower = obstacles(solid_bar(-450.0, -400.0, 60.0F));
  const Landscape landscape{tower, terrain};
  const double hidden_m = 60.0 - 400.0 * std::tan(radians_from_deg(3.0));
  EXPECT_EQ(passed(landscape, {0.0, 0.0, hidden_m - 1.0}, south, radar_at(3.0)), 0.0);
  EXPECT_EQ(passed(landscape, {0.0, 0.0, hidden_m + 1.0}, south, radar_at(3.0)), 1.0);
}

// A radar below a house sees no floor through the ground.
TEST(FaceSight, AnUndersideOnTheGroundIsNotSeen) {
  const auto terrain = ground([](Vec2d place) { return 0.2 * place.y; });
  const auto house = obstacles(solid_bar(-10.0, 10.0, 8.0F));
  const Landscape landscape{house, terrain};
  const Vec3d below{0.0, -400.0, -60.0};
  EXPECT_EQ(passed(landscape, {0.0, 0.0, -2.0}, {0.0, 0.0, -1.0}, below), 0.0);
}

// 40 m behind the far edge of a bar of 10 m: 10 − 40 tan ψ of it is hidden, to half a square's worth.
TEST(FaceSight, ABarHidesAWallUpToTheLineOfSightOverIt) {
  const auto terrain = level_ground();
  const auto bar = obstacles(solid_bar(-60.0, -40.0, 10.0F));
  const Landscape landscape{bar, terrain};
  for (const double elevation_deg : {3.0, 7.0, 12.0}) {
    const double rise = std::tan(radians_from_deg(elevation_deg));
    const double hidden_m = 10.0 - 40.0 * rise, doubt_m = square_m * rise + 0.05;
    const Vec3d radar = radar_at(elevation_deg);
    EXPECT_EQ(passed(landscape, {0.0, 0.0, hidden_m - doubt_m}, south, radar), 0.0) << elevation_deg;
    EXPECT_EQ(passed(landscape, {0.0, 0.0, hidden_m + doubt_m}, south, radar), 1.0) << elevation_deg;
  }
}

TEST(FaceSight, ARidgeFarAwayHidesWhatLiesBelowTheLineOverIt) {
  const auto height_m = [](double y) { return 60.0 * std::exp(-std::pow((y + 400.0) / 40.0, 2)); };
  const auto terrain = ground([&](Vec2d place) { return height_m(place.y); });
  const auto none = obstacles([](Vec2d) { return radar::Obstacle{}; });
  const auto few = obstacles(solid_bar(100.0, 110.0, 8.0F));
  for (const radar::ObstacleMap* map : {&none, &few}) {
    const Landscape landscape{*map, terrain};
    const Vec3d radar = radar_at(5.0);
    double hidden_m = 0.0;
    for (double y = -512.0; y < 0.0; y += 0.1)
      hidden_m = std::max(hidden_m, height_m(y) + y * std::tan(radians_from_deg(5.0)));
    ASSERT_GT(hidden_m, 20.0);
    EXPECT_EQ(passed(landscape, {0.0, 0.0, hidden_m - 0.5}, south, radar), 0.0);
    EXPECT_EQ(passed(landscape, {0.0, 0.0, hidden_m + 0.5}, south, radar), 1.0);
  }
}

// e^−κs over the way within: a crown from 4 to 9 m over 20 m of ground, met at its whole depth and cut by its top.
TEST(FaceSight, ACrownWeakensByTheWayWithinIt) {
  const auto terrain = level_ground();
  const auto crown = obstacles([](Vec2d place) {
    const bool within = place.y > -40.0 && place.y < -20.0;
    return within ? radar::Obstacle{.crown_base_m = 4.0F, .crown_top_m = 9.0F, .crown_extinction_per_m = 0.1F}
                  : radar::Obstacle{};
  });
  const Landscape landscape{crown, terrain};
  const double rise = std::tan(radians_from_deg(5.0)), slant = std::hypot(1.0, rise);
  EXPECT_NEAR(passed(landscape, {0.0, 0.0, 4.0}, south, radar_at(5.0)), std::exp(-0.1 * 20.0 * slant), 0.01);
  // From 6 m the line leaves through the top, 3 m / tan ψ away: of the crown the nearest 14.3 m.
  EXPECT_NEAR(passed(landscape, {0.0, 0.0, 6.0}, south, radar_at(5.0)), std::exp(-0.1 * (3.0 / rise - 20.0) * slant),
              0.03);
  EXPECT_EQ(passed(landscape, {0.0, 0.0, 9.0}, south, radar_at(5.0)), 1.0);
}

// 200 m of forest from 300 m before a wall on, all below its tops.
TEST(FaceSight, AForestFarAwayWeakensToo) {
  const auto terrain = level_ground();
  const auto forest = obstacles([](Vec2d place) {
    const bool within = place.y > -500.0 && place.y < -300.0;
    return within ? radar::Obstacle{.crown_base_m = 2.0F, .crown_top_m = 20.0F, .crown_extinction_per_m = 0.02F}
                  : radar::Obstacle{};
  });
  const Landscape landscape{forest, terrain};
  EXPECT_NEAR(passed(landscape, {0.0, 0.0, 3.0}, south, radar_at(1.0)), std::exp(-0.02 * 200.0), 0.003);
}

// Over 4/3 of the Earth's radius 60 km of sea bulge by d₁ d₂ / (2 k R) between a radar and a wall.
TEST(FaceSight, TheSeaBulgesBetweenThem) {
  const auto terrain = level_ground();
  const auto bare = obstacles([](Vec2d) { return radar::Obstacle{}; });
  const radar::CurvedEarth earth;
  const Landscape flat{bare, terrain}, curved{bare, terrain, earth};
  const Vec3d grazing{0.0, -60e3, 20.0};
  EXPECT_EQ(passed(flat, {0.0, 0.0, 1.0}, south, grazing), 1.0);
  EXPECT_EQ(passed(curved, {0.0, 0.0, 1.0}, south, grazing), 0.0);
  EXPECT_EQ(passed(curved, {0.0, 0.0, 1.0}, south, {0.0, -60e3, 2.0 * earth.drop_m(60e3)}), 1.0);
}

}  // namespace
}  // namespace sigmascape::render
