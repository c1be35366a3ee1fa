#include "sigmascape/scatter/diffuse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sigmascape::scatter {

DiffusePolarization::DiffusePolarization(const Depolarization& depolarization)
    : cross_ratio_(static_cast<float>(depolarization.cross_ratio)),
      correlation_(static_cast<float>(depolarization.vv_hh_correlation)),
      cross_amplitude_(std::sqrt(cross_ratio_)),
      phase_spread_(std::acos(std::clamp(correlation_, -1.0F, 1.0F))) {}

radar::Channels DiffusePolarization::backscatter(float co_polarized_brdf) const {
  return {co_polarized_brdf, co_polarized_brdf, cross_ratio_ * co_polarized_brdf, correlation_ * co_polarized_brdf};
}

FieldPair DiffusePolarization::scatter(const FieldPair& in, float co_polarized_brdf, Vec3f to_source, Vec3f to_sink,
                                       PhaseDraw draw) const {
  const PolarizationBasis before(-to_source);
  const PolarizationBasis after(to_sink);
  const Amplitude hh = unit_phasor(draw.a < 0.5F ? phase_spread_ : -phase_spread_);
  const Amplitude x = unit_phasor(2.0F * std::numbers::pi_v<float> * draw.b) * cross_amplitude_;
  const float amplitude = std::sqrt(co_polarized_brdf);
  // h reverses with the direction of travel. Hence, in bases that follow the wave, the matrix that looks like diag(1, 1) to a radar
  // is diag(1, −1), and the two cross terms have opposite signs.
  const auto pass = [&](const Field& e) {
    const Amplitude v_in = e.along(before.v);
    const Amplitude h_in = e.along(before.h);
    const Amplitude v_out = v_in + x * h_in;
    const Amplitude h_out = (x * v_in + hh * h_in) * -1.0F;
    return field_along(after.v, v_out * amplitude) + field_along(after.h, h_out * amplitude);
  };
  return {pass(in.from_v), pass(in.from_h)};
}

DirectionSample cosine_direction(Vec3f normal, Vec2f u) {
  const float radius = std::sqrt(u.x);
  const float phi = 2.0F * std::numbers::pi_v<float> * u.y;
  const float z = std::sqrt(std::max(0.0F, 1.0F - u.x));
  const Vec3f direction = Basis(normal).world_from_local({radius * std::cos(phi), radius * std::sin(phi), z});
  return {direction, z * std::numbers::inv_pi_v<float>};
}

float cosine_pdf(Vec3f direction, Vec3f normal) { return std::max(0.0F, dot(direction, normal)) * std::numbers::inv_pi_v<float>; }

}  // namespace sigmascape::scatter
