#include "sigmascape/product/reprojection.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/coordinate_transform.h"

namespace sigmascape::product {
namespace {

const geo::LocalFrame bilbao(43.263, -2.935);

/// 2 × 2 km about the origin of the frame, brighter to the north-east, as a plane.
radar::GroundMap map_of_a_slope() {
  radar::GroundMap map;
  map.grid = {-1000.0, 1000.0, 20.0, 100, 100};
  map.crs = bilbao.proj();
  map.sigma0 = Array2D<radar::Channels>(100, 100);
  for (std::size_t row = 0; row < 100; ++row) {
    for (std::size_t column = 0; column < 100; ++column) {
      const Vec2d place = map.grid.centre_of(column, row);
      const auto vv = static_cast<float>(10.0 + 0.002 * place.x + 0.003 * place.y);
      map.sigma0(column, row) = {vv, vv, vv, vv};
    }
  }
  return map;
}

class Reprojection : public testing::TestWithParam<const char*> {};

TEST_P(Reprojection, KeepsEveryPlaceWhereItIs) {
  const radar::GroundMap map = reprojected(map_of_a_slope(), bilbao, GetParam());
  EXPECT_EQ(map.crs, GetParam());
  const geo::CoordinateTransform transform(GetParam(), bilbao, "test");
  std::size_t seen = 0;
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column) {
      Vec2d place = map.grid.centre_of(column, row);
      transform.to_frame({&place, 1});
      const float found = map.sigma0(column, row).vv;
      if (std::abs(place.x) > 985.0 || std::abs(place.y) > 985.0) continue;
      ASSERT_NEAR(found, 10.0 + 0.002 * place.x + 0.003 * place.y, 1e-3);
      ++seen;
    }
  }
  // As many cells as the map had, less its rim.
  EXPECT_NEAR(static_cast<double>(seen), 9700.0, 400.0);
}

INSTANTIATE_TEST_SUITE_P(Systems, Reprojection, testing::Values("EPSG:25830", "EPSG:4326", "EPSG:3857"));

TEST(Reprojection, RefusesWhatIsNoSystem) {
  EXPECT_THROW((void)reprojected(map_of_a_slope(), bilbao, "EPSG:none"), Error);
  EXPECT_THROW((void)reprojected(map_of_a_slope(), bilbao, "EPSG:25830", -1.0), Error);
}

}  // namespace
}  // namespace sigmascape::product
