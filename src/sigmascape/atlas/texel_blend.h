#pragma once

#include <array>
#include <cstddef>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/half.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::atlas {

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
