#pragma once

#include "sigmascape/scatter/diffuse.h"

namespace sigmascape::scatter {

/// The surface that is equally bright from everywhere: b = ρ/π over all polarizations.
///
///     σ0_VV + σ0_HV = 4 ρ sin² ψ                                   docs/physics/lambert.md, Eq. (2)
class Lambert {
 public:
  explicit Lambert(const LambertParameters& parameters);

  [[nodiscard]] radar::Channels backscatter(Vec3f, Vec3f) const { return polarization_.backscatter(amplitudes_); }
  [[nodiscard]] DirectionSample sample(Vec3f, Vec3f normal, Vec2f u) const { return cosine_direction(normal, u); }
  [[nodiscard]] float pdf(Vec3f, Vec3f to_sink, Vec3f normal) const { return cosine_pdf(to_sink, normal); }
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f, PhaseDraw draw) const {
    return polarization_.scatter(in, amplitudes_, to_source, to_sink, draw);
  }

 private:
  DiffusePolarization polarization_;
  DiffuseAmplitudes amplitudes_;
};

}  // namespace sigmascape::scatter
