#pragma once

#include <cstdint>
#include <functional>

#include "sigmascape/radar/phase_history.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/receiver/voltage_gain.h"

namespace sigmascape::receiver {

/// Where the beam's axis points, clockwise from the frame's north, when a pulse is sent.
using BeamAzimuth = std::function<double(const radar::Pulse& pulse)>;

/// The axis follows a point of the ground, as in a spotlight.
[[nodiscard]] BeamAzimuth towards(Vec3d point);
/// The axis keeps an azimuth, as that of an antenna that does not scan.
[[nodiscard]] BeamAzimuth fixed_at(double azimuth_rad);
/// The axis keeps an angle clockwise from the direction of flight, as in a strip map.
[[nodiscard]] BeamAzimuth abeam(double clockwise_rad);

/// Volts across the receiver's impedance, behind its gain and the compression of the pulse, of a cross-section of 1 m²:
///
///     v = f g_φ² g_ε² √(P_t G₀² λ² e^(−2αr) / ((4π)³ r⁴ L) · G_c G_r R)      docs/physics/doppler.md, Eq. (10)
///
/// f is the part of the echo that is heard before the next pulse deafens the receiver (radar::uneclipsed_part).
/// |v|²/R is the peak power of its echo there; a sample's real part is I, its imaginary part Q, of the complex
/// envelope's r.m.s. value.
[[nodiscard]] VoltageGain calibrated_voltage(const radar::Radar& radar, BeamAzimuth beam);

/// Adds thermal noise of k T₀ B F, behind the same gain and impedance, to a record in volts: complex Gaussian, white
/// over the band and shaped by the receiver's window, independent between pulses and polarizations. A pure function of
/// the seed. Sets nothing else. Throws Error when the record is not in volts.
void add_thermal_noise(radar::PhaseHistory& history, const radar::Radar& radar, std::uint64_t seed,
                       unsigned threads = 0);

}  // namespace sigmascape::receiver
