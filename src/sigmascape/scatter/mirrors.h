#pragma once

#include <algorithm>
#include <cmath>
#include <complex>

#include "sigmascape/radar/channels.h"
#include "sigmascape/scatter/facet.h"
#include "sigmascape/scatter/fresnel.h"
#include "sigmascape/scatter/microfacet.h"
#include "sigmascape/scatter/surface_sample.h"

namespace sigmascape::scatter {

/// A mosaic of small Fresnel mirrors and nothing else: the lobe of CookTorrance. Written, like Microfacets, to be
/// compiled into loops over many waves.
class Mirrors {
 public:
  /// `diffraction_m2` is λ²/4π.
  Mirrors(const Microfacets& facets, std::complex<float> permittivity, float diffraction_m2)
      : facets_(facets),
        permittivity_{permittivity.real(), permittivity.imag()},
        normal_reflectivity_(power_of(fresnel(permittivity, 1.0F).s)),
        diffraction_m2_(diffraction_m2) {}

  [[nodiscard]] const Microfacets& facets() const { return facets_; }
  [[nodiscard]] std::complex<float> permittivity() const { return {permittivity_.re, permittivity_.im}; }
  /// The same mirrors with other facets.
  [[nodiscard]] Mirrors with(const Microfacets& facets) const {
    Mirrors others = *this;
    others.facets_ = facets;
    return others;
  }

  /// docs/physics/cook_torrance.md, Eq. (1), where both directions are one. The facets that answer are seen head-on:
  /// both polarizations alike and no cross-polarization, whatever the tilt.
  [[nodiscard]] radar::Channels backscatter(Vec3f to_radar, const Facet& face) const {
    const auto [facets, met] = diffracted(face);
    const float cosine = dot(to_radar, face.normal);
    const float brdf = met * normal_reflectivity_ * facets.density(to_radar, face.normal) *
                       facets.visible_part_in_backscatter(cosine) / (4.0F * cosine * cosine);
    return {brdf, brdf, 0.0F, brdf};
  }

  /// A direction with the density that `pass_on` tells.
  [[nodiscard]] Vec3f sample(Vec3f to_source, const Facet& face, Vec2f u) const {
    const Vec3f facet = diffracted(face).facets.visible_normal(to_source, face.normal, u);
    return normalized(facet * (2.0F * dot(to_source, facet)) - to_source);
  }

  [[nodiscard]] float pdf(Vec3f to_source, Vec3f to_sink, const Facet& face) const {
    const Microfacets facets = diffracted(face).facets;
    const float cosine = dot(to_source, face.normal);
    const bool is_seen = cosine > 0.0F && dot(to_sink, face.normal) > 0.0F;
    const float density = facets.density(normalized(to_source + to_sink), face.normal);
    return is_seen ? facets.visible_part(cosine) * density / (4.0F * cosine) : 0.0F;
  }

  [[nodiscard]] Passage pass_on(const FieldPair& in, Vec3f to_source, Vec3f to_sink, const Facet& face) const {
    const auto [facets, met] = diffracted(face);
    const Vec3f half = normalized(to_source + to_sink);
    const float cos_source = dot(to_source, face.normal), cos_sink = dot(to_sink, face.normal);
    const float lambda_source = facets.lambda(cos_source), lambda_sink = facets.lambda(cos_sink);
    const float density = facets.density(half, face.normal);
    const float visible = facets.visible_part(to_source, to_sink, face.normal, lambda_source, lambda_sink);
    const bool is_seen = cos_source > 0.0F && cos_sink > 0.0F;
    const float brdf = met * density * visible / (4.0F * cos_source * cos_sink);
    return {reflected(in, permittivity(), -to_source, to_sink, half) * std::sqrt(is_seen ? brdf : 0.0F),
            is_seen ? density / ((1.0F + lambda_source) * (4.0F * cos_source)) : 0.0F,
            is_seen ? density / ((1.0F + lambda_sink) * (4.0F * cos_sink)) : 0.0F};
  }

 private:
  /// What diffraction makes of a face.
  struct Diffracted {
    Microfacets facets;
    float met;  ///< the part of the power falling on the face that meets the facets; the rest passes by
  };
  /// docs/physics/cook_torrance.md, Eq. (13).
  [[nodiscard]] Diffracted diffracted(const Facet& face) const {
    const float alpha2 = facets_.alpha() * facets_.alpha();
    const float unbounded = alpha2 + diffraction_m2_ * face.inverse_area_per_m2;
    const float bounded = std::min(unbounded, std::max(alpha2, widest_by_diffraction));
    return {facets_.widened(std::sqrt(bounded)), bounded / unbounded};
  }

  /// α² from which on Beckmann's lobe would no longer be strongest along the normal.
  static constexpr float widest_by_diffraction = 0.5F;

  Microfacets facets_;
  Amplitude permittivity_;
  float normal_reflectivity_;  // |R(0)|²
  float diffraction_m2_;
};

}  // namespace sigmascape::scatter
