#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/simulate/layers.h"

namespace sigmascape::simulate {

/// A line over the ground, outwards from below where the radar sees it from.
struct SweptLine {
  Vec3d platform;
  Vec2d direction;  ///< unit vector
};

/// Lines side by side, half a cell apart, over a map and beyond it over whatever may hide it or lie over it.
struct SweptLines {
  std::size_t lines = 0, steps = 0;
  double near_m = 0.0, step_m = 0.0;  ///< of the steps along each, over the ground from the platform
  std::size_t strides = 1;  ///< an odd number that a step is gone over in, so that nothing that stands there is missed
  std::function<SweptLine(std::size_t)> line = {};
  /// Where a point lies among them: in steps from `near_m`, and in lines of which each is at its number.
  std::function<Vec2d(Vec2d)> place_of = {};
  /// Whether a point is one of those that are seen along these lines.
  std::function<bool(Vec2d)> sees = {};
};

/// Of a radar in one place along azimuths about it; of one that maps a strip along the lines over which its beam
/// passes, to both sides of the track where the map lies on both.
[[nodiscard]] std::vector<SweptLines> swept_lines(const CoarseGround& ground, const radar::Vantage& vantage,
                                                  const radar::GroundGrid& grid);

}  // namespace sigmascape::simulate
