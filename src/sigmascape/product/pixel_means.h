#pragma once

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::product {

/// Mean σ0 of what each pixel covers of the bins that were seen, those that are not NaN, [column, row], linear; NaN
/// where it covers nothing of them. `pixels` lie in metres about the radar, azimuth `up_rad` at the top, and must hold
/// all of the sector. Points lie at their slant range.
///
/// Every bin's cross-section is found again in the pixels, however small it is beside them. Between the centres of bins
/// σ0 is bilinear, so that bins wider than pixels make no steps; beyond the outer centres, and beside bins that were
/// not seen, it is held.
[[nodiscard]] Array2D<radar::Channels> pixel_means(const radar::RangeAzimuthImage& image,
                                                   const radar::GroundGrid& pixels, double up_rad);

}  // namespace sigmascape::product
