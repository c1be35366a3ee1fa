#pragma once

#include <cstddef>

#include "sigmascape/radar/radar.h"
#include "sigmascape/receiver/response_axis.h"

namespace sigmascape::receiver {

/// Of what ranges samples are taken, and how densely.
struct RangeGate {
  double first_range_m = 0.0;
  double last_range_m = 0.0;
  double oversampling = 1.2;  ///< samples a resolution c/2B, at least 1; a little more where that transforms fast
  double over_slant = 1.0;    ///< these ranges over slant ranges: 1, or the cosine of the squint of a strip
};

/// The gate as an axis of responses, with room at both ends for side lobes that reach into it from outside.
struct GatedAxis {
  ResponseAxis axis;
  double period_m = 0.0;      ///< that the axis covers
  double step_m = 0.0;        ///< between samples
  double start_m = 0.0;       ///< range of the axis' first sample
  std::size_t guard = 0;      ///< samples before the gate
  std::size_t samples = 0;    ///< within the gate
  double bandwidth_hz = 0.0;  ///< of range
};

/// The axis from `first_m` to `last_m` for cells of one over the band.
[[nodiscard]] GatedAxis guarded_axis(double first_m, double last_m, double cell_m, double oversampling,
                                     const radar::Window& window);

/// Throws Error when the gate is empty, endless or sampled too thinly.
[[nodiscard]] GatedAxis gated_axis(const radar::Radar& radar, const RangeGate& gate);

}  // namespace sigmascape::receiver
