#include "sigmascape/scatter/vegetation_permittivity.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::scatter {

std::complex<double> VegetationPermittivity::relative_at(double frequency_hz) const {
  using Complex = std::complex<double>;
  const double f_ghz = frequency_hz / 1e9;
  const double m = gravimetric_moisture;
  const double conductivity_s_per_m = salinity_g_per_kg * (0.17 - 0.0013 * salinity_g_per_kg);
  const Complex free_water =
      4.9 + 74.4 / Complex(1.0, f_ghz / 18.0) - Complex(0.0, 18.0 * conductivity_s_per_m / f_ghz);
  const Complex bound_water = 2.9 + 55.0 / (1.0 + std::sqrt(Complex(0.0, f_ghz / 0.18)));

  const double dry = 1.7 - 0.74 * m + 6.16 * m * m;
  // The fit of the free water's volume turns negative below a moisture of 0.14, where all water is bound.
  const double free_volume = std::max(0.0, m * (0.55 * m - 0.076));
  const double bound_volume = 4.64 * m * m / (1.0 + 7.36 * m * m);
  return dry + free_volume * free_water + bound_volume * bound_water;
}

}  // namespace sigmascape::scatter
