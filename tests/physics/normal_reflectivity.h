#pragma once

#include <complex>

namespace sigmascape::physics_test {

/// |R|² at normal incidence.
inline double normal_reflectivity(std::complex<double> permittivity) {
  const std::complex<double> root = std::sqrt(permittivity);
  return std::norm((1.0 - root) / (1.0 + root));
}

}  // namespace sigmascape::physics_test
