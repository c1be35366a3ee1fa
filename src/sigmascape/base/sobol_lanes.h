#pragma once

#include <cstdint>

#include "sigmascape/base/lanes.h"
#include "sigmascape/base/sobol.h"

namespace sigmascape {

/// Sixteen Sobol points asked at once. Each lane has the answer, to the bit, that its point gives.
struct SobolLanes {
  alignas(64) std::uint64_t key[lane_count]{};
  alignas(64) std::uint64_t stem[lane_count]{};
  alignas(64) std::uint32_t index[lane_count]{};

  void set(std::size_t i, const SobolPoint& point) {
    key[i] = point.key();
    stem[i] = point.stem();
    index[i] = point.index();
  }
};

void draw_pairs(const SobolLanes& points, std::uint32_t pair, PairLanes& out);
void draw_independent(const SobolLanes& points, std::uint32_t dimension, FloatLanes& out);

}  // namespace sigmascape
