#pragma once

#include <map>
#include <string>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::radar {

/// A picture of the ground as a radar measures it.
struct GroundMap {
  GroundGrid grid;
  Array2D<Channels>
      sigma0;       ///< [column, row], σ0 with respect to horizontal area, linear; NaN where the radar did not look
  std::string crs;  ///< of the local frame, as PROJ understands it
  std::map<std::string, std::string> metadata;
};

}  // namespace sigmascape::radar
