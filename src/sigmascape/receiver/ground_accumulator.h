#pragma once

#include <span>

#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/receiver/power_bins.h"

namespace sigmascape::receiver {

/// Puts echoes of an infinitely distant radar straight onto the cells of flat ground.
///
/// An echo at range ρ (from the plane through the local origin that faces the radar) and cross position c stands, for a
/// radar that knows nothing of heights, at the ground point
///
///     a · (−ρ / cos ψ) + b · c            a towards the radar, b to its right           docs/physics/estimator.md, Eq.
///     (5)
///
/// so that what is tall lies over towards the radar by h tan ψ. Each echo goes whole into the cell where it stands:
/// power is kept exactly and cells are area means.
class GroundAccumulator {
 public:
  GroundAccumulator(const radar::GroundGrid& grid, const radar::Aspect& aspect);

  /// May be called from several threads at once.
  void add(std::span<const radar::Echo> echoes);

  [[nodiscard]] const PowerBins& bins() const { return bins_; }
  /// [column, row]: cross-section over cell area.
  [[nodiscard]] Array2D<radar::Channels> sigma0() const;

 private:
  radar::GroundGrid grid_;
  Vec2d towards_radar_;
  Vec2d right_;
  double ground_per_range_;
  PowerBins bins_;
};

}  // namespace sigmascape::receiver
