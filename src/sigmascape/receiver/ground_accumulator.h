#pragma once

#include <cstdint>
#include <optional>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/receiver/power_bins.h"
#include "sigmascape/receiver/variance_bins.h"

namespace sigmascape::receiver {

/// Sums what stands on cells of the ground, whole in one cell each: power is kept exactly and cells are area means.
/// Where an echo stands is bake::EchoLanding's to say.
class GroundAccumulator {
 public:
  static constexpr std::size_t bytes_a_cell = PowerBins::bytes_a_bin + VarianceBins::bytes_a_bin;

  explicit GroundAccumulator(const radar::GroundGrid& grid);

  /// The cell around a point of the ground, row by row from the north-west; nothing outside the grid.
  [[nodiscard]] std::optional<std::uint32_t> cell_at(Vec2d point) const;
  /// Adds to a cell what is the estimate of a part of it, and the variance of its total power. Independent parts add
  /// up. May be called from several threads at once.
  void add(std::uint32_t cell, const radar::Channels& rcs_m2, double variance_m4);

  [[nodiscard]] const PowerBins& bins() const { return bins_; }
  /// [column, row]: cross-section over cell area.
  [[nodiscard]] Array2D<radar::Channels> sigma0() const;
  /// [column, row]: of the total (radar::Polarization::Sum) of those.
  [[nodiscard]] Array2D<double> sigma0_variances() const;

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
  Axis eastward_, southward_;
  PowerBins bins_;
  VarianceBins variances_;
};

}  // namespace sigmascape::receiver
