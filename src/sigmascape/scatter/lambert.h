#pragma once

#include "sigmascape/scatter/diffuse.h"

namespace sigmascape::scatter {

/// The surface that is equally bright from everywhere: b = ρ/π over all polarizations.
///
///     σ0_VV + σ0_HV = 4 ρ sin² ψ                                   docs/physics/lambert.md, Eq. (2)
class Lambert {
 public:
  explicit Lambert(const LambertParameters& parameters);

  [[nodiscard]] radar::Channels backscatter(Vec3f to_radar, Vec3f normal) const;
  [[nodiscard]] DirectionSample sample(Vec3f to_source, Vec3f normal, Vec2f u) const;
  [[nodiscard]] float pdf(Vec3f to_source, Vec3f to_sink, Vec3f normal) const;
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                                  PhaseDraw draw) const;

 private:
  DiffusePolarization polarization_;
  DiffuseAmplitudes amplitudes_;
};

}  // namespace sigmascape::scatter
