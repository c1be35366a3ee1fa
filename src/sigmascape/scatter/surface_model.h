#pragma once

#include <variant>

#include "sigmascape/scatter/constant_gamma.h"
#include "sigmascape/scatter/cook_torrance.h"
#include "sigmascape/scatter/crown_medium.h"
#include "sigmascape/scatter/facet.h"
#include "sigmascape/scatter/lambert.h"
#include "sigmascape/scatter/lanes.h"
#include "sigmascape/scatter/material.h"
#include "sigmascape/scatter/reciprocal_backscatter.h"

namespace sigmascape::scatter {

/// A material at one frequency, ready to scatter. All directions are unit vectors that point away from the surface, and
/// the face's normal is the one on their side.
///
/// A new model is a class with the four members below, a parameter struct in material.h, and its place in the variant.
/// One of which only backscatter is known is a function that makes a ReciprocalBackscatter.
class SurfaceModel {
 public:
  /// Throws Error when the material is not known at that frequency, or when its constants would return more power than
  /// arrives.
  SurfaceModel(const Material& material, double frequency_hz);

  /// BRDF towards where the wave came from, by polarization, 1/sr: exact second moments, nothing drawn.
  [[nodiscard]] radar::Channels backscatter(Vec3f to_radar, const Facet& face) const {
    return std::visit([&](const auto& m) { return m.backscatter(to_radar, face); }, model_);
  }
  /// A direction to carry the path on. `u` in [0,1)².
  [[nodiscard]] DirectionSample sample(Vec3f to_source, const Facet& face, Vec2f u) const {
    return std::visit([&](const auto& m) { return m.sample(to_source, face, u); }, model_);
  }
  /// Density of `sample`, 1/sr.
  [[nodiscard]] float pdf(Vec3f to_source, Vec3f to_sink, const Facet& face) const {
    return std::visit([&](const auto& m) { return m.pdf(to_source, to_sink, face); }, model_);
  }
  /// The fields that leave towards `to_sink`: their powers are the incoming ones times the BRDF, in expectation over
  /// `draw`. For the way back (directions exchanged) the matrix is the transpose.
  [[nodiscard]] FieldPair scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, const Facet& face,
                                  PhaseDraw draw) const {
    return std::visit([&](const auto& m) { return m.scatter(in, to_source, to_sink, face, draw); }, model_);
  }
  /// Scatter and both densities together, which share most of their work.
  [[nodiscard]] Passage pass_on(const FieldPair& in, Vec3f to_source, Vec3f to_sink, const Facet& face,
                                PhaseDraw draw) const;

  /// The same questions, sixteen at a time. Each lane has the answer, to the bit, that it has by itself; lanes that are
  /// not needed may hold any face and direction.
  void backscatter(const ArrivalLanes& at, ChannelLanes& out) const;
  /// Directions alone, without their densities.
  void sample(const ArrivalLanes& at, const PairLanes& u, VectorLanes& to_sink) const;
  void pass_on(const FieldPairLanes& in, const ArrivalLanes& at, const VectorLanes& to_sink, const PairLanes& draw,
               PassageLanes& out) const;

  /// Whether `scatter` makes use of its draw.
  [[nodiscard]] bool draws_phases() const;
  /// Whether unresolved roughness gives what it scatters a phase that nothing tells: of all diffuse surfaces. Mirrors
  /// keep the phase of their place, and their diffuse part draws its own in `scatter`.
  [[nodiscard]] bool phase_is_random() const { return !std::holds_alternative<CookTorrance>(model_); }
  /// The medium when the material is that of a crown, else null.
  [[nodiscard]] const CrownMedium* medium() const { return std::get_if<CrownMedium>(&model_); }

 private:
  using Model = std::variant<Lambert, ConstantGamma, CookTorrance, ReciprocalBackscatter, CrownMedium>;
  static Model model_of(const Material& material, double frequency_hz);
  Model model_;
};

}  // namespace sigmascape::scatter
