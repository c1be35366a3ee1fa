#pragma once

#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/render/page_cache.h"
#include "sigmascape/render/sector.h"

namespace sigmascape::render {

/// What a frame will look at.
struct ForecastView {
  Vec3d radar;
  Sector sector;
  std::size_t level = 0;
  double ground_height_m = 0.0;  ///< somewhere in the middle of the terrain: decides the elevation
};

/// Adds the pages that a frame will want and that are not there, as far as the room that `wanted` has taken already
/// goes. Aspects are those of points spread over each tile, on level ground.
void add_forecast(const PageCache::View& there, const PageSource& source, const ForecastView& view,
                  std::vector<PageKey>& wanted);

}  // namespace sigmascape::render
