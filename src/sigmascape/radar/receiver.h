#pragma once

#include <optional>

namespace sigmascape::radar {

/// What comes out of a detector: voltage, power, or the logarithm of power.
enum class Detector { Linear, SquareLaw, Log };

/// Gain that grows with range, so that near ground does not drown what is far: power gain (r/r_full)^exponent up to
/// r_full, one beyond.
struct SensitivityTimeControl {
  double full_gain_range_m = 10e3;
  double exponent = 3.0;
};

/// The converter's side: mid-tread steps over ±full scale.
struct AnalogToDigital {
  int bits = 12;
  double full_scale_v = 1.0;
};

/// What is done with the echoes between the antenna and the processor.
struct Receiver {
  double losses = 1.0;          ///< system losses of the radar equation, transmitting and receiving: power, ≥ 1
  double noise_figure = 2.0;    ///< noise factor F: power, ≥ 1
  double gain = 1.0;            ///< from the antenna's terminals to the detector or converter: power
  double impedance_ohm = 50.0;  ///< that voltages refer to
  /// The range gate opens and closes; absent: with what answers in what is mapped, a few resolutions beside it. Echoes
  /// from beyond an unambiguous range after the gate's opening fold back into it.
  std::optional<double> first_range_m = {}, last_range_m = {};
  std::optional<SensitivityTimeControl> sensitivity_time_control = {};
  Detector detector = Detector::SquareLaw;
  int pulses_integrated = 1;  ///< detector outputs averaged to one
  std::optional<AnalogToDigital> analog_to_digital = {};
};

}  // namespace sigmascape::radar
