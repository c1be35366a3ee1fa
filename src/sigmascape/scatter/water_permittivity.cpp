#include "sigmascape/scatter/water_permittivity.h"

#include <cmath>

namespace sigmascape::scatter {
namespace {

/// The parameters of two Debye relaxations.
struct Relaxations {
  double static_value, middle, infinite;
  double first_ghz, second_ghz;

  [[nodiscard]] std::complex<double> at(double f_ghz) const {
    const std::complex<double> first(1.0, f_ghz / first_ghz);
    const std::complex<double> second(1.0, f_ghz / second_ghz);
    return (static_value - middle) / first + (middle - infinite) / second + infinite;
  }
};

/// ITU-R P.527-4, Eqs. (8)–(13).
Relaxations pure_water(double temperature_c) {
  const double theta = 300.0 / (temperature_c + 273.15) - 1.0;
  const double static_value = 77.66 + 103.3 * theta;
  const double first_ghz = 20.20 - 146.4 * theta + 316.0 * theta * theta;
  return {static_value, 0.0671 * static_value, 3.52 - 7.52 * theta, first_ghz, 39.8 * first_ghz};
}

/// ITU-R P.527-4, Eqs. (17)–(21), after Meissner and Wentz 2004.
Relaxations salted(Relaxations water, double t, double s) {
  water.static_value *= std::exp(-3.56417e-3 * s + 4.74868e-6 * s * s + 1.15574e-5 * t * s);
  water.middle *= std::exp(-6.28908e-3 * s + 1.76032e-4 * s * s - 9.22144e-5 * t * s);
  water.infinite *= 1.0 + s * (-2.04265e-3 + 1.57883e-4 * t);
  water.first_ghz *= 1.0 + s * (2.39357e-3 - 3.13530e-5 * t + 2.52477e-7 * t * t);
  water.second_ghz *= 1.0 + s * (-1.99723e-2 + 1.81176e-4 * t);
  return water;
}

}  // namespace

double WaterPermittivity::ionic_conductivity_s_per_m() const {
  const double t = temperature_c;
  const double s = salinity_g_per_kg;
  const double at_35 = 2.903602 + t * (8.607e-2 + t * (4.738817e-4 + t * (-2.991e-6 + t * 4.3047e-9)));
  const double at_15_degrees = s * (37.5109 + s * (5.45216 + s * 1.4409e-2)) / (1004.75 + s * (182.283 + s));
  const double alpha_0 = (6.9431 + s * (3.2841 - s * 9.9486e-2)) / (84.850 + s * (69.024 + s));
  const double alpha_1 = 49.843 + s * (-0.2276 + s * 0.198e-2);
  return at_35 * at_15_degrees * (1.0 + alpha_0 * (t - 15.0) / (alpha_1 + t));
}

std::complex<double> WaterPermittivity::relative_at(double frequency_hz) const {
  const double f_ghz = frequency_hz / 1e9;
  const Relaxations water = salted(pure_water(temperature_c), temperature_c, salinity_g_per_kg);
  // The Recommendation rounds 1/(2π ε₀ · 1 GHz) to 18.
  return water.at(f_ghz) - std::complex<double>(0.0, 18.0 * ionic_conductivity_s_per_m() / f_ghz);
}

}  // namespace sigmascape::scatter
