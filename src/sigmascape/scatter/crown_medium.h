#pragma once

#include <complex>
#include <optional>

#include "sigmascape/scatter/diffuse.h"
#include "sigmascape/scatter/facet.h"
#include "sigmascape/scatter/material.h"
#include "sigmascape/scatter/surface_sample.h"

namespace sigmascape::scatter {

/// The leaves of a tree crown as a homogeneous medium: small scatterers spread evenly and turned every way.
///
/// What it intercepts is κ a metre, of which the albedo ω leaves again. Leaves that are stated as mirrors send it
/// evenly in all directions, each by the Fresnel matrix F of the mirror that lies between two directions; others are
/// isotropic with a random matrix:
///
///     S = F(half angle) / √4π,   or   ⟨|S_pq|²⟩ = ω/4π · (1 or x) / (1 + x)        docs/physics/vegetation.md, Eqs.
///     (4), (5)
///
/// It has the members of a surface, for a tracer of paths; normals mean nothing to it, and cosines at its vertices are
/// one.
class CrownMedium {
 public:
  CrownMedium(const CrownParameters& parameters, double frequency_hz);

  /// κ, 1/m, of power and for all polarizations alike.
  [[nodiscard]] float extinction_per_m() const { return extinction_per_m_; }
  [[nodiscard]] bool shares_gaps() const { return shares_gaps_; }
  /// ω, the mean over directions and polarizations.
  [[nodiscard]] float albedo() const { return albedo_; }

  [[nodiscard]] radar::Channels backscatter(Vec3f to_radar, Vec3f normal) const;
  [[nodiscard]] DirectionSample sample(Vec3f to_source, Vec3f normal, Vec2f u) const;
  [[nodiscard]] float pdf(Vec3f to_source, Vec3f to_sink, Vec3f normal) const;
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                                  PhaseDraw draw) const;

 private:
  float extinction_per_m_;
  bool shares_gaps_;
  float albedo_;
  std::optional<std::complex<float>> mirrors_;  // their permittivity
  DiffusePolarization polarization_;
  DiffuseAmplitudes amplitudes_;
};

}  // namespace sigmascape::scatter
