#include "sigmascape/product/ground_projection.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::product {
namespace {

using radar::Channels;

/// Fine bins about the origin for a radar at `position`, nothing in them.
radar::RangeAzimuthImage empty_about_origin(Vec3d position, double half_side_m, double step_m) {
  const double range_m = length(position), ground_m = std::hypot(position.x, position.y);
  const auto count = static_cast<std::size_t>(2.0 * half_side_m / step_m);
  radar::RangeAzimuthImage image;
  image.radar_position = position;
  image.grid = {.first_range_m = range_m - half_side_m,
                .range_step_m = step_m,
                .ranges = count,
                .first_azimuth_rad = std::atan2(-position.x, -position.y) - half_side_m / ground_m,
                .azimuth_step_rad = step_m / ground_m,
                .azimuths = count};
  image.rcs_m2 = Array2D<Channels>(count, count);
  return image;
}

/// Adds a scatterer, shared between the four nearest bins.
void add_point(radar::RangeAzimuthImage& image, Vec3d point, float rcs_m2,
               const radar::CurvedEarth& earth = radar::CurvedEarth::flat()) {
  const Vec3d away = earth.bent(point, {image.radar_position.x, image.radar_position.y}) - image.radar_position;
  const auto& grid = image.grid;
  const double middle = grid.first_azimuth_rad + 0.5 * static_cast<double>(grid.azimuths) * grid.azimuth_step_rad;
  const double azimuth = middle + std::remainder(azimuth_of(away) - middle, 2.0 * pi);
  const double column = (azimuth - grid.first_azimuth_rad) / grid.azimuth_step_rad - 0.5;
  const double row = (length(away) - grid.first_range_m) / grid.range_step_m - 0.5;
  const auto c = static_cast<std::size_t>(column), r = static_cast<std::size_t>(row);
  const auto u = static_cast<float>(column - std::floor(column)), v = static_cast<float>(row - std::floor(row));
  if (column < 0.0 || row < 0.0 || c + 1 >= grid.azimuths || r + 1 >= grid.ranges) return;
  for (const std::size_t down : {0U, 1U}) {
    for (const std::size_t across : {0U, 1U}) {
      const float share = (across == 1 ? u : 1.0F - u) * (down == 1 ? v : 1.0F - v) * rcs_m2;
      image.rcs_m2(c + across, r + down) += Channels{share, 0.5F * share, 0.25F * share, -share};
    }
  }
}

terrain::HeightField plane(double slope_east, double slope_north) {
  terrain::HeightField field{-500, 500, 1000, Array2D<float>(2, 2)};
  for (const std::size_t row : {0U, 1U}) {
    for (const std::size_t column : {0U, 1U}) {
      field.height_m(column, row) =
          static_cast<float>(slope_east * (column == 1 ? 500.0 : -500.0) + slope_north * (row == 0 ? 500.0 : -500.0));
    }
  }
  return field;
}

TEST(GroundMap, PointsComeBackAtTheirPlaceOnFlatAndSlopingGround) {
  const radar::GroundGrid grid{.west_m = -60, .north_m = 60, .cell_m = 1.0, .columns = 120, .rows = 120};
  for (const auto& terrain : {plane(0, 0), plane(0.1, -0.15), plane(-0.2, 0.1)}) {
    for (const double azimuth_deg : {0.0, 130.0, 180.0, 275.0}) {
      const Vec3d position = radar::position_seeing({}, radians_from_deg(azimuth_deg), radians_from_deg(25.0), 5000.0);
      for (const Vec2d place : {Vec2d{0.3, 0.2}, {-33.4, 21.7}, {40.1, 38.8}}) {
        auto image = empty_about_origin(position, 100.0, 0.5);
        add_point(image, {place.x, place.y, terrain.height_at(place)}, 1.0F);
        const radar::GroundMap map = ground_map(image, terrain, grid);
        Vec2d centre{};
        double power = 0.0;
        for (std::size_t row = 0; row < grid.rows; ++row) {
          for (std::size_t column = 0; column < grid.columns; ++column) {
            const double here = static_cast<double>(map.sigma0(column, row).vv);
            if (!(here > 0.0)) continue;
            centre = centre + grid.centre_of(column, row) * here;
            power += here;
          }
        }
        ASSERT_GT(power, 0.0);
        const Vec2d off = centre * (1.0 / power) - place;
        EXPECT_LT(std::max(std::abs(off.x), std::abs(off.y)), 0.5) << azimuth_deg << "° " << place.x << " " << place.y;
      }
    }
  }
}

// Bins of a live frame hold ranges over an Earth that curves: from 10 km up and 100 km away it lies 590 m lower, 58 m
// farther.
TEST(GroundMap, PointsComeBackAtTheirPlaceOverACurvedEarth) {
  const radar::GroundGrid grid{.west_m = -80, .north_m = 80, .cell_m = 1.0, .columns = 160, .rows = 160};
  const radar::CurvedEarth earth;
  const Vec3d position{0.0, -100e3, 10e3};
  auto image = empty_about_origin(position, 100.0, 0.5);
  add_point(image, {20.3, 3.2, 0.0}, 1.0F, earth);
  const auto brightest_of = [&](const radar::GroundMap& map) {
    std::size_t brightest = 0;
    float most = 0.0F;
    for (std::size_t cell = 0; cell < map.sigma0.size(); ++cell) {
      if (map.sigma0.values()[cell].vv > most) {
        most = map.sigma0.values()[cell].vv;
        brightest = cell;
      }
    }
    return grid.centre_of(brightest % grid.columns, brightest / grid.columns);
  };
  const Vec2d found = brightest_of(ground_map(image, plane(0, 0), grid, 1, earth));
  EXPECT_NEAR(found.x, 20.3, 1.0);
  EXPECT_NEAR(found.y, 3.2, 1.0);
  EXPECT_NEAR(brightest_of(ground_map(image, plane(0, 0), grid)).y, 3.2 + 58.0, 2.0);
}

// Small pieces of ground of equal σ0, summed into bins as a receiver does, are that σ0 on the map.
TEST(GroundMap, UniformReflectivityReturnsItself) {
  const radar::GroundGrid grid{.west_m = -20, .north_m = 20, .cell_m = 2.0, .columns = 20, .rows = 20};
  constexpr double piece_m = 0.125;
  constexpr float sigma0 = 0.03F;
  for (const double elevation_deg : {8.0, 30.0, 60.0}) {
    for (const double azimuth_deg : {0.0, 200.0}) {
      auto image = empty_about_origin(
          radar::position_seeing({}, radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg), 2000.0), 60.0,
          1.0);
      for (double x = -64.0; x < 64.0; x += piece_m) {
        for (double y = -64.0; y < 64.0; y += piece_m) {
          add_point(image, {x + piece_m / 2, y + piece_m / 2, 0.0}, sigma0 * static_cast<float>(piece_m * piece_m));
        }
      }
      const radar::GroundMap map = ground_map(image, plane(0, 0), grid);
      double mean = 0.0, cross = 0.0;
      for (const Channels& cell : map.sigma0.values()) {
        mean += static_cast<double>(cell.vv) / 400.0;
        cross += static_cast<double>(cell.hv) / 400.0;
        EXPECT_NEAR(db_from_linear(static_cast<double>(cell.vv / sigma0)), 0.0, 0.5);
      }
      EXPECT_NEAR(db_from_linear(mean / static_cast<double>(sigma0)), 0.0, 0.05)
          << elevation_deg << "° " << azimuth_deg << "°";
      EXPECT_NEAR(cross / mean, 0.25, 1e-4);
    }
  }
}

