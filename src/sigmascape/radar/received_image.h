#pragma once

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::radar {

/// Mean power, without speckle, that a compressed pulse from each bin has at the antenna's terminals.
struct ReceivedImage {
  RangeAzimuthGrid grid;
  Vec3d radar_position;
  Array2D<Channels> power_w;  ///< [azimuth, range], W; in `values()` azimuths run fastest
  double noise_w = 0.0;       ///< mean noise beside it, the same in every bin
};

}  // namespace sigmascape::radar
