#pragma once

#include <cstddef>

#include "sigmascape/live/frame.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/complex_channels.h"

namespace sigmascape::live {

/// The power of one bin of a frame, beam · ranges + range: of amplitudes their squares.
[[nodiscard]] inline radar::Channels power_of_bin(const Frame& frame, std::size_t bin) {
  if (!frame.powers_m2.empty()) {
    const auto power_m2 = frame.powers_m2.subspan(4 * bin, 4);
    return {power_m2[0], power_m2[1], power_m2[2], power_m2[3]};
  }
  const auto amplitude_m = frame.amplitudes_m.subspan(4 * bin, 4);
  return radar::power_of({amplitude_m[0], amplitude_m[1], amplitude_m[2]});
}

}  // namespace sigmascape::live
