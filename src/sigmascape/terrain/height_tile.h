#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::terrain {

/// Which tile of a pyramid: level 0 is the finest, column 0 the westernmost, row 0 the northernmost.
struct TileKey {
  int level = 0;
  std::uint32_t column = 0, row = 0;

  friend constexpr auto operator<=>(const TileKey&, const TileKey&) = default;
  [[nodiscard]] constexpr TileKey parent() const { return {level + 1, column / 2, row / 2}; }
};

/// What is known of a tile without opening it.
struct TileSummary {
  float lowest_m = 0.0F, highest_m = 0.0F;  ///< of the tile and of all finer ones beneath it
  /// No point of level 0 lies further than this above or below the tile's own surface.
  float error_m = 0.0F;
};

/// 256 × 256 cells of terrain, bilinear between their nodes. The outermost nodes are shared with the neighbours.
struct HeightTile {
  static constexpr std::size_t cells = 256;
  static constexpr std::size_t nodes = cells + 1;
  static constexpr std::size_t bytes = nodes * nodes * sizeof(float);

  std::vector<float> height_m;  ///< [row][column]
  TileSummary summary = {};

  /// Height at a place in cells from the north-western node.
  [[nodiscard]] float at(double column, double row) const;
};

/// How tiles lie: nodes of level k stand 2ᵏ · spacing apart, all levels begin at the same north-western node, and one
/// tile covers everything at the last.
struct PyramidLayout {
  double west_m = 0.0, north_m = 0.0;
  double spacing_m = 1.0;
  std::uint32_t tiles_across = 1, tiles_down = 1;  ///< of level 0

  friend bool operator==(const PyramidLayout&, const PyramidLayout&) = default;

  /// The smallest layout of that spacing whose tiles cover the rectangle, from its north-western corner on.
  [[nodiscard]] static PyramidLayout covering(const radar::Rectangle& rectangle, double spacing_m);

  [[nodiscard]] int levels() const;
  [[nodiscard]] double spacing_at(int level) const { return spacing_m * static_cast<double>(1U << level); }
  [[nodiscard]] std::uint32_t across(int level) const { return ((tiles_across - 1) >> level) + 1; }
  [[nodiscard]] std::uint32_t down(int level) const { return ((tiles_down - 1) >> level) + 1; }
  [[nodiscard]] bool has(TileKey key) const;
  [[nodiscard]] radar::Rectangle extent_of(TileKey key) const;
  /// Of all tiles of level 0; those of other levels may reach beyond it.
  [[nodiscard]] radar::Rectangle extent() const;
};

}  // namespace sigmascape::terrain
