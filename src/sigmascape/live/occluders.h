#pragma once

#include "sigmascape/live/obstacle_mosaic.h"
#include "sigmascape/terrain/terrain_pyramid.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::live {

/// What hides ground.
struct Occluders {
  terrain::TerrainView terrain;
  const ObstacleMosaic* obstacles = nullptr;  ///< null where none stand apart from the textures
  float tallest_m = 0.0F;                     ///< of the obstacles
  terrain::TerrainView before_near = {};      ///< the terrain before the map's first node; empty: the same
  /// The obstacles there, on squares for its steps, which may be longer (`lead_of`); null: the same.
  const ObstacleMosaic* obstacles_before_near = nullptr;
  /// Terrain is taken to lie this much lower than it says: by how much it may be wrong, so that ground is not hidden
  /// by what is not there.
  float lowered_m = 0.0F;

  /// The terrain before the map's first node.
  [[nodiscard]] const terrain::TerrainView& ground_before() const {
    return before_near.columns > 0 ? before_near : terrain;
  }
  /// What stands there, where anything stands apart from the textures.
  [[nodiscard]] const ObstacleMosaic& obstacles_before() const {
    return obstacles_before_near != nullptr ? *obstacles_before_near : *obstacles;
  }
  /// Of all ground, as low as it may be, and of what stands on it.
  [[nodiscard]] terrain::HeightBounds bounds() const;
};

}  // namespace sigmascape::live
