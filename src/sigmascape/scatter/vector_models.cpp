#include "sigmascape/scatter/vector_models.h"

#include "sigmascape/base/vector_targets.h"

namespace sigmascape::scatter {
namespace {

/// Says the distribution and the masking again as constants, so that the loops have no choices in them.
Mirrors as_beckmann(const Mirrors& mirrors) {
  return mirrors.with({MicrofacetDistribution::Beckmann, mirrors.facets().alpha(), Masking::Correlated});
}

template <typename Diffuse>
Passage passed_on(const Diffuse& ground, const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                  PhaseDraw draw) {
  return {ground.scatter(in, to_source, to_sink, normal, draw), cosine_pdf(to_sink, normal),
          cosine_pdf(to_source, normal)};
}

}  // namespace

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void backscatter_all(const Mirrors& mirrors, const ArrivalLanes& at,
                                                                ChannelLanes& out) {
  const Mirrors beckmann = as_beckmann(mirrors);
  for (std::size_t i = 0; i < lane_count; ++i) out.set(i, beckmann.backscatter(at.to_source[i], at.face(i)));
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void sample_all(const Mirrors& mirrors, const ArrivalLanes& at,
                                                           const PairLanes& u, VectorLanes& to_sink) {
  const Mirrors beckmann = as_beckmann(mirrors);
  for (std::size_t i = 0; i < lane_count; ++i) to_sink.set(i, beckmann.sample(at.to_source[i], at.face(i), u[i]));
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void pass_on_all(const Mirrors& mirrors, const FieldPairLanes& in,
                                                            const ArrivalLanes& at, const VectorLanes& to_sink,
                                                            PassageLanes& out) {
  const Mirrors beckmann = as_beckmann(mirrors);
  for (std::size_t i = 0; i < lane_count; ++i)
    out.set(i, beckmann.pass_on(in[i], at.to_source[i], to_sink[i], at.face(i)));
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void backscatter_all(const ConstantGamma& ground, const ArrivalLanes& at,
                                                                ChannelLanes& out) {
  for (std::size_t i = 0; i < lane_count; ++i) out.set(i, ground.backscatter(at.to_source[i], at.normal[i]));
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void sample_all(const ConstantGamma& ground, const ArrivalLanes& at,
                                                           const PairLanes& u, VectorLanes& to_sink) {
  for (std::size_t i = 0; i < lane_count; ++i)
    to_sink.set(i, ground.sample(at.to_source[i], at.normal[i], u[i]).direction);
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void pass_on_all(const ConstantGamma& ground, const FieldPairLanes& in,
                                                            const ArrivalLanes& at, const VectorLanes& to_sink,
                                                            const PairLanes& draw, PassageLanes& out) {
  for (std::size_t i = 0; i < lane_count; ++i)
    out.set(i, passed_on(ground, in[i], at.to_source[i], to_sink[i], at.normal[i], {draw.x[i], draw.y[i]}));
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void backscatter_all(const Lambert& ground, const ArrivalLanes& at,
                                                                ChannelLanes& out) {
  for (std::size_t i = 0; i < lane_count; ++i) out.set(i, ground.backscatter(at.to_source[i], at.normal[i]));
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void sample_all(const Lambert& ground, const ArrivalLanes& at,
                                                           const PairLanes& u, VectorLanes& to_sink) {
  for (std::size_t i = 0; i < lane_count; ++i)
    to_sink.set(i, ground.sample(at.to_source[i], at.normal[i], u[i]).direction);
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void pass_on_all(const Lambert& ground, const FieldPairLanes& in,
                                                            const ArrivalLanes& at, const VectorLanes& to_sink,
                                                            const PairLanes& draw, PassageLanes& out) {
  for (std::size_t i = 0; i < lane_count; ++i)
    out.set(i, passed_on(ground, in[i], at.to_source[i], to_sink[i], at.normal[i], {draw.x[i], draw.y[i]}));
}

}  // namespace sigmascape::scatter
