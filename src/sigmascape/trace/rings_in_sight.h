#pragma once

#include <cstddef>
#include <optional>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/coarse_heights.h"
#include "sigmascape/trace/launch.h"

namespace sigmascape::trace {

/// Tells from which ring paths can begin that a square's rays lead to.
class RingsInSight {
 public:
  /// Keeps the area, be it an outline.
  RingsInSight(const LaunchArea& area, const scene::Scene& scene, Footing footing);

  /// Above everything on which paths can begin that count, and not above LaunchArea::top_height_m.
  [[nodiscard]] double highest_m() const;

  /// The innermost; none when the rays come to no place where paths begin that count.
  [[nodiscard]] std::optional<std::size_t> innermost(Vec2d centre) const;

 private:
  /// In which what stands there lands at the innermost; the outermost where in none, for its rim is part of it.
  [[nodiscard]] std::size_t ring_of(Vec2d place, Vec2d towards, double layover_m, double about_m) const;
  /// Where vertices stand whose echoes can land where paths begin, and a little more.
  [[nodiscard]] radar::Rectangle region() const;

  const LaunchArea& area_;
  double reach_m_;
  radar::Rectangle region_;
  CoarseHeights bounds_;
};

}  // namespace sigmascape::trace
