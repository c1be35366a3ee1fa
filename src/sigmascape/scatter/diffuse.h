#pragma once

#include "sigmascape/scatter/material.h"
#include "sigmascape/scatter/surface_sample.h"

namespace sigmascape::scatter {

/// What all diffuse models share: a scalar co-polarized BRDF spread over polarizations by Depolarization.
///
/// A diffuse surface answers with a random scattering matrix of which only the covariance is known. Its draw keeps the magnitudes
/// and randomises the phases, so that ⟨|S_VV|²⟩ = ⟨|S_HH|²⟩ = b, ⟨|S_HV|²⟩ = x b and ⟨S_VV S_HH*⟩ = ρ b hold
/// exactly with the least variance. docs/physics/diffuse.md, Eq. (1).
class DiffusePolarization {
 public:
  explicit DiffusePolarization(const Depolarization& depolarization);

  [[nodiscard]] radar::Channels backscatter(float co_polarized_brdf) const;
  [[nodiscard]] FieldPair scatter(const FieldPair& in, float co_polarized_brdf, Vec3f to_source, Vec3f to_sink, PhaseDraw draw) const;

 private:
  float cross_ratio_;
  float correlation_;
  float cross_amplitude_;  // √x
  float phase_spread_;     // ± this phase between HH and VV has mean cosine ρ
};

/// Directions with density cos θ / π about the normal.
[[nodiscard]] DirectionSample cosine_direction(Vec3f normal, Vec2f u);
[[nodiscard]] float cosine_pdf(Vec3f direction, Vec3f normal);

}  // namespace sigmascape::scatter
