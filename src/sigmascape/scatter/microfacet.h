#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sigmascape/base/elementary.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/scatter/material.h"
#include "sigmascape/scatter/visible_slope.h"

namespace sigmascape::scatter {

/// The statistics of a surface made of small tilted mirrors.
///
/// α is the microfacet width; for Beckmann α² = 2 s² with s the rms slope along one axis.
/// docs/physics/cook_torrance.md.
///
/// All of it is written to be compiled into loops over many waves: without branches but those that the distribution and
/// the masking decide.
class Microfacets {
 public:
  Microfacets(MicrofacetDistribution distribution, float alpha, Masking masking = Masking::Correlated)
      : distribution_(distribution), masking_(masking), alpha_(alpha) {}

  [[nodiscard]] float alpha() const { return alpha_; }
  /// The same kind of surface with another width.
  [[nodiscard]] Microfacets widened(float alpha) const { return {distribution_, alpha, masking_}; }
  /// Whether both are as told.
  [[nodiscard]] bool are(MicrofacetDistribution distribution, Masking masking) const {
    return distribution_ == distribution && masking_ == masking;
  }

  /// Density of facets with the unit normal `facet`, in a frame whose z axis is the mean normal, 1/sr, with ∫ D cos θ
  /// dω = 1.
  ///
  ///     Beckmann  D = exp(−tan²θ/α²) / (π α² cos⁴θ),     GGX  D = 1 / (π α² cos⁴θ (1 + tan²θ/α²)²)
  [[nodiscard]] float density(Vec3f facet) const {
    return facet.z > 0.0F ? density(facet.z, facet.x * facet.x + facet.y * facet.y) : 0.0F;
  }
  /// The same about any mean normal.
  [[nodiscard]] float density(Vec3f facet, Vec3f normal) const {
    const Vec3f across = cross(facet, normal);
    return density(dot(facet, normal), dot(across, across));
  }

  /// Smith's Λ(w): the ratio of hidden to visible projected area of the facets that face w.
  [[nodiscard]] float lambda(float cos_angle) const {
    const float cos2 = cos_angle * cos_angle;
    const float tan2 = (1.0F - cos2) / std::max(cos2, 1e-12F);
    if (distribution_ == MicrofacetDistribution::Ggx) return 0.5F * (std::sqrt(1.0F + alpha_ * alpha_ * tan2) - 1.0F);
    // From 4 on it is less than 1e-9.
    const float a = std::min(1.0F / (alpha_ * std::sqrt(std::max(tan2, 1e-12F))), 4.0F);
    return std::max(0.0F, 0.5F * fast_exp(-a * a) * (std::numbers::inv_sqrtpi_v<float> / a - fast_erfcx(a)));
  }

  /// The part of facets facing w that is seen from w: G1 = 1/(1 + Λ).
  [[nodiscard]] float visible_part(float cos_angle) const { return 1.0F / (1.0F + lambda(cos_angle)); }

  /// The part seen from both directions, in a frame whose z axis is the mean normal; height and azimuth correlated
  /// [Heitz 2014, Eq. 101; van Ginneken 1998]:
  ///
  ///     G2 = 1 / (1 + max(Λi, Λo) + l · min(Λi, Λo)),   l = 4.41 φ / (4.41 φ + 1)
  ///
  /// φ is the azimuth between the two. In backscatter φ = 0 and G2 = G1: what the radar sees, it also lights.
  [[nodiscard]] float visible_part(Vec3f a, Vec3f b) const {
    return visible_part(a, b, {0.0F, 0.0F, 1.0F}, lambda(a.z), lambda(b.z));
  }
  /// The same about any mean normal, with the Λ of both directions.
  [[nodiscard]] float visible_part(Vec3f a, Vec3f b, Vec3f normal, float lambda_a, float lambda_b) const {
    if (masking_ == Masking::HeightCorrelated) return 1.0F / (1.0F + lambda_a + lambda_b);
    if (masking_ == Masking::Separable) return 1.0F / ((1.0F + lambda_a) * (1.0F + lambda_b));
    const float along = dot(a, b) - dot(a, normal) * dot(b, normal);
    const float across = std::abs(dot(cross(a, b), normal));
    // Of a direction along the normal, which has no azimuth, Λ is nothing.
    const float independence = 4.41F * fast_angle(along, std::max(across, 1e-30F));
    return 1.0F /
           (1.0F + std::max(lambda_a, lambda_b) + independence / (independence + 1.0F) * std::min(lambda_a, lambda_b));
  }

