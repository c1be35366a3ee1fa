#include "sigmascape/scatter/constant_gamma.h"

#include <numbers>

namespace sigmascape::scatter {

ConstantGamma::ConstantGamma(const ConstantGammaParameters& parameters)
    : gamma_over_two_pi_(static_cast<float>(parameters.gamma / (2.0 * std::numbers::pi))), polarization_(parameters.depolarization) {}

float ConstantGamma::brdf(float cos_source, float cos_sink) const { return gamma_over_two_pi_ / (cos_source + cos_sink); }

radar::Channels ConstantGamma::backscatter(Vec3f to_radar, Vec3f normal) const {
  const float cos_angle = dot(to_radar, normal);
  return polarization_.backscatter(brdf(cos_angle, cos_angle));
}

DirectionSample ConstantGamma::sample(Vec3f, Vec3f normal, Vec2f u) const { return cosine_direction(normal, u); }

float ConstantGamma::pdf(Vec3f, Vec3f to_sink, Vec3f normal) const { return cosine_pdf(to_sink, normal); }

FieldPair ConstantGamma::scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal, PhaseDraw draw) const {
  return polarization_.scatter(in, brdf(dot(to_source, normal), dot(to_sink, normal)), to_source, to_sink, draw);
}

}  // namespace sigmascape::scatter
