#include "sigmascape/scatter/lanes.h"
#include "sigmascape/scatter/surface_model.h"
#include "sigmascape/scatter/vector_models.h"

namespace sigmascape::scatter {
namespace {

template <typename Model>
Passage passage(const Model& model, const FieldPair& in, Vec3f to_source, Vec3f to_sink, const Facet& face,
                PhaseDraw draw) {
  return {model.scatter(in, to_source, to_sink, face, draw), model.pdf(to_source, to_sink, face),
          model.pdf(to_sink, to_source, face)};
}

Passage passage(const CookTorrance& model, const FieldPair& in, Vec3f to_source, Vec3f to_sink, const Facet& face,
                PhaseDraw draw) {
  return model.pass_on(in, to_source, to_sink, face, draw);
}

template <typename Model>
void backscatter_lanes(const Model& model, const ArrivalLanes& at, ChannelLanes& out) {
  for (std::size_t i = 0; i < at.count; ++i) out.set(i, model.backscatter(at.to_source[i], at.face(i)));
}

template <typename Model>
void sample_lanes(const Model& model, const ArrivalLanes& at, const PairLanes& u, VectorLanes& to_sink) {
  for (std::size_t i = 0; i < at.count; ++i) to_sink.set(i, model.sample(at.to_source[i], at.face(i), u[i]).direction);
}

template <typename Model>
void pass_on_lanes(const Model& model, const FieldPairLanes& in, const ArrivalLanes& at, const VectorLanes& to_sink,
                   const PairLanes& draw, PassageLanes& out) {
  for (std::size_t i = 0; i < at.count; ++i) {
    out.set(i, passage(model, in[i], at.to_source[i], to_sink[i], at.face(i), {draw.x[i], draw.y[i]}));
  }
}

void backscatter_lanes(const CookTorrance& model, const ArrivalLanes& at, ChannelLanes& out) {
  if (const Mirrors* mirrors = model.beckmann_mirrors())
    backscatter_all(*mirrors, at, out);
  else
    backscatter_lanes<CookTorrance>(model, at, out);
}

void sample_lanes(const CookTorrance& model, const ArrivalLanes& at, const PairLanes& u, VectorLanes& to_sink) {
  if (const Mirrors* mirrors = model.beckmann_mirrors())
    sample_all(*mirrors, at, u, to_sink);
  else
    sample_lanes<CookTorrance>(model, at, u, to_sink);
}

void pass_on_lanes(const CookTorrance& model, const FieldPairLanes& in, const ArrivalLanes& at,
                   const VectorLanes& to_sink, const PairLanes& draw, PassageLanes& out) {
  if (const Mirrors* mirrors = model.beckmann_mirrors())
    pass_on_all(*mirrors, in, at, to_sink, out);
  else
    pass_on_lanes<CookTorrance>(model, in, at, to_sink, draw, out);
}

void backscatter_lanes(const ConstantGamma& model, const ArrivalLanes& at, ChannelLanes& out) {
  backscatter_all(model, at, out);
}
void sample_lanes(const ConstantGamma& model, const ArrivalLanes& at, const PairLanes& u, VectorLanes& to_sink) {
  sample_all(model, at, u, to_sink);
}
void pass_on_lanes(const ConstantGamma& model, const FieldPairLanes& in, const ArrivalLanes& at,
                   const VectorLanes& to_sink, const PairLanes& draw, PassageLanes& out) {
  pass_on_all(model, in, at, to_sink, draw, out);
}

void backscatter_lanes(const Lambert& model, const ArrivalLanes& at, ChannelLanes& out) {
  backscatter_all(model, at, out);
}
void sample_lanes(const Lambert& model, const ArrivalLanes& at, const PairLanes& u, VectorLanes& to_sink) {
  sample_all(model, at, u, to_sink);
}
void pass_on_lanes(const Lambert& model, const FieldPairLanes& in, const ArrivalLanes& at, const VectorLanes& to_sink,
                   const PairLanes& draw, PassageLanes& out) {
  pass_on_all(model, in, at, to_sink, draw, out);
}

}  // namespace

Passage SurfaceModel::pass_on(const FieldPair& in, Vec3f to_source, Vec3f to_sink, const Facet& face,
                              PhaseDraw draw) const {
  return std::visit([&](const auto& m) { return passage(m, in, to_source, to_sink, face, draw); }, model_);
}

void SurfaceModel::backscatter(const ArrivalLanes& at, ChannelLanes& out) const {
  std::visit([&](const auto& m) { backscatter_lanes(m, at, out); }, model_);
}

void SurfaceModel::sample(const ArrivalLanes& at, const PairLanes& u, VectorLanes& to_sink) const {
  std::visit([&](const auto& m) { sample_lanes(m, at, u, to_sink); }, model_);
}

void SurfaceModel::pass_on(const FieldPairLanes& in, const ArrivalLanes& at, const VectorLanes& to_sink,
                           const PairLanes& draw, PassageLanes& out) const {
  std::visit([&](const auto& m) { pass_on_lanes(m, in, at, to_sink, draw, out); }, model_);
}

bool SurfaceModel::draws_phases() const {
  const auto* mirrors = std::get_if<CookTorrance>(&model_);
  return mirrors == nullptr || mirrors->draws_phases();
}

}  // namespace sigmascape::scatter
