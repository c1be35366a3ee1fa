#pragma once

#include <span>

#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/receiver/power_bins.h"

namespace sigmascape::receiver {

/// Puts echoes of an infinitely distant radar into range and cross-range bins first and re-projects those onto level
/// ground, as the paper bakes. GroundAccumulator is the direct way.
///
/// A bin is as wide on level ground as a cell of the map: cell · cos ψ in range, cell across. An echo goes whole into
/// one bin. A cell of the map then takes the bins at its centre, bilinearly between the four nearest, over the ground
/// that a bin covers. Neither the total power nor a single bright point's is kept exactly by that.
class PolarGround {
 public:
  PolarGround(const radar::GroundGrid& grid, const radar::Aspect& aspect);

  /// May be called from several threads at once.
  void add(std::span<const radar::Echo> echoes);

  [[nodiscard]] const PowerBins& bins() const { return bins_; }
  /// [column, row]: cross-section over area on level ground.
  [[nodiscard]] Array2D<radar::Channels> sigma0() const;

 private:
  radar::GroundGrid grid_;
  Vec2d towards_radar_, right_;
  double cos_elevation_;
  std::size_t side_;  ///< bins along either axis: those of the square that holds the grid however it is turned
  Vec2d centre_;      ///< of the grid
  PowerBins bins_;
};

}  // namespace sigmascape::receiver
