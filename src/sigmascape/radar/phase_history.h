#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/receiver.h"

namespace sigmascape::radar {

/// One pulse: when it was sent, and where the antenna's phase centre then was.
struct Pulse {
  double time_s = 0.0;
  Motion platform;
  /// Where the beam's axis pointed, clockwise from the frame's north, if the record has the antenna in it.
  std::optional<double> beam_azimuth_rad = {};
};

/// What a pulse radar records: for every pulse the compressed echo over slant range, as complex numbers (I and Q), a
/// polarization each.
///
/// A point at distance r from the phase centre answers in a pulse with
///
///     a · h(R_m − r) · exp(−4πi r f/c)                                        docs/physics/doppler.md, Eq. (7)
///
/// h the compressed pulse, real, one at its peak; R_m the range of sample m. No focusing, no motion compensation, no
/// shift in frequency: the phase is that of the carrier, down to the last wavelength.
struct PhaseHistory {
  double frequency_hz = 0.0;
  double bandwidth_hz = 0.0;
  double first_range_m = 0.0;  ///< of sample 0: its middle
  double range_step_m = 0.0;   ///< at most c/2B
  std::vector<Pulse> pulses;
  /// [range, pulse]: column = range sample, row = pulse.
  Array2D<ComplexChannels> samples;
  /// What a sample of one stands for: "V" at the radar's reference, or "m", the square root of a cross-section.
  std::string unit = "m";
  /// What samples in volts, noise and all, have been through in the receiver, in this order.
  std::optional<SensitivityTimeControl> sensitivity_time_control = {};
  std::optional<AnalogToDigital> analog_to_digital = {};
  std::uint64_t saturated = 0;  ///< samples of one polarization of which the converter has clipped I or Q
};

}  // namespace sigmascape::radar
