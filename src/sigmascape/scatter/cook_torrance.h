#pragma once

#include <optional>

#include "sigmascape/scatter/diffuse.h"
#include "sigmascape/scatter/facet.h"
#include "sigmascape/scatter/mirrors.h"
#include "sigmascape/scatter/multiple_scatter.h"
#include "sigmascape/scatter/surface_sample.h"

namespace sigmascape::scatter {

/// How much of the physics of a facet surface is taken along: see CookTorranceParameters.
struct CookTorranceOptions {
  Masking masking = Masking::Correlated;
  bool multiple_scatter = false;
};

/// A rough surface as a mosaic of small Fresnel mirrors [Cook and Torrance 1982, with the energy-correct constant].
///
///     b = |R|² D(h) G2 / (4 cos θi cos θo),   h the half vector          docs/physics/cook_torrance.md, Eq. (1)
///
/// In backscatter this is σ0 = π D |R(0)|² G1, Kirchhoff's geometric optics for Beckmann. A flat face of area A widens
/// the lobe by diffraction, α² + λ²/(4πA), so that it peaks as high as the plate of physical optics; past faces that
/// are small against the wave part of the power goes by. With a scattering coefficient S the lobe keeps 1 − S² of the
/// power and S² leaves diffusely [Degli-Esposti et al. 2007]; Eqs. (13), (14).
class CookTorrance {
 public:
  /// With the masking and multiple scattering that the parameters state.
  CookTorrance(const CookTorranceParameters& parameters, double frequency_hz)
      : CookTorrance(parameters, frequency_hz, {parameters.masking, parameters.multiple_scatter}) {}
  /// With those of `options` instead.
  CookTorrance(const CookTorranceParameters& parameters, double frequency_hz, const CookTorranceOptions& options);

  [[nodiscard]] radar::Channels backscatter(Vec3f to_radar, const Facet& face) const;
  [[nodiscard]] DirectionSample sample(Vec3f to_source, const Facet& face, Vec2f u) const;
  [[nodiscard]] float pdf(Vec3f to_source, Vec3f to_sink, const Facet& face) const;
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, const Facet& face,
                                  PhaseDraw draw) const {
    return pass_on(in, to_source, to_sink, face, draw).fields;
  }
  [[nodiscard]] Passage pass_on(const FieldPair& in, Vec3f to_source, Vec3f to_sink, const Facet& face,
                                PhaseDraw draw) const;

  /// The mirrors when there is nothing else to the surface and they are Beckmann's with correlated masking; null
  /// otherwise.
  [[nodiscard]] const Mirrors* beckmann_mirrors() const;

  /// Whether `scatter` makes use of its draw: mirrors do not.
  [[nodiscard]] bool draws_phases() const { return scattered_part_ > 0.0F || multiple_scatter_.has_value(); }

 private:
  /// The part of the directions that is drawn diffusely.
  [[nodiscard]] float diffuse_share(float cos_source) const;
  [[nodiscard]] float with_diffuse_part(float mirrored, Vec3f to_source, Vec3f to_sink, Vec3f normal) const;

  Mirrors mirrors_;
  float scattered_part_;  // S²
  DiffusePolarization scattered_polarization_;
  DiffuseAmplitudes scattered_;
  std::optional<MultipleScatter> multiple_scatter_;
};

}  // namespace sigmascape::scatter
