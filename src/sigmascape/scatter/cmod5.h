#pragma once

namespace sigmascape::scatter {

/// Mean σ0 of the sea in C band, VV, by wind [Hersbach 2003, CMOD5]:
///
///     σ0 = b₀ (1 + b₁ cos φ + b₂ cos 2φ)^1.6                        docs/physics/cmod5.md, Eq. (1)
///
/// `wind_speed_mps` at 10 m above the sea, `wind_azimuth_rad` the angle φ between the direction from which the wind
/// blows and the direction to the radar: 0 upwind. Fitted to scatterometers for incidence from 15° to 60°. A formula
/// for checks and for scenes of one look: it says nothing of HH and HV, so that no material is made of it.
[[nodiscard]] double cmod5_sigma0(double wind_speed_mps, double wind_azimuth_rad, double incidence_rad);

}  // namespace sigmascape::scatter
