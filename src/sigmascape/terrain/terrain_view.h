#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
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

/// The ground of one frame: heights at the nodes of a piece of one lattice, bilinear between them. It only looks;
/// whoever made it holds the numbers.
///
/// Node (column, row) of the lattice stands at (west + column · spacing, north − row · spacing), as in HeightField.
/// Places are reckoned from there, whichever piece the view is: two views of one lattice give the same ground to the
/// last bit. Beyond the outer nodes there is no ground.
struct TerrainView {
  double lattice_west_m = 0.0;
  double lattice_north_m = 0.0;
  double spacing_m = 1.0;
  std::int64_t first_column = 0, first_row = 0;  ///< of the lattice, which the view begins with
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::span<const float> height_m = {};  ///< [row][column]
  /// Slopes of the ground at the nodes, to be interpolated: where nodes stand wide apart they shade better than the
  /// facets between them. Empty: the slopes of the bilinear surface.
  std::span<const PackedSlope> slope = {};  ///< [row][column]
  float lowest_m = 0.0F;                    ///< bounds of the heights that are asked for; they may be wider
  float highest_m = 0.0F;
  /// Rise over distance along any line over the heights is no more; infinite where nobody has asked.
  float steepest = std::numeric_limits<float>::infinity();

  /// How many columns east and rows south of the lattice's first node a point lies.
  [[nodiscard]] Vec2d nodes_to(Vec2d point) const {
    return {(point.x - lattice_west_m) / spacing_m, (lattice_north_m - point.y) / spacing_m};
  }
  /// Where a node of the view stands.
  [[nodiscard]] Vec2d node(std::size_t column, std::size_t row) const {
    return {lattice_west_m + spacing_m * static_cast<double>(first_column + static_cast<std::int64_t>(column)),
            lattice_north_m - spacing_m * static_cast<double>(first_row + static_cast<std::int64_t>(row))};
  }
  [[nodiscard]] radar::Rectangle extent() const {
    const Vec2d north_west = node(0, 0), south_east = node(columns - 1, rows - 1);
    return {north_west.x, south_east.y, south_east.x, north_west.y};
  }
};

/// A cell of a view and a place in it.
struct PlaceInCell {
  std::size_t north_west;  ///< node of the view, counted row by row
  double u, v;             ///< eastward and southward, 0 to 1
};
/// Of a point; of one beyond the outer nodes that of the nearest edge.
[[nodiscard]] PlaceInCell place_in_cell(const TerrainView& view, Vec2d point);

/// Height of the ground at a point; beyond the outer nodes that of the nearest edge.
[[nodiscard]] double height_at(const TerrainView& view, Vec2d point);

/// How steeply it rises there, east and north.
[[nodiscard]] Vec2d slope_at(const TerrainView& view, Vec2d point);

/// A look at all of a field, which must live as long.
[[nodiscard]] TerrainView view_of(const HeightField& field);

}  // namespace sigmascape::terrain
