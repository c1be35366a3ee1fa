#pragma once

#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::receiver {

/// Lays the responses of the compressed pulse and of the two-way beam over the bins of an image
/// (docs/physics/receiver.md, Eq. 1): power is kept but for what leaves the bins, and where they go round none leaves
/// them sideways.
void spread_responses(radar::RangeAzimuthImage& image, const radar::Radar& radar);

}  // namespace sigmascape::receiver
