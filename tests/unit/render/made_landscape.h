#pragma once

#include <functional>

#include "sigmascape/radar/obstacle.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// Squares of a kilometre about the origin.
inline constexpr double square_m = 2.0, half_m = 512.0;

/// Terrain as high as a function says.
inline terrain::HeightField ground(const std::function<double(Vec2d)>& height_m) {
  constexpr double spacing_m = 8.0;
  constexpr auto nodes = static_cast<std::size_t>(2.0 * half_m / spacing_m) + 1;
  terrain::HeightField field{-half_m, half_m, spacing_m, Array2D<float>(nodes, nodes)};
  for (std::size_t row = 0; row < nodes; ++row) {
    for (std::size_t column = 0; column < nodes; ++column) {
      field.height_m(column, row) = static_cast<float>(
          height_m({-half_m + spacing_m * static_cast<double>(column), half_m - spacing_m * static_cast<double>(row)}));
    }
  }
  return field;
}

inline terrain::HeightField level_ground() {
  return ground([](Vec2d) { return 0.0; });
}

/// What stands there, by the middles of squares.
inline radar::ObstacleMap obstacles(const std::function<radar::Obstacle(Vec2d)>& standing) {
  constexpr auto side = static_cast<std::size_t>(2.0 * half_m / square_m);
  radar::ObstacleMap map{{-half_m, half_m, square_m, side, side}, Array2D<radar::Obstacle>(side, side)};
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column)
      map.obstacles(column, row) = standing(map.grid.centre_of(column, row));
  }
  return map;
}

/// Solid where y lies between two values.
inline std::function<radar::Obstacle(Vec2d)> solid_bar(double from_m, double to_m, float top_m) {
  return [=](Vec2d place) { return radar::Obstacle{.solid_top_m = place.y > from_m && place.y < to_m ? top_m : 0.0F}; };
}

}  // namespace sigmascape::render
