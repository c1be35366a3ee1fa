#pragma once

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
  [[nodiscard]] DiffuseAmplitudes amplitudes(float co_polarized_brdf) const;

  [[nodiscard]] radar::Channels backscatter(const DiffuseAmplitudes& surface) const;
  [[nodiscard]] FieldPair scatter(const FieldPair& in, const DiffuseAmplitudes& surface, Vec3f to_source, Vec3f to_sink,
                                  PhaseDraw draw) const;

 private:
  float cross_amplitude_;  // √x
  float correlation_;      // ρ, the cosine of the phase ±φ drawn between HH and VV
  float quadrature_;       // sin φ
};

/// Directions with density cos θ / π about the normal.
[[nodiscard]] DirectionSample cosine_direction(Vec3f normal, Vec2f u);
[[nodiscard]] float cosine_pdf(Vec3f direction, Vec3f normal);

}  // namespace sigmascape::scatter
