#pragma once

#include <cstddef>

#include "sigmascape/scene/scene.h"

namespace sigmascape::cli {

/// Vertices within a scene's extent, of which a part of a larger scene has few.
struct VertexCounts {
  std::size_t terrain = 0;  ///< nodes
  std::size_t objects = 0;  ///< of buildings, and of every instance its own
};

/// An instance counts when it stands within the extent.
[[nodiscard]] VertexCounts vertices_within_extent(const scene::Scene& scene);

}  // namespace sigmascape::cli
