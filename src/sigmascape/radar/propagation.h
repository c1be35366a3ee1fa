#pragma once

namespace sigmascape::radar {

/// Mean radius of the Earth (IUGG R₁), m.
inline constexpr double earth_radius_m = 6'371'008.8;
/// By what factor the Earth's radius is enlarged so that rays in a standard atmosphere become straight lines.
inline constexpr double standard_refraction = 4.0 / 3.0;

/// How far level ground has dropped below the tangent plane at a horizontal distance, d²/(2 k R).
/// docs/physics/propagation.md, Eq. (1).
[[nodiscard]] double earth_drop_m(double distance_m, double refraction = standard_refraction);
/// The distance at which a radar at this height sees level ground last, √(2 k R h). docs/physics/propagation.md, Eq.
/// (2).
[[nodiscard]] double horizon_distance_m(double height_m, double refraction = standard_refraction);
/// What an atmosphere that takes `db_per_km` one way leaves of the power on the way out and back over `slant_range_m`.
[[nodiscard]] double two_way_transmission(double slant_range_m, double db_per_km);

}  // namespace sigmascape::radar
