#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/half.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::atlas {

/// What the next texel has in a point so far on the way from one's middle to its: nothing and all on the outer quarters
/// of the way, rising evenly over its half about the edge between them.
/// docs/decisions/0163-texels-blend-over-half-their-width.md.
[[nodiscard]] inline float share_of_next(double way) {
  return std::clamp(2.0F * static_cast<float>(way) - 0.5F, 0.0F, 1.0F);
}

/// One of the texels that make up a point.
struct TexelPart {
  const Half* looks = nullptr;    ///< [look][channel]
  const float* weight = nullptr;  ///< of each look of the weights, the scale it was stored under in it
  float part = 0.0F;
};

/// The four texels about a point, or fewer.
struct TexelParts {
  std::array<TexelPart, 4> texels;
  std::size_t count = 0;
};

/// Σ over texels and looks of part · weight · stored number, all channels at once.
[[nodiscard]] radar::Channels blended(const TexelParts& parts, const AspectWeights& weights);

}  // namespace sigmascape::atlas
