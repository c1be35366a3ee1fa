#pragma once

#include <vector>

#include "sigmascape/radar/radar.h"

namespace sigmascape::receiver {

/// How the power of one bin spreads over its neighbours along one axis.
struct BinResponse {
  /// Odd in number, the middle one for the bin itself; they sum to one.
  std::vector<float> weights;
  /// The response's energy in bins of its peak, wherever that lies. A point of cross-section σ has σ over `peak_bins`
  /// in a bin that the response's peak falls on.
  double peak_bins = 1.0;
};

/// The compressed pulse's |h|² at steps of the bins, followed until no more than 3e-4 of its power is left out, at most
/// 64 resolution cells to either side.
[[nodiscard]] BinResponse range_response(const radar::Radar& radar, double range_step_m);
/// The beam's two-way power pattern at steps of the bins, followed until no more than 1e-5 of its power is left out, at
/// most half a turn to either side.
[[nodiscard]] BinResponse azimuth_response(const radar::Radar& radar, double azimuth_step_rad);

}  // namespace sigmascape::receiver
