#pragma once

#include <complex>

#include "sigmascape/scatter/microfacet.h"
#include "sigmascape/scatter/surface_sample.h"

namespace sigmascape::scatter {

/// A rough surface as a mosaic of small Fresnel mirrors [Cook and Torrance 1982, with the energy-correct constant].
///
///     b = |R|² D(h) G2 / (4 cos θi cos θo),   h the half vector          docs/physics/cook_torrance.md, Eq. (1)
///
/// In backscatter this is σ0 = π D |R(0)|² G1, Kirchhoff's geometric optics for Beckmann.
class CookTorrance {
 public:
  CookTorrance(const CookTorranceParameters& parameters, double frequency_hz);

  [[nodiscard]] radar::Channels backscatter(Vec3f to_radar, Vec3f normal) const;
  [[nodiscard]] DirectionSample sample(Vec3f to_source, Vec3f normal, Vec2f u) const;
  [[nodiscard]] float pdf(Vec3f to_source, Vec3f to_sink, Vec3f normal) const;
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal, PhaseDraw draw) const;

 private:
  std::complex<float> permittivity_;
  float normal_reflectivity_;  // |R(0)|²
  Microfacets facets_;
};

}  // namespace sigmascape::scatter
