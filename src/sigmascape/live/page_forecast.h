#pragma once

#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/live/page_cache.h"
#include "sigmascape/live/sector.h"
#include "sigmascape/live/stand_in_ground.h"

namespace sigmascape::live {

/// What a frame will look at.
struct ForecastView {
  Vec3d radar;
  Sector sector;
  std::size_t level = 0;
  double ground_height_m = 0.0;  ///< somewhere in the middle of the terrain: decides the elevation
};

/// What there is: pages that were read, and those that always are there.
struct PagesThere {
  const PageCache::View& read;
  const StandInGround& stand_in;

  /// Whether a page is there as finely as it can be.
  [[nodiscard]] bool has(const PageKey& key) const {
    return read.find(key) != nullptr || stand_in.is_as_good_as_read(stand_in.find(key));
  }
};

/// Adds the pages that a frame will want and that are not there, as far as the room that `wanted` has taken already
/// goes. Aspects are those of points spread over each tile, on level ground.
void add_forecast(const PagesThere& there, const PageSource& source, const ForecastView& view,
                  std::vector<PageKey>& wanted);

}  // namespace sigmascape::live
