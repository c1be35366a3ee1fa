#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::atlas {

/// Number of a patch on the world lattice: patch (0, 0) has its south-western corner at the origin of the local frame,
/// x counts eastward and y northward.
struct PatchIndex {
  int x = 0;
  int y = 0;

  friend constexpr bool operator==(const PatchIndex&, const PatchIndex&) = default;
};

/// The patches of a rectangle, by default of an empty one. Takes the same room however many they are.
struct PatchBlock {
  PatchIndex south_west;
  PatchIndex north_east{-1, -1};  ///< the last one

  [[nodiscard]] std::size_t columns() const;
  [[nodiscard]] std::size_t rows() const;
  [[nodiscard]] std::size_t size() const { return columns() * rows(); }
  /// Row by row from the north-west.
  [[nodiscard]] PatchIndex operator[](std::size_t number) const;
};

/// Side of the smallest level that is stored, and of the tiles of the files, in texels.
inline constexpr std::size_t tile_side = 256;
/// Of a patch.
inline constexpr std::size_t most_texels_per_side = 16384;

/// Square patches that tile the local frame from its origin, so that bakes of neighbouring places fit together texel on
/// texel.
struct PatchGrid {
  double texel_m = 1.0;
  std::size_t texels_per_side = tile_side;  ///< 256 · 2ⁿ

  friend constexpr bool operator==(const PatchGrid&, const PatchGrid&) = default;

  [[nodiscard]] double side_m() const { return texel_m * static_cast<double>(texels_per_side); }
  /// n + 1: from 256 · 2ⁿ texels a side down to 256.
  [[nodiscard]] std::size_t stored_levels() const;
  /// The texels of a patch at level 0.
  [[nodiscard]] radar::GroundGrid texels_of(PatchIndex patch) const;
  [[nodiscard]] PatchIndex patch_at(Vec2d point_m) const;
  /// The patches that share area with the rectangle; none when it has no area.
  [[nodiscard]] PatchBlock block_over(const radar::Rectangle& rectangle) const;
  /// The same one by one, row by row from the north-west.
  [[nodiscard]] std::vector<PatchIndex> covering(const radar::Rectangle& rectangle) const;
};

/// Throws Error, naming `where`, when the texel is not positive or the side not 256 · 2ⁿ up to 16384.
void check(const PatchGrid& grid, std::string_view where);

}  // namespace sigmascape::atlas
