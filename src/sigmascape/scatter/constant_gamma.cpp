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

float ConstantGamma::brdf(float cos_source, float cos_sink) const {
  return gamma_over_two_pi_ / (cos_source + cos_sink);
}

radar::Channels ConstantGamma::backscatter(Vec3f to_radar, Vec3f normal) const {
  const float cos_angle = dot(to_radar, normal);
  return polarization_.backscatter(polarization_.amplitudes(brdf(cos_angle, cos_angle)));
}

DirectionSample ConstantGamma::sample(Vec3f, Vec3f normal, Vec2f u) const {
  return cosine_direction(normal, u);
}

float ConstantGamma::pdf(Vec3f, Vec3f to_sink, Vec3f normal) const {
  return cosine_pdf(to_sink, normal);
}

FieldPair ConstantGamma::scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                                 PhaseDraw draw) const {
  const float co_polarized = brdf(dot(to_source, normal), dot(to_sink, normal));
  return polarization_.scatter(in, polarization_.amplitudes(co_polarized), to_source, to_sink, draw);
}

}  // namespace sigmascape::scatter