TEST(GroundMap, HeightLiesOverTowardsTheRadar) {
  const radar::GroundGrid grid{.west_m = -60, .north_m = 60, .cell_m = 1.0, .columns = 120, .rows = 120};
  auto image = empty_about_origin(radar::position_seeing({}, pi / 2.0, radians_from_deg(30.0), 20'000.0), 80.0, 0.5);
  add_point(image, {0, 0, 30}, 1.0F);
  const radar::GroundMap map = ground_map(image, plane(0, 0), grid);
  double power = 0.0, east = 0.0;
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const double here = static_cast<double>(map.sigma0(column, row).vv);
      power += here > 0.0 ? here : 0.0;
      east += here > 0.0 ? here * grid.centre_of(column, row).x : 0.0;
    }
  }
  EXPECT_NEAR(east / power, 30.0 * std::tan(radians_from_deg(30.0)), 0.5);
}

TEST(GroundMap, CellsOutsideTheBinsAreMissing) {
  const radar::GroundGrid grid{.west_m = -500, .north_m = 500, .cell_m = 100.0, .columns = 10, .rows = 10};
  const auto image = empty_about_origin(radar::position_seeing({}, 0.0, radians_from_deg(20.0), 5000.0), 120.0, 1.0);
  const radar::GroundMap map = ground_map(image, plane(0, 0), grid);
  EXPECT_TRUE(std::isnan(map.sigma0(0, 0).vv));
  EXPECT_TRUE(std::isnan(map.sigma0(9, 5).re_vvhh));
  EXPECT_EQ(map.sigma0(5, 5), Channels{});
  EXPECT_EQ(map.grid, grid);
}

// All round a radar that stands over the map, even across the azimuth at which its bins begin.
TEST(GroundMap, BinsThatGoRoundLeaveNoSeam) {
  radar::RangeAzimuthImage image;
  image.radar_position = {0, 0, 200};
  image.grid = {.first_range_m = 190.0,
                .range_step_m = 1.0,
                .ranges = 60,
                .first_azimuth_rad = radians_from_deg(20.0),
                .azimuth_step_rad = 2.0 * pi / 72.0,
                .azimuths = 72};
  const auto rcs_m2 = [](double azimuth_rad) { return 1.0 + 0.5 * std::cos(azimuth_rad - radians_from_deg(40.0)); };
  image.rcs_m2 = Array2D<Channels>(72, 60);
  for (std::size_t beam = 0; beam < 72; ++beam) {
    const double azimuth_rad =
        image.grid.first_azimuth_rad + (static_cast<double>(beam) + 0.5) * image.grid.azimuth_step_rad;
    for (std::size_t range = 0; range < 60; ++range)
      image.rcs_m2(beam, range).vv = static_cast<float>(rcs_m2(azimuth_rad));
  }
  const radar::GroundGrid grid{.west_m = -90, .north_m = 90, .cell_m = 3.0, .columns = 60, .rows = 60};
  const radar::GroundMap map = ground_map(image, plane(0, 0), grid);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Vec2d place = grid.centre_of(column, row);
      // On level ground a bin is r Δr Δφ large.
      const double bin_m2 = std::hypot(length(place), 200.0) * image.grid.range_step_m * image.grid.azimuth_step_rad;
      ASSERT_NEAR(static_cast<double>(map.sigma0(column, row).vv) * bin_m2, rcs_m2(azimuth_of(place)), 0.01)
          << column << ", " << row;
    }
  }
}

}  // namespace
}  // namespace sigmascape::product
