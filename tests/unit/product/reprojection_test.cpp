#include "sigmascape/product/reprojection.h"

#include <algorithm>
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

// Cells of 0.3 m have no exact sum.
TEST(Reprojection, IntoTheMapsOwnFrameLeavesItAsItIs) {
  radar::GroundMap map = map_of_a_slope();
  map.grid = {-1000.1, 999.7, 0.3, 100, 100};
  map.sigma0(3, 4) = radar::Channels{NAN, NAN, NAN, NAN};
  const radar::GroundMap same = reprojected(map, bilbao, bilbao.proj());
  EXPECT_EQ(same.grid, map.grid);
  for (std::size_t row = 0; row < 100; ++row) {
    for (std::size_t column = 0; column < 100; ++column) {
      if (column == 3 && row == 4) continue;
      ASSERT_EQ(same.sigma0(column, row), map.sigma0(column, row));
    }
  }
  EXPECT_TRUE(std::isnan(same.sigma0(3, 4).vv));
  EXPECT_EQ(reprojected(map, bilbao, bilbao.proj(), 0.6).grid.columns, 50U);
}

// Where the radar is told to be is in that frame still.
TEST(Reprojection, NamesTheFrameThatItCameFrom) {
  radar::GroundMap map = map_of_a_slope();
  map.metadata = {{"radar_position_m", "1.00 2.00 3.00"}};
  const auto turned = reprojected(map, bilbao, "EPSG:4326");
  EXPECT_EQ(turned.metadata.at("radar_position_m"), "1.00 2.00 3.00");
  EXPECT_EQ(turned.metadata.at("local_frame"), bilbao.proj());
}

TEST(Reprojection, RefusesWhatIsNoSystem) {
  EXPECT_THROW((void)reprojected(map_of_a_slope(), bilbao, "EPSG:none"), Error);
  EXPECT_THROW((void)reprojected(map_of_a_slope(), bilbao, "EPSG:25830", -1.0), Error);
}

TEST(Reprojection, LayersLieOnTheCellsOfTheMap) {
  const radar::GroundMap map = map_of_a_slope();
  radar::LayerStack stack{.grid = map.grid, .layers = {}, .crs = map.crs, .metadata = {}};
  Array2D<float> masks(100, 100), heights(100, 100);
  for (std::size_t row = 0; row < 100; ++row) {
    for (std::size_t column = 0; column < 100; ++column) {
      masks(column, row) = (column + row) % 2 == 0 ? 1.0F : 0.0F;
      heights(column, row) = map.sigma0(column, row).vv;
    }
  }
  stack.layers = {{.name = "shadow", .unit = "", .values = masks}, {.name = "height", .unit = "m", .values = heights}};
  const radar::LayerStack turned = reprojected(stack, bilbao, "EPSG:4326");
  const radar::GroundMap of_map = reprojected(map, bilbao, "EPSG:4326");
  EXPECT_EQ(turned.grid, of_map.grid);
  EXPECT_EQ(turned.crs, "EPSG:4326");
  for (std::size_t i = 0; i < of_map.sigma0.size(); ++i) {
    const float mask = turned.layers[0].values.values()[i], height = turned.layers[1].values.values()[i];
    ASSERT_TRUE(std::isnan(mask) || mask == 0.0F || mask == 1.0F);
    if (!std::isnan(height)) {
      ASSERT_FLOAT_EQ(height, of_map.sigma0.values()[i].vv);
    }
  }
}

TEST(Reprojection, MapsMayLieAcrossTheMeridianOf180Degrees) {
  const geo::LocalFrame fiji(-17.0, 180.0);
  const radar::GroundMap map = reprojected(map_of_a_slope(), fiji, "EPSG:4326");
  EXPECT_NEAR(map.grid.extent().width_m(), 2000.0 / 106.5e3, 2e-4);
  const auto seen = std::ranges::count_if(map.sigma0.values(), [](const auto& cell) { return cell.vv > 0.0F; });
  EXPECT_GT(static_cast<double>(seen), 0.9 * static_cast<double>(map.sigma0.size()));
  EXPECT_THROW((void)reprojected(map_of_a_slope(), fiji, "EPSG:3857"), Error) << "whose seam lies there";
}

}  // namespace
}  // namespace sigmascape::product