  /// The same there and back along one direction.
  [[nodiscard]] float visible_part_in_backscatter(float cos_angle) const {
    const float lambda_there = lambda(cos_angle);
    if (masking_ == Masking::HeightCorrelated) return 1.0F / (1.0F + 2.0F * lambda_there);
    if (masking_ == Masking::Separable) return 1.0F / ((1.0F + lambda_there) * (1.0F + lambda_there));
    return 1.0F / (1.0F + lambda_there);
  }

  /// A facet normal with the density of those that `w` sees: G1(w) D(m) (w·m) / cos(w), in a frame whose z axis is the
  /// mean normal. `u` in [0,1)².
  [[nodiscard]] Vec3f visible_normal(Vec3f w, Vec2f u) const { return visible_normal(w, {0.0F, 0.0F, 1.0F}, u); }
  /// The same about any mean normal.
  [[nodiscard]] Vec3f visible_normal(Vec3f w, Vec3f normal, Vec2f u) const {
    const float cos_angle = dot(w, normal);
    const Vec3f sideways = w - normal * cos_angle;
    const float sin_angle = length(sideways);
    // A view from straight above has no azimuth, and none is needed; `sideways` is then what rounding leaves, which may
    // well point along the normal.
    const bool is_oblique = sin_angle > least_oblique_sine;
    const Vec3f any = Basis(normal).tangent, view = sideways * (1.0F / std::max(sin_angle, least_oblique_sine));
    const Vec3f ahead{is_oblique ? view.x : any.x, is_oblique ? view.y : any.y, is_oblique ? view.z : any.z};
    const Vec3f aside = cross(normal, ahead);
    const Vec3f facet = distribution_ == MicrofacetDistribution::Beckmann
                            ? beckmann_visible_facet(cos_angle / (alpha_ * std::max(sin_angle, 1e-7F)), u)
                            : ggx_visible_facet(alpha_ * sin_angle, cos_angle, u);
    return normalized(ahead * (alpha_ * facet.x) + aside * (alpha_ * facet.y) + normal * std::max(facet.z, 1e-7F));
  }

 private:
  /// The root of what single precision resolves. From here on rounding turns the view by less than a thousandth, and
  /// below it slopes are drawn as far astray by an azimuth that is not the view's.
  static constexpr float least_oblique_sine = 3e-4F;

  /// By the cosine of the tilt and the square of its sine, which is not 1 − cos²: for the narrow lobes of smooth
  /// surfaces that is nothing but rounding.
  [[nodiscard]] float density(float cosine, float sine2) const {
    // On edge there would be 0/0.
    const float cos2 = std::max(cosine * cosine, 1e-12F), alpha2 = alpha_ * alpha_;
    const float tan2_over_alpha2 = sine2 / (cos2 * alpha2);
    const float scale = std::numbers::inv_pi_v<float> / (alpha2 * cos2 * cos2);
    if (distribution_ == MicrofacetDistribution::Beckmann) return scale * fast_exp(-tan2_over_alpha2);
    return scale / ((1.0F + tan2_over_alpha2) * (1.0F + tan2_over_alpha2));
  }

  MicrofacetDistribution distribution_;
  Masking masking_;
  float alpha_;
};

}  // namespace sigmascape::scatter
