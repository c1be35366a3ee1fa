#pragma once

#include <cstddef>

#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::product {

/// How a plan position indicator is turned and how finely it is drawn.
struct PpiOptions {
  double up_rad = 0.0;            ///< azimuth at the top: 0 for north up, the platform's heading for heading up
  std::size_t longer_side = 512;  ///< pixels along the longer side of the sector's box
};

/// Plan position indicator: the sector as seen from above, range outwards from the radar, in σ0. No terrain comes in:
/// points lie at their slant range.
///
/// Pixels are means of what they cover, bilinear between bins, in linear power (pixel_means.h); NaN outside the sector.
/// `grid` of the map is a box about the sector in
/// metres from the radar, its rows pointing to `up_rad`; it has no coordinate system.
[[nodiscard]] radar::GroundMap ppi(const radar::RangeAzimuthImage& image, const PpiOptions& options = {});

/// B-scope: azimuth to the right and range upwards, bin for bin, in σ0. `grid` counts bins, its cells are range steps.
[[nodiscard]] radar::GroundMap b_scope(const radar::RangeAzimuthImage& image);

}  // namespace sigmascape::product
