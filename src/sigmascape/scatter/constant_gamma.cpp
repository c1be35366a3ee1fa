#include "sigmascape/scatter/constant_gamma.h"

#include <cmath>
#include <numbers>

namespace sigmascape::scatter {

double gamma_at(const ConstantGammaParameters& parameters, double frequency_hz) {
  switch (parameters.frequency_law) {
    case GammaFrequencyLaw::AsStated:
      return parameters.gamma;
    case GammaFrequencyLaw::SquareRootFrom10Ghz:
      return parameters.gamma * std::sqrt(frequency_hz / 10e9);
  }
  return parameters.gamma;
}

double constant_gamma_albedo(double gamma, double cos_incidence) {
  if (cos_incidence <= 0.0) return gamma;
  return gamma * (1.0 - cos_incidence * std::log1p(1.0 / cos_incidence));
}

ConstantGamma::ConstantGamma(const ConstantGammaParameters& parameters, double frequency_hz)
    : gamma_over_two_pi_(static_cast<float>(gamma_at(parameters, frequency_hz) / (2.0 * std::numbers::pi))),
      polarization_(parameters.depolarization) {}

}  // namespace sigmascape::scatter
