#include "sigmascape/render/ground_samples.h"

#include <algorithm>

namespace sigmascape::render {

void GroundSamples::fit(const GroundSector& sector) {
  azimuths_ = sector.azimuths;
  distances_ = sector.distances;
  stride_ = (azimuths_ + azimuths_together - 1) / azimuths_together * azimuths_together;
  // Rows a multiple of a page apart would all fall into the same lines of the cache.
  if (stride_ % 512 == 0) stride_ += azimuths_together;
  const std::size_t wanted = stride_ * distances_;
  visible_.resize(std::max(visible_.size(), wanted));
  for (auto* layer : {&height_m_, &range_excess_m_, &sin_grazing_, &sin_local_grazing_, &slope_area_}) {
    layer->resize(std::max(layer->size(), wanted));
  }
  sea_range_m_.resize(std::max(sea_range_m_.size(), distances_));
}

}  // namespace sigmascape::render
