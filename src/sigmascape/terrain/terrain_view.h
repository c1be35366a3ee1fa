#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sigmascape/terrain/height_field.h"

namespace sigmascape::terrain {

/// The slope of the ground, east and north, as two 16-bit numbers in one word: what sampling in single instructions can
/// fetch. Steps of 1/2048, up to ±16.
struct PackedSlope {
  static constexpr float steps_per_unit = 2048.0F;
  std::int16_t east = 0;
  std::int16_t north = 0;
};

/// The ground of one frame: heights at the nodes of one lattice, bilinear between them. It only looks; whoever made it
/// holds the numbers.
///
/// Node (column, row) stands at (west + column · spacing, north − row · spacing), as in HeightField. Beyond the outer
/// nodes there is no ground.
struct TerrainView {
  double west_m = 0.0;
  double north_m = 0.0;
  double spacing_m = 1.0;
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::span<const float> height_m = {};  ///< [row][column]
  /// Slopes of the ground at the nodes, to be interpolated: where nodes stand wide apart they shade better than the
  /// facets between them. Empty: the slopes of the bilinear surface.
  std::span<const PackedSlope> slope = {};  ///< [row][column]
  float lowest_m = 0.0F;                    ///< bounds of all heights; they may be wider
  float highest_m = 0.0F;

  [[nodiscard]] radar::Rectangle extent() const {
    return {west_m, north_m - spacing_m * static_cast<double>(rows - 1),
            west_m + spacing_m * static_cast<double>(columns - 1), north_m};
  }
};

/// Height of the ground at a point; beyond the outer nodes that of the nearest edge.
[[nodiscard]] double height_at(const TerrainView& view, Vec2d point);

/// How steeply it rises there, east and north.
[[nodiscard]] Vec2d slope_at(const TerrainView& view, Vec2d point);

/// A look at all of a field, which must live as long.
[[nodiscard]] TerrainView view_of(const HeightField& field);

}  // namespace sigmascape::terrain
