#pragma once

#include <cstddef>
#include <span>

#include "sigmascape/atlas/obstacle_tiles.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/live/obstacle_page.h"

namespace sigmascape::live {

/// What stands on the ground of an atlas that keeps it apart, tile by tile. One that cannot be read is made from the
/// finest coarser one that can; where there is none nothing stands. Any number of threads may ask at once.
class ObstacleSource {
 public:
  using Page = ObstaclePage;

  explicit ObstacleSource(const atlas::Store& atlas, atlas::Scrutiny scrutiny = atlas::Scrutiny::Content)
      : tiles_(atlas, scrutiny) {}

  /// Fills `page` with what `page.key` names; its memory is used again. There is always something.
  [[nodiscard]] bool fill(ObstaclePage& page) const;
  /// Whether a page was made from a coarser tile.
  [[nodiscard]] static bool lacks_something(const ObstaclePage& page) { return page.levels_lacking > 0; }
  /// Whether the tile itself, or one that is less coarse than that which stands in, can be read by now.
  [[nodiscard]] bool can_be_better(const ObstaclePage& page) const {
    return can_be_read(page.key, page.levels_lacking);
  }
  [[nodiscard]] bool renew(const ObstaclePage&, ObstaclePage& page) const { return fill(page); }

  /// How high what lies over into the texels of a tile stands, [row][column], north up: radar::overlying_tops_m of the
  /// tile's level, with regard to the tiles about it. Gives back what of all these cannot be read, which must not be
  /// asked after the source is gone.
  Shortage fill_tops(const atlas::TileAddress& tile, std::span<float> top_m) const;

  [[nodiscard]] std::size_t levels() const { return tiles_.levels(); }
  /// Tiles of the coarsest level, so that something can stand in for what is missing.
  [[nodiscard]] bool stays(const ObstaclePage& page) const { return page.level() + 1 == levels(); }
  /// Of the whole atlas; an upper bound.
  [[nodiscard]] float tallest_m() const { return tiles_.tallest_m(); }
  /// Files met so far that are not as their items say.
  [[nodiscard]] std::size_t damaged() const { return tiles_.damaged(); }
  /// Of any page.
  [[nodiscard]] static constexpr std::size_t most_bytes() {
    return ObstaclePage::squares * sizeof(PackedObstacle) + sizeof(ObstaclePage);
  }
  [[nodiscard]] const atlas::AtlasDescription& description() const { return tiles_.description(); }

 private:
  /// Calls `each` for every square, in order; by how many levels they are coarser than asked for.
  template <typename Each>
  std::size_t for_each_square(const atlas::TileAddress& tile, Each each) const;
  /// The height of what stands on each square of a tile, [column, row], and by how many levels it is coarser.
  struct Standing {
    Array2D<float> top_m;
    std::size_t levels_lacking = 0;
  };
  [[nodiscard]] Standing standing_on(const atlas::TileAddress& tile) const;
  /// Whether any of so many levels of a tile, its own and the next, can be read.
  [[nodiscard]] bool can_be_read(atlas::TileAddress tile, std::size_t levels) const;

  atlas::ObstacleTiles tiles_;
};

}  // namespace sigmascape::live
