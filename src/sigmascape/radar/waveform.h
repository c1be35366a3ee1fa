#pragma once

#include "sigmascape/radar/window.h"

namespace sigmascape::radar {

/// What is sent. The bandwidth follows from Radar::range_resolution_m and the window: `bandwidth_of`.
struct Waveform {
  double peak_power_w = 10e3;
  /// A constant, whatever the resolution is: a radar file that does not state it takes the shortest pulse that has the
  /// bandwidth, one over it.
  double pulse_length_s = 10e-6;
  double pulse_repetition_hz = 1000.0;
  Window window = {};  ///< over the band, in the receiver; the transmitted pulse is not weighted
};

}  // namespace sigmascape::radar
