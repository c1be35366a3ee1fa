#pragma once

#include <optional>

#include "sigmascape/atlas/tile_address.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::atlas {

/// A rectangle of tiles of one level; maybe none.
struct TileBlock {
  std::size_t level = 0;
  int west = 0, north = 0;  ///< of the north-western tile
  std::size_t across = 0, down = 0;

  /// Column 0 is the westernmost, row 0 the northernmost.
  [[nodiscard]] constexpr TileAddress at(std::size_t column, std::size_t row) const {
    return {level, west + static_cast<int>(column), north - static_cast<int>(row)};
  }
  /// How many there are. They are numbered row by row, from the north-western one.
  [[nodiscard]] constexpr std::size_t size() const { return across * down; }
  [[nodiscard]] constexpr TileAddress at(std::size_t number) const { return at(number % across, number / across); }
  /// The number of a tile; nothing when it is not one of these.
  [[nodiscard]] std::optional<std::size_t> number_of(const TileAddress& tile) const;
};

/// The tiles of a level that share ground with an area: one that only touches an edge does not.
[[nodiscard]] TileBlock tiles_over(const PatchGrid& patches, const radar::Rectangle& area, std::size_t level);

}  // namespace sigmascape::atlas
