#pragma once

#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// Power at the antenna's terminals from a cross-section σ at slant range r, at the peak of the beam and before pulse
/// compression:
///
///     P = P_t G₀² λ² σ exp(−2αr) / ((4π)³ r⁴ L)                                docs/physics/radar_equation.md, Eq. (1)
///
/// P_t peak power, G₀ the antenna's peak gain, λ wavelength, L all system losses, α the atmosphere's.
[[nodiscard]] double received_power_w(const Radar& radar, double rcs_m2, double slant_range_m);

/// By how much pulse compression lifts the signal above noise of bandwidth B: B τ over the window's noise bandwidth.
/// One for an unmodulated pulse of τ = 1/B in a receiver without weighting. docs/physics/radar_equation.md, Eq. (3).
[[nodiscard]] double compression_gain(const Radar& radar);

/// Volts across the receiver's impedance R, behind its gain G_r, of the same echo compressed: √(P C G_r R).
/// docs/physics/radar_equation.md, Eqs. (1), (3).
[[nodiscard]] double received_voltage_v(const Radar& radar, double rcs_m2, double slant_range_m);

/// Peak signal power over mean noise power of one compressed pulse. docs/physics/radar_equation.md, Eq. (4).
[[nodiscard]] double signal_to_noise(const Radar& radar, double rcs_m2, double slant_range_m);

}  // namespace sigmascape::radar
