#include "sigmascape/scatter/diffuse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sigmascape::scatter {

DiffusePolarization::DiffusePolarization(const Depolarization& depolarization)
    : cross_amplitude_(static_cast<float>(std::sqrt(depolarization.cross_ratio))),
      correlation_(std::clamp(static_cast<float>(depolarization.vv_hh_correlation), -1.0F, 1.0F)),
      quadrature_(std::sqrt(1.0F - correlation_ * correlation_)) {}

DiffuseAmplitudes DiffusePolarization::amplitudes(float co_polarized_brdf) const {
  const float co = std::sqrt(co_polarized_brdf);
  return {co, co, cross_amplitude_ * co};
}

radar::Channels DiffusePolarization::backscatter(const DiffuseAmplitudes& surface) const {
  return {surface.vv * surface.vv, surface.hh * surface.hh, surface.hv * surface.hv,
          correlation_ * surface.vv * surface.hh};
}

FieldPair DiffusePolarization::scatter(const FieldPair& in, const DiffuseAmplitudes& surface, Vec3f to_source,
                                       Vec3f to_sink, PhaseDraw draw) const {
  const PolarizationBasis before(-to_source);
  const PolarizationBasis after(to_sink);
  const Amplitude hh = Amplitude{correlation_, draw.a < 0.5F ? quadrature_ : -quadrature_} * surface.hh;
  const Amplitude hv = unit_phasor(2.0F * std::numbers::pi_v<float> * draw.b) * surface.hv;
  // h reverses with the direction of travel. Hence, in bases that follow the wave, the matrix that looks like diag(1,
  // 1) to a radar is diag(1, −1), and the two cross terms have opposite signs.
  const auto pass = [&](const Field& e) {
    const Amplitude v_in = e.along(before.v);
    const Amplitude h_in = e.along(before.h);
    const Amplitude v_out = v_in * surface.vv + hv * h_in;
    const Amplitude h_out = (hv * v_in + hh * h_in) * -1.0F;
    return field_along(after.v, v_out) + field_along(after.h, h_out);
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

float cosine_pdf(Vec3f direction, Vec3f normal) {
  return std::max(0.0F, dot(direction, normal)) * std::numbers::inv_pi_v<float>;
}

}  // namespace sigmascape::scatter
