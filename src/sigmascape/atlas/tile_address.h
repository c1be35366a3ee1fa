#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::atlas {

/// A square of tile_side × tile_side texels of one level, numbered on the world lattice: tile (0, 0) has its
/// south-western corner at the origin of the local frame, x counts eastward and y northward, at every level.
struct TileAddress {
  std::size_t level = 0;
  int x = 0;
  int y = 0;

  friend constexpr bool operator==(const TileAddress&, const TileAddress&) = default;
  friend constexpr auto operator<=>(const TileAddress&, const TileAddress&) = default;

  /// The tile of the next coarser level that covers this one.
  [[nodiscard]] constexpr TileAddress parent() const {
    return {level + 1, x >= 0 ? x / 2 : (x - 1) / 2, y >= 0 ? y / 2 : (y - 1) / 2};
  }
};

/// Side of a texel of that level.
[[nodiscard]] constexpr double texel_side_m(const PatchGrid& patches, std::size_t level) {
  return patches.texel_m * static_cast<double>(std::uint64_t{1} << level);
}

/// Side of a tile of that level.
[[nodiscard]] constexpr double tile_side_m(const PatchGrid& patches, std::size_t level) {
  return texel_side_m(patches, level) * static_cast<double>(tile_side);
}

/// The texels of a tile, north up.
[[nodiscard]] radar::GroundGrid texels_of(const PatchGrid& patches, const TileAddress& tile);

/// Where a tile stands: in the file of which patch or place of the pyramid, in which of its levels, and which of the
/// level's tiles it is, row by row from the north-west.
struct TilePlace {
  PyramidTile file;
  std::size_t level = 0, index = 0;

  friend constexpr bool operator==(const TilePlace&, const TilePlace&) = default;
};

[[nodiscard]] TilePlace place_of(const PatchGrid& patches, const TileAddress& tile);

}  // namespace sigmascape::atlas
