#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/receiver/power_bins.h"
#include "sigmascape/receiver/variance_bins.h"

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

  /// The cell where an echo stands, row by row from the north-west; nothing when that is outside the grid.
  [[nodiscard]] std::optional<std::uint32_t> cell_of(const radar::Echo& echo) const;
  /// The cell around a point of the ground, numbered likewise.
  [[nodiscard]] std::optional<std::uint32_t> cell_at(Vec2d point) const;
  /// Adds to a cell what is the estimate of a part of it, and the variance of its total power. Independent parts add
  /// up. May be called from several threads at once.
  void add(std::uint32_t cell, const radar::Channels& rcs_m2, double variance_m4);

  [[nodiscard]] const PowerBins& bins() const { return bins_; }
  /// [column, row]: cross-section over cell area.
  [[nodiscard]] Array2D<radar::Channels> sigma0() const;
  /// [column, row]: standard error of the total power (radar::Polarization::Sum) over that power; 0 where there is
  /// none.
  [[nodiscard]] Array2D<float> relative_errors() const;

 private:
  /// Cells along one axis, counted so that grids which are parts of one lattice agree to the last bit on where each
  /// cell ends.
  class Axis {
   public:
    Axis(double start_m, double cell_m);
    [[nodiscard]] double cell_of(double position_m) const;

   private:
    double cell_m_, first_, offset_;
  };

  radar::GroundGrid grid_;
  Vec2d towards_radar_;
  Vec2d right_;
  Axis eastward_, southward_;
  double ground_per_range_;
  PowerBins bins_;
  VarianceBins variances_;
};

}  // namespace sigmascape::receiver
