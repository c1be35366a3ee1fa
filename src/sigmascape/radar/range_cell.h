#pragma once

#include "sigmascape/base/units.h"
#include "sigmascape/radar/window_response.h"

namespace sigmascape::radar {

/// ∫|h|² of a compressed pulse h, one at its peak, over slant range: c/2B · n_w, n_w the noise bandwidth of the window
/// over its band. Even ground has σ0 times the area of this cell in a sample, in the mean. docs/physics/doppler.md, Eq.
/// (11).
[[nodiscard]] inline double range_cell_m(double bandwidth_hz, const Window& window) {
  return speed_of_light_mps / (2.0 * bandwidth_hz) * WindowResponse(window).noise_bandwidth();
}

}  // namespace sigmascape::radar
