#include "sigmascape/scatter/permittivity.h"

#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::scatter {

std::complex<double> Permittivity::relative_at(double frequency_hz) const {
  const double f_ghz = frequency_hz / 1e9;
  const double relative = a * std::pow(f_ghz, b);
  const double conductivity_s_per_m = c * std::pow(f_ghz, d);
  return {relative, -conductivity_s_per_m / (2.0 * pi * frequency_hz * vacuum_permittivity_f_per_m)};
}

}  // namespace sigmascape::scatter
