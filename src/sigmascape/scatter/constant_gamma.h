#pragma once

#include "sigmascape/scatter/diffuse.h"

namespace sigmascape::scatter {

/// Natural ground whose reflectivity over illuminated area, γ, does not depend on the angle: σ0 = γ sin ψ in co-polarization.
///
/// Away from backscatter it is the Lommel–Seeliger law, the one reciprocal and bounded surface that has this backscatter exactly:
///
///     b = γ / (2π (cos θi + cos θo))                               docs/physics/constant_gamma.md, Eq. (2)
///
/// It is passive for γ (1 + x) ≤ 1, x the cross-polarization ratio.
class ConstantGamma {
 public:
  explicit ConstantGamma(const ConstantGammaParameters& parameters);

  [[nodiscard]] radar::Channels backscatter(Vec3f to_radar, Vec3f normal) const;
  [[nodiscard]] DirectionSample sample(Vec3f to_source, Vec3f normal, Vec2f u) const;
  [[nodiscard]] float pdf(Vec3f to_source, Vec3f to_sink, Vec3f normal) const;
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal, PhaseDraw draw) const;

 private:
  [[nodiscard]] float brdf(float cos_source, float cos_sink) const;

  float gamma_over_two_pi_;
  DiffusePolarization polarization_;
};

}  // namespace sigmascape::scatter
