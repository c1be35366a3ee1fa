#pragma once

#include <complex>
#include <optional>

#include "sigmascape/scatter/microfacet.h"
#include "sigmascape/scatter/multiple_scatter.h"
#include "sigmascape/scatter/surface_sample.h"

namespace sigmascape::scatter {

/// How much of the physics of a facet surface is taken along.
struct CookTorranceOptions {
  Masking masking = Masking::Correlated;
  /// Adds what facets pass on to one another (see multiple_scatter.h). Off by default: it raises single-bounce σ0 above
  /// geometric optics.
  bool multiple_scatter = false;
};

/// A rough surface as a mosaic of small Fresnel mirrors [Cook and Torrance 1982, with the energy-correct constant].
///
///     b = |R|² D(h) G2 / (4 cos θi cos θo),   h the half vector          docs/physics/cook_torrance.md, Eq. (1)
///
/// In backscatter this is σ0 = π D |R(0)|² G1, Kirchhoff's geometric optics for Beckmann.
class CookTorrance {
 public:
  CookTorrance(const CookTorranceParameters& parameters, double frequency_hz, const CookTorranceOptions& options = {});

  [[nodiscard]] radar::Channels backscatter(Vec3f to_radar, Vec3f normal) const;
  [[nodiscard]] DirectionSample sample(Vec3f to_source, Vec3f normal, Vec2f u) const;
  [[nodiscard]] float pdf(Vec3f to_source, Vec3f to_sink, Vec3f normal) const;
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                                  PhaseDraw draw) const;

 private:
  std::complex<float> permittivity_;
  float normal_reflectivity_;  // |R(0)|²
  Microfacets facets_;
  std::optional<MultipleScatter> multiple_scatter_;
};

}  // namespace sigmascape::scatter
