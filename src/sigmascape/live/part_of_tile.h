#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sigmascape/atlas/tile_address.h"

namespace sigmascape::live {

/// Where the texels of a tile lie in that of a coarser level which covers it, or in itself.
struct PartOfTile {
  std::uint32_t first_row = 0, first_column = 0;  ///< of the coarser tile
  std::uint32_t levels_up = 0;                    ///< 8 at most: all texels of the tile lie in a single one

  /// `ancestor` covers `tile`.
  [[nodiscard]] static constexpr PartOfTile of(const atlas::TileAddress& tile, const atlas::TileAddress& ancestor) {
    constexpr std::size_t one_texel = 8;
    static_assert(atlas::tile_side == 1U << one_texel);
    const std::size_t up = ancestor.level - tile.level;
    const std::int64_t side = std::int64_t{1} << up;
    // Rows count from the north, tiles from the south.
    const std::int64_t east = tile.x - ancestor.x * side, south = (ancestor.y + 1) * side - 1 - tile.y;
    constexpr auto texels = static_cast<std::int64_t>(atlas::tile_side);
    return {static_cast<std::uint32_t>(south * texels / side), static_cast<std::uint32_t>(east * texels / side),
            static_cast<std::uint32_t>(std::min(up, one_texel))};
  }

  /// Number in the coarser tile, [row][column], of the texel that covers one of the tile.
  [[nodiscard]] constexpr std::size_t index_of(std::uint32_t row, std::uint32_t column) const {
    return (first_row + (row >> levels_up)) * atlas::tile_side + first_column + (column >> levels_up);
  }
};

}  // namespace sigmascape::live
