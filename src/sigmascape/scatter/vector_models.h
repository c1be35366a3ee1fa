#pragma once

#include "sigmascape/scatter/constant_gamma.h"
#include "sigmascape/scatter/lambert.h"
#include "sigmascape/scatter/lanes.h"
#include "sigmascape/scatter/mirrors.h"

namespace sigmascape::scatter {

/// The models that most of a scene is made of, asked sixteen times at once in vector code: Beckmann's mirrors with
/// correlated masking, and ground of constant γ or albedo. All lanes get an answer, needed or not.
void backscatter_all(const Mirrors& mirrors, const ArrivalLanes& at, ChannelLanes& out);
void sample_all(const Mirrors& mirrors, const ArrivalLanes& at, const PairLanes& u, VectorLanes& to_sink);
void pass_on_all(const Mirrors& mirrors, const FieldPairLanes& in, const ArrivalLanes& at, const VectorLanes& to_sink,
                 PassageLanes& out);

void backscatter_all(const ConstantGamma& ground, const ArrivalLanes& at, ChannelLanes& out);
void sample_all(const ConstantGamma& ground, const ArrivalLanes& at, const PairLanes& u, VectorLanes& to_sink);
void pass_on_all(const ConstantGamma& ground, const FieldPairLanes& in, const ArrivalLanes& at,
                 const VectorLanes& to_sink, const PairLanes& draw, PassageLanes& out);

void backscatter_all(const Lambert& ground, const ArrivalLanes& at, ChannelLanes& out);
void sample_all(const Lambert& ground, const ArrivalLanes& at, const PairLanes& u, VectorLanes& to_sink);
void pass_on_all(const Lambert& ground, const FieldPairLanes& in, const ArrivalLanes& at, const VectorLanes& to_sink,
                 const PairLanes& draw, PassageLanes& out);

}  // namespace sigmascape::scatter
