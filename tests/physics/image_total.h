#pragma once

#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape {

/// VV of all bins.
inline double total_vv_m2(const radar::RangeAzimuthImage& image) {
  double sum_m2 = 0.0;
  for (const radar::Channels& bin : image.rcs_m2.values()) sum_m2 += static_cast<double>(bin.vv);
  return sum_m2;
}

}  // namespace sigmascape
