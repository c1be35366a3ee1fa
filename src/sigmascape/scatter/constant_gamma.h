#pragma once

#include "sigmascape/scatter/diffuse.h"

namespace sigmascape::scatter {

/// Natural ground whose reflectivity over illuminated area, γ, does not depend on the angle: σ0 = γ sin ψ in
/// co-polarization.
///
/// Away from backscatter it is the Lommel–Seeliger law, which is reciprocal, bounded and has this backscatter exactly:
///
///     b = γ / (2π (cos θi + cos θo))                               docs/physics/constant_gamma.md, Eq. (2)
///
/// It is passive for γ (1 + x) ≤ 1, x the cross-polarization ratio.
class ConstantGamma {
 public:
  ConstantGamma(const ConstantGammaParameters& parameters, double frequency_hz);

  [[nodiscard]] radar::Channels backscatter(Vec3f to_radar, Vec3f normal) const {
    const float cos_angle = dot(to_radar, normal);
    return polarization_.backscatter(polarization_.amplitudes(brdf(cos_angle, cos_angle)));
  }
  [[nodiscard]] DirectionSample sample(Vec3f, Vec3f normal, Vec2f u) const { return cosine_direction(normal, u); }
  [[nodiscard]] float pdf(Vec3f, Vec3f to_sink, Vec3f normal) const { return cosine_pdf(to_sink, normal); }
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                                  PhaseDraw draw) const {
    const float co_polarized = brdf(dot(to_source, normal), dot(to_sink, normal));
    return polarization_.scatter(in, polarization_.amplitudes(co_polarized), to_source, to_sink, draw);
  }

 private:
  [[nodiscard]] float brdf(float cos_source, float cos_sink) const {
    return gamma_over_two_pi_ / (cos_source + cos_sink);
  }

  float gamma_over_two_pi_;
  DiffusePolarization polarization_;
};

/// γ at a frequency, linear: as stated, or by the law that the parameters name.
[[nodiscard]] double gamma_at(const ConstantGammaParameters& parameters, double frequency_hz);

/// The part of arriving power that Lommel–Seeliger ground sends out again in co-polarization:
///
///     A(μ) = γ (1 − μ ln((1 + μ)/μ)),   μ = cos θ                  docs/physics/constant_gamma.md, Eq. (3)
[[nodiscard]] double constant_gamma_albedo(double gamma, double cos_incidence);

}  // namespace sigmascape::scatter
