#pragma once

#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/radar/value_at.h"

namespace sigmascape::radar {

/// How high what answers from each square may stand above its ground: as the highest top on it or near enough to lie
/// over into it, whatever the azimuth.
///
/// What stands on the ground answers before its foot, from squares on which nothing stands. How much of that a ridge
/// leaves to be seen is a question of its height, not of what stands on those squares.
/// docs/decisions/0119-what-lies-over-is-seen-by-its-own-height.md.
struct AnsweringTops {
  GroundGrid grid;
  Array2D<float> top_m;  ///< [column, row]

  /// At a point; 0 outside the grid.
  [[nodiscard]] float at(Vec2d point) const { return value_at(grid, top_m, point); }
};

/// By how many squares at most a thing so high lies over beyond those that it stands on: h tan ψ for ψ up to 14°, and
/// one more, for its wall stands somewhere within a square.
[[nodiscard]] std::size_t layover_squares(double top_m, double cell_m);

/// From the heights of what stands on each square, [column, row].
[[nodiscard]] Array2D<float> answering_tops_m(const Array2D<float>& standing_m, double cell_m);
[[nodiscard]] AnsweringTops answering_tops(const ObstacleMap& map);

}  // namespace sigmascape::radar
