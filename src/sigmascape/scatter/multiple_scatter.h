#pragma once

#include <array>
#include <complex>

#include "sigmascape/scatter/microfacet.h"
#include "sigmascape/scatter/surface_sample.h"

namespace sigmascape::scatter {

/// What the facets of a rough surface pass on to one another before it leaves: the power that masking takes from single
/// reflection, given back as a diffuse, reciprocal and fully depolarized term [Kulla and Conty 2017].
///
///     f = C (1 − E(μi)) (1 − E(μo)) / (π (1 − E_avg)),   C = F_avg² E_avg / (1 − F_avg (1 − E_avg))
///
/// E(μ) is the directional albedo of the facets as ideal mirrors, E_avg = 2 ∫ E μ dμ and F_avg the mean reflectivity of
/// the material. An ideal conductor then returns all that falls on it. docs/physics/cook_torrance.md, Eqs. (10)–(12).
class MultipleScatter {
 public:
  /// Tabulates E by deterministic quadrature, which takes a tenth of a second or two.
  MultipleScatter(const Microfacets& facets, std::complex<float> permittivity);

  /// E(μ): the part of power arriving at angle acos μ that leaves after one reflection by facets that reflect
  /// everything.
  [[nodiscard]] float single_albedo(float cos_angle) const;
  /// The part of arriving power that this term adds: C (1 − E(μ)).
  [[nodiscard]] float albedo(float cos_angle) const;
  /// The probability with which to draw a direction for this term instead of the mirrors'.
  [[nodiscard]] float sampling_share(float cos_source) const;

  /// f, 1/sr, over both receive polarizations.
  [[nodiscard]] float brdf(float cos_source, float cos_sink) const;
  /// The share of f that each channel gets in backscatter: half in co-, half in cross-polarization, nothing correlated.
  [[nodiscard]] radar::Channels backscatter(float cos_angle) const;
  /// A draw of the scattered fields: all four elements equally strong, uncorrelated with one another and with zero
  /// mean, so that they add to the mirrors' field in power. The matrix of the way back is the transpose for the same
  /// draw.
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                                  PhaseDraw draw) const;

 private:
  static constexpr int intervals = 64;

  std::array<float, intervals + 1> lost_{};  // 1 − E at μ = (i / intervals)²
  float lost_average_ = 0.0F;                // 1 − E_avg
  float mean_reflectivity_;
  float colour_ = 0.0F;  // C
};

}  // namespace sigmascape::scatter
