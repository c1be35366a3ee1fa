#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sigmascape/base/elementary.h"
#include "sigmascape/scatter/material.h"
#include "sigmascape/scatter/surface_sample.h"

namespace sigmascape::scatter {

/// Roots of a surface's BRDF by polarization, 1/√sr.
struct DiffuseAmplitudes {
  float vv = 0.0F;
  float hh = 0.0F;
  float hv = 0.0F;
};

/// What all diffuse models share: how their powers b_VV, b_HH and b_HV become a random scattering matrix.
///
/// A diffuse surface answers with a random scattering matrix of which only the covariance is known. Its draw keeps the
/// magnitudes and randomises the phases, so that ⟨|S_VV|²⟩ = b_VV, ⟨|S_HH|²⟩ = b_HH, ⟨|S_HV|²⟩ = b_HV, ⟨S_VV S_HH*⟩ = ρ
/// √(b_VV b_HH) and ⟨S_VV S_HV*⟩ = ⟨S_HH S_HV*⟩ = 0 hold exactly with the least variance. docs/physics/diffuse.md, Eqs.
/// (1), (2).
///
/// V and H are those of the antennas: what tables were measured with, over ground that is level on average.
class DiffusePolarization {
 public:
  explicit DiffusePolarization(const Depolarization& depolarization);

  /// Both co-polarized powers alike and the cross-polarized one the stated ratio of them.
  [[nodiscard]] DiffuseAmplitudes amplitudes(float co_polarized_brdf) const {
    const float co = std::sqrt(co_polarized_brdf);
    return {co, co, cross_amplitude_ * co};
  }

  [[nodiscard]] radar::Channels backscatter(const DiffuseAmplitudes& surface) const {
    return {surface.vv * surface.vv, surface.hh * surface.hh, surface.hv * surface.hv,
            correlation_ * surface.vv * surface.hh};
  }

  [[nodiscard]] FieldPair scatter(const FieldPair& in, const DiffuseAmplitudes& surface, Vec3f to_source, Vec3f to_sink,
                                  PhaseDraw draw) const {
    const PolarizationBasis before(-to_source);
    const PolarizationBasis after(to_sink);
    const Amplitude hh = Amplitude{correlation_, draw.a < 0.5F ? quadrature_ : -quadrature_} * surface.hh;
    const Vec2f phasor = fast_phasor(draw.b);
    const Amplitude hv = Amplitude{phasor.x, phasor.y} * surface.hv;
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

 private:
  float cross_amplitude_;  // √x
  float correlation_;      // ρ, the cosine of the phase ±φ drawn between HH and VV
  float quadrature_;       // sin φ
};

/// Directions with density cos θ / π about the normal.
[[nodiscard]] inline DirectionSample cosine_direction(Vec3f normal, Vec2f u) {
  const float radius = std::sqrt(u.x);
  const Vec2f phasor = fast_phasor(u.y);
  const float z = std::sqrt(std::max(0.0F, 1.0F - u.x));
  const Vec3f direction = Basis(normal).world_from_local({radius * phasor.x, radius * phasor.y, z});
  return {direction, z * std::numbers::inv_pi_v<float>};
}

[[nodiscard]] inline float cosine_pdf(Vec3f direction, Vec3f normal) {
  return std::max(0.0F, dot(direction, normal)) * std::numbers::inv_pi_v<float>;
}

}  // namespace sigmascape::scatter
