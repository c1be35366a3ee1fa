#include "sigmascape/terrain/ground_profile.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/hash.h"

namespace sigmascape::terrain {
namespace {

HeightField rough_terrain() {
  HeightField field{-40.0, 70.0, 3.0, Array2D<float>(37, 29)};
  for (std::size_t i = 0; i < field.height_m.size(); ++i)
    field.height_m.values()[i] = 100.0F * unit_float(hashed(i, 1));
  return field;
}

/// Somewhat smaller than the terrain, in squares of another size.
radar::ObstacleMap scattered_obstacles() {
  radar::ObstacleMap map{{-31.0, 61.0, 1.7, 50, 40}, Array2D<radar::Obstacle>(50, 40)};
  for (std::size_t i = 0; i < map.obstacles.size(); ++i)
    map.obstacles.values()[i].solid_top_m = unit_float(hashed(i, 2));
  return map;
}

struct Met {
  std::size_t place;
  double distance_m;
  Vec3d point;
  radar::Obstacle obstacle;
};

std::vector<Met> met_on(GroundProfile profile, const GroundLine& line) {
  std::vector<Met> met;
  profile.walk(line, [&](std::size_t k, double distance_m, Vec3d point, const radar::Obstacle& obstacle) {
    met.push_back({k, distance_m, point, obstacle});
  });
  return met;
}

// Along lines of all directions, from within and without: every place on the terrain and no other, with what a look at
// that place alone gives.
TEST(GroundProfile, MeetsEveryPlaceOnTheTerrainAsALookAtItAloneDoes) {
  const HeightField terrain = rough_terrain();
  const radar::ObstacleMap obstacles = scattered_obstacles();
  const GroundProfile profile(terrain, &obstacles);
  for (std::uint64_t n = 0; n < 60; ++n) {
    const double azimuth = 0.1 + 0.105 * static_cast<double>(n);
    const GroundLine line{.origin = {120.0 * static_cast<double>(unit_float(hashed(n, 3))) - 60.0,
                                     120.0 * static_cast<double>(unit_float(hashed(n, 4))) - 40.0},
                          .direction = {std::sin(azimuth), std::cos(azimuth)},
                          .near_m = n % 3 == 0 ? 0.0 : 7.3,
                          .step_m = 0.37,
                          .count = 500};
    const std::vector<Met> met = met_on(profile, line);
    std::size_t next = 0;
    for (std::size_t k = 0; k < line.count; ++k) {
      const Vec2d place = line.origin + line.direction * line.distance_m(k);
      if (!terrain.extent().contains(place)) continue;
      ASSERT_LT(next, met.size());
      const Met& here = met[next++];
      ASSERT_EQ(here.place, k);
      ASSERT_EQ(here.distance_m, line.distance_m(k));
      ASSERT_EQ(here.point, (Vec3d{place.x, place.y, terrain.height_at(place)}));
      ASSERT_EQ(here.obstacle, obstacles.at(place));
    }
    EXPECT_EQ(next, met.size()) << n;
  }
}

TEST(GroundProfile, MeetsNothingBesideTheTerrainAndNoObstaclesWithoutAMap) {
  const HeightField terrain = rough_terrain();
  const GroundProfile bare(terrain, nullptr);
  EXPECT_TRUE(met_on(bare, {.origin = {0.0, 500.0}, .direction = {1.0, 0.0}, .step_m = 1.0, .count = 300}).empty());
  const auto met = met_on(bare, {.origin = {0.0, 0.0}, .direction = {1.0, 0.0}, .step_m = 1.0, .count = 300});
  ASSERT_FALSE(met.empty());
  for (const Met& here : met) EXPECT_EQ(here.obstacle, radar::Obstacle{});
}

}  // namespace
}  // namespace sigmascape::terrain
