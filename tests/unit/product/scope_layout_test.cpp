#include "sigmascape/product/scope_layout.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"
#include "sigmascape/base/vec.h"

namespace sigmascape::product {
namespace {

/// A sector of 60° about north-east, a point in one of its bins.
radar::RangeAzimuthImage image_with_point(std::size_t azimuth, std::size_t range) {
  radar::RangeAzimuthImage image;
  image.grid = {.first_range_m = 1000.0,
                .range_step_m = 10.0,
                .ranges = 100,
                .first_azimuth_rad = radians_from_deg(15.0),
                .azimuth_step_rad = radians_from_deg(1.0),
                .azimuths = 60};
  image.rcs_m2 = Array2D<radar::Channels>(60, 100);
  image.rcs_m2(azimuth, range) = {100.0F, 0.0F, 0.0F, 0.0F};
  return image;
}

Vec2d brightest(const radar::GroundMap& map) {
  Vec2d place;
  float most = 0.0F;
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column) {
      if (!(map.sigma0(column, row).vv > most)) continue;
      most = map.sigma0(column, row).vv;
      place = map.grid.centre_of(column, row);
    }
  }
  return place;
}

TEST(Ppi, ShowsAPointInItsDirectionAndRange) {
  const auto image = image_with_point(40, 70);
  const double azimuth = radians_from_deg(55.5), range = 1705.0;
  const radar::GroundMap north_up = ppi(image, {.longer_side = 800});
  const Vec2d place = brightest(north_up);
  EXPECT_NEAR(place.x, range * std::sin(azimuth), 2.0 * north_up.grid.cell_m);
  EXPECT_NEAR(place.y, range * std::cos(azimuth), 2.0 * north_up.grid.cell_m);

  const double heading = radians_from_deg(45.0);
  const radar::GroundMap heading_up = ppi(image, {.up_rad = heading, .longer_side = 800});
  const Vec2d turned = brightest(heading_up);
  EXPECT_NEAR(turned.x, range * std::sin(azimuth - heading), 2.0 * heading_up.grid.cell_m);
  EXPECT_NEAR(turned.y, range * std::cos(azimuth - heading), 2.0 * heading_up.grid.cell_m);
  // The sector lies evenly about the direction that is up.
  EXPECT_NEAR(heading_up.grid.extent().west_m, -heading_up.grid.extent().east_m, 2.0 * heading_up.grid.cell_m);
}

TEST(Ppi, IsEmptyOutsideTheSector) {
  const radar::GroundMap map = ppi(image_with_point(0, 0));
  std::size_t seen = 0;
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column) {
      seen += std::isnan(map.sigma0(column, row).vv) ? 0U : 1U;
    }
  }
  const double sector_m2 = radians_from_deg(60.0) / 2.0 * (2000.0 * 2000.0 - 1000.0 * 1000.0);
  EXPECT_NEAR(static_cast<double>(seen) * map.grid.cell_area_m2() / sector_m2, 1.0, 0.01);
}

// Half way from the last beam to the first there is half of either.
TEST(Ppi, GoesOnAcrossTheEndOfAWholeTurn) {
  radar::RangeAzimuthImage image;
  image.grid = {.first_range_m = 0.0,
                .range_step_m = 10.0,
                .ranges = 40,
                .first_azimuth_rad = 0.0,
                .azimuth_step_rad = pi / 4.0,
                .azimuths = 8};
  image.rcs_m2 = Array2D<radar::Channels>(8, 40);
  for (std::size_t range = 0; range < 40; ++range) image.rcs_m2(7, range) = {1, 1, 1, 1};
  const radar::GroundMap scope = ppi(image, {});
  const auto at = [&](double azimuth_rad) {
    const Vec2d cells = scope.grid.cells_from(Vec2d{std::sin(azimuth_rad), std::cos(azimuth_rad)} * 205.0);
    return scope.sigma0(static_cast<std::size_t>(cells.x), static_cast<std::size_t>(cells.y)).vv;
  };
  const float full = at(7.5 * pi / 4.0);
  EXPECT_NEAR(at(0.01) / full, 0.5F, 0.03F);
  EXPECT_NEAR(at(-0.01) / full, 0.5F, 0.03F);
  EXPECT_NEAR(at(0.25 * pi / 4.0) / full, 0.25F, 0.03F);
}

TEST(BScope, HasAzimuthToTheRightAndRangeUpwards) {
  const auto image = image_with_point(40, 70);
  const radar::GroundMap map = b_scope(image);
  // σ0 = σ / (r Δr Δφ)
  const double expected = 100.0 / (1705.0 * 10.0 * radians_from_deg(1.0));
  EXPECT_NEAR(map.sigma0(40, 100 - 1 - 70).vv, expected, 1e-5 * expected);
  EXPECT_EQ(map.sigma0(40, 70).vv, 0.0F);
}

}  // namespace
}  // namespace sigmascape::product
