#pragma once

#include "sigmascape/scatter/lanes.h"
#include "sigmascape/scatter/mirrors.h"

namespace sigmascape::scatter {

/// Beckmann's mirrors with correlated masking asked sixteen times at once, in vector code: what most of a scene is made
/// of. All lanes get an answer, needed or not.
void backscatter_all(const Mirrors& mirrors, const ArrivalLanes& at, ChannelLanes& out);
void sample_all(const Mirrors& mirrors, const ArrivalLanes& at, const PairLanes& u, VectorLanes& to_sink);
void pass_on_all(const Mirrors& mirrors, const FieldPairLanes& in, const ArrivalLanes& at, const VectorLanes& to_sink,
                 PassageLanes& out);

}  // namespace sigmascape::scatter
