#include "sigmascape/live/obstacle_mosaic.h"

#include <cmath>
#include <gtest/gtest.h>

#include "made_obstacles.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/live/ground_sector.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::live {
namespace {

constexpr atlas::PatchGrid patches{.texel_m = 2.0};

/// Names the texel of a level that a point lies in.
float name_of(Vec2d point, std::size_t level) {
  const double side_m = atlas::texel_side_m(patches, level);
  const auto x = static_cast<std::int64_t>(std::floor(point.x / side_m));
  const auto y = static_cast<std::int64_t>(std::floor(point.y / side_m));
  return static_cast<float>(hashed(x, y + 1000 * static_cast<std::int64_t>(level)) % 1000);
}

double uniform(std::uint64_t key, std::uint64_t which) {
  return static_cast<double>(unit_float(hashed(key, which)));
}

TEST(PartOfTile, IsWhereTheGroundOfATileLiesInThatOfAnAncestor) {
  for (const int x : {-300, -3, -1, 0, 5, 777}) {
    atlas::TileAddress tile{0, x, 2 - x}, ancestor = tile;
    const radar::GroundGrid texels = atlas::texels_of(patches, tile);
    for (std::size_t up = 0; up < 11; ++up, ancestor = ancestor.parent()) {
      const PartOfTile part = PartOfTile::of(tile, ancestor);
      const radar::GroundGrid above = atlas::texels_of(patches, ancestor);
      for (const std::uint32_t row : {0U, 1U, 130U, 255U}) {
        for (const std::uint32_t column : {0U, 77U, 254U, 255U}) {
          const Vec2d cell = above.cells_from(texels.centre_of(column, row));
          EXPECT_EQ(part.index_of(row, column),
                    static_cast<std::size_t>(cell.y) * 256 + static_cast<std::size_t>(cell.x))
              << x << " " << up;
        }
      }
    }
  }
}

TEST(ObstacleMosaic, ShowsEachTileByItsOwnPageOrThatOfAnAncestor) {
  const atlas::TileBlock block{.level = 1, .west = -2, .north = 1, .across = 3, .down = 2};
  ObstacleMosaic mosaic;
  mosaic.reset(patches, block);
  const auto page_of = [](const atlas::TileAddress& tile) {
    return MadeObstacles::made_page(
        patches, tile, [&tile](Vec2d point) { return radar::Obstacle{.solid_top_m = name_of(point, tile.level)}; });
  };
  const auto own = page_of(block.at(0, 0)), parents = page_of(block.at(2, 1).parent()),
             grandparents = page_of(block.at(1, 1).parent().parent());
  mosaic.put(0, 0, *own);
  mosaic.put(2, 1, *parents);
  mosaic.put(1, 1, *grandparents);
  const radar::GroundGrid& grid = mosaic.grid();
  const auto level_shown = [](std::size_t column, std::size_t row) -> int {
    if (row == 0) return column == 0 ? 1 : -1;
    return column == 0 ? -1 : (column == 1 ? 3 : 2);
  };
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Vec2d point{grid.west_m + uniform(i, 1) * grid.extent().width_m(),
                      grid.north_m - uniform(i, 2) * grid.extent().height_m()};
    const Vec2d cell = grid.cells_from(point);
    const int level = level_shown(static_cast<std::size_t>(cell.x / 256.0), static_cast<std::size_t>(cell.y / 256.0));
    const float expected = level < 0 ? 0.0F : name_of(point, static_cast<std::size_t>(level));
    ASSERT_EQ(mosaic.at(point).unpacked().solid_top_m, expected) << point.x << " " << point.y;
  }
  EXPECT_EQ(mosaic.at(Vec2d{grid.west_m - 1.0, grid.north_m - 1.0}).solid_top, 0);
}

TEST(GroundSector, MeetsEverySquareThatItHasGroundInAndFewOthers) {
  for (const double width_rad : {0.02, 0.5, 2.0, 2.0 * pi}) {
    const GroundSector sector{{330.0, -120.0}, 5.9, width_rad, 700.0, 2600.0};
    for (const double side_m : {90.0, 400.0, 2500.0}) {
      double met = 0.0;
      constexpr int places = 300;
      for (std::uint64_t place = 0; place < places; ++place) {
        const Vec2d origin{uniform(place, 3) * side_m, uniform(place, 4) * side_m};
        const auto square_at = [&](int x, int y) {
          const double west_m = origin.x + x * side_m, south_m = origin.y + y * side_m;
          return radar::Rectangle{west_m, south_m, west_m + side_m, south_m + side_m};
        };
        const int reach = static_cast<int>(3000.0 / side_m) + 2;
        for (int y = -reach; y <= reach; ++y) {
          for (int x = -reach; x <= reach; ++x) met += sector.may_meet(square_at(x, y)) ? 1.0 : 0.0;
        }
        for (std::uint64_t i = 0; i < 20; ++i) {
          const double azimuth = sector.first_azimuth_rad + uniform(i, 5 + place) * width_rad;
          const double distance_m = sector.near_m + uniform(i, 99 + place) * (sector.far_m - sector.near_m);
          const Vec2d point = sector.radar + radar::horizontal_direction(azimuth) * distance_m;
          ASSERT_TRUE(sector.may_meet(square_at(static_cast<int>(std::floor((point.x - origin.x) / side_m)),
                                                static_cast<int>(std::floor((point.y - origin.y) / side_m)))));
        }
      }
      EXPECT_NEAR(met / places / sector.squares_met(side_m), 1.0, 0.25) << width_rad << " " << side_m;
    }
  }
}

}  // namespace
}  // namespace sigmascape::live
