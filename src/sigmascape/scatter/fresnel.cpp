#include "sigmascape/scatter/fresnel.h"

namespace sigmascape::scatter {

FresnelCoefficients fresnel(std::complex<float> permittivity, float cos_incidence) {
  const Amplitude epsilon{permittivity.real(), permittivity.imag()}, cosine{cos_incidence, 0.0F};
  const Amplitude q = refracted_cosine(epsilon, cos_incidence), dense = epsilon * cos_incidence;
  return {ratio_of(cosine - q, cosine + q), ratio_of(dense - q, dense + q)};
}

float mean_reflectivity(std::complex<float> permittivity) {
  // Midpoints in √μ, which crowd where a good conductor has its pseudo-Brewster angle.
  constexpr int steps = 512;
  float sum = 0.0F;
  for (int i = 0; i < steps; ++i) {
    const float root = (static_cast<float>(i) + 0.5F) / steps;
    const auto [s, p] = fresnel(permittivity, root * root);
    sum += (power_of(s) + power_of(p)) * 2.0F * root * root * root / steps;
  }
  return sum;
}

}  // namespace sigmascape::scatter
