#pragma once

#include <cstddef>
#include <span>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/radar/value_at.h"

namespace sigmascape::radar {

/// What answers from squares that nothing standing lies over into: echoes from afar, which came late over several
/// bounces. docs/decisions/0131-what-comes-from-afar-is-not-hidden.md.
enum class FromAfar {
  Hidden,    ///< with the ground that they land on. Of textures baked on level ground, where they land says nothing
  Unhidden,  ///< by that ground, unless deeply. Textures baked on their own ground hold them as they were seen
};

/// How high echoes from afar are taken to come from. They seldom land more than 100 m behind what they come from, and
/// ground that has fallen away by half as much below the line of sight hides that too.
inline constexpr float from_afar_m = 50.0F;

/// How high what answers from each square may stand above its ground: as the highest top on it or near enough to lie
/// over into it, whatever the azimuth. Where there is none, from_afar_m or, if what comes from afar is hidden, 0.
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

/// How high what lies over into each square stands, from the heights of what stands on each, [column, row]; 0 where
/// nothing does.
[[nodiscard]] Array2D<float> overlying_tops_m(const Array2D<float>& standing_m, double cell_m);
/// Makes overlying tops answering ones.
void add_what_comes_from_afar(std::span<float> top_m, FromAfar from_afar);
[[nodiscard]] AnsweringTops answering_tops(const ObstacleMap& map, FromAfar from_afar);

}  // namespace sigmascape::radar
