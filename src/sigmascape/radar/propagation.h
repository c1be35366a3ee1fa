#pragma once

namespace sigmascape::radar {

/// Mean radius of the Earth (IUGG R₁), m.
inline constexpr double earth_radius_m = 6'371'008.8;
/// By what factor the Earth's radius is enlarged so that rays in a standard atmosphere become straight lines.
inline constexpr double standard_refraction = 4.0 / 3.0;

/// How far level ground has dropped below the tangent plane at a horizontal distance: d²/(2 k R), k the refraction.
[[nodiscard]] double earth_drop_m(double distance_m, double refraction = standard_refraction);
/// The distance at which a radar at this height sees level ground last: √(2 k R h).
[[nodiscard]] double horizon_distance_m(double height_m, double refraction = standard_refraction);

}  // namespace sigmascape::radar
