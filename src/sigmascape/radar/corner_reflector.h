#pragma once

#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {

/// Greatest cross-sections, m², of conducting calibration targets by physical optics, for sides of many wavelengths
/// [Knott, Shaeffer and Tuley, Radar Cross Section, 2nd edition, chapter 6]: what a point target stands for that is one
/// of them. docs/physics/targets.md, Eq. (4).

/// A flat plate met head-on: 4π A²/λ².
[[nodiscard]] inline double plate_rcs_m2(double area_m2, double wavelength_m) {
  return 4.0 * pi * std::pow(area_m2 / wavelength_m, 2);
}

/// Two rectangles of a × b that meet at right angles along b, seen from the middle between them: 8π a²b²/λ².
[[nodiscard]] inline double dihedral_rcs_m2(double side_m, double edge_m, double wavelength_m) {
  return 8.0 * pi * std::pow(side_m * edge_m / wavelength_m, 2);
}

/// Three triangles with right angles and legs of `leg_m`: 4π a⁴/(3 λ²).
[[nodiscard]] inline double triangular_trihedral_rcs_m2(double leg_m, double wavelength_m) {
  return 4.0 / 3.0 * pi * std::pow(leg_m * leg_m / wavelength_m, 2);
}

/// Three squares: 12π a⁴/λ².
[[nodiscard]] inline double square_trihedral_rcs_m2(double side_m, double wavelength_m) {
  return 12.0 * pi * std::pow(side_m * side_m / wavelength_m, 2);
}

}  // namespace sigmascape::radar
