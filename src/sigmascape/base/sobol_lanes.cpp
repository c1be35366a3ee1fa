#include "sigmascape/base/sobol_lanes.h"

#include "sigmascape/base/vector_targets.h"

namespace sigmascape {

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void draw_pairs(const SobolLanes& points, std::uint32_t pair,
                                                           PairLanes& out) {
  for (std::size_t i = 0; i < lane_count; ++i) out.set(i, SobolPoint(points.key[i], points.index[i]).pair(pair));
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void draw_independent(const SobolLanes& points, std::uint32_t dimension,
                                                                 FloatLanes& out) {
  for (std::size_t i = 0; i < lane_count; ++i) out[i] = SobolPoint::independent(points.stem[i], dimension);
}

}  // namespace sigmascape
