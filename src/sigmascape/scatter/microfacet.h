#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/scatter/material.h"

namespace sigmascape::scatter {

/// The statistics of a surface made of small tilted mirrors, in a frame whose z axis is the mean normal.
///
/// α is the microfacet width; for Beckmann α² = 2 s² with s the rms slope along one axis.
/// docs/physics/cook_torrance.md.
class Microfacets {
 public:
  Microfacets(MicrofacetDistribution distribution, float alpha, Masking masking = Masking::Correlated)
      : distribution_(distribution), masking_(masking), alpha_(alpha) {}

  [[nodiscard]] float alpha() const { return alpha_; }
  /// The same kind of surface with another width.
  [[nodiscard]] Microfacets widened(float alpha) const { return {distribution_, alpha, masking_}; }

  /// Density of facets with the unit normal `facet`, 1/sr, with ∫ D cos θ dω = 1.
  ///
  ///     Beckmann  D = exp(−tan²θ/α²) / (π α² cos⁴θ),     GGX  D = 1 / (π α² cos⁴θ (1 + tan²θ/α²)²)
  [[nodiscard]] float density(Vec3f facet) const;

  /// Smith's Λ(w): the ratio of hidden to visible projected area of the facets that face w.
  [[nodiscard]] float lambda(float cos_angle) const;

  /// The part of facets facing w that is seen from w: G1 = 1/(1 + Λ).
  [[nodiscard]] float visible_part(float cos_angle) const { return 1.0F / (1.0F + lambda(cos_angle)); }

  /// The part seen from both directions, height and azimuth correlated [Heitz 2014, Eq. 101; van Ginneken 1998]:
  ///
  ///     G2 = 1 / (1 + max(Λi, Λo) + l · min(Λi, Λo)),   l = 4.41 φ / (4.41 φ + 1)
  ///
  /// φ is the azimuth between the two. In backscatter φ = 0 and G2 = G1: what the radar sees, it also lights.
  [[nodiscard]] float visible_part(Vec3f a, Vec3f b) const;

  /// A facet normal with the density of those that `w` sees: G1(w) D(m) (w·m) / cos(w). `u` in [0,1)².
  [[nodiscard]] Vec3f visible_normal(Vec3f w, Vec2f u) const;

 private:
  MicrofacetDistribution distribution_;
  Masking masking_;
  float alpha_;
};

}  // namespace sigmascape::scatter
