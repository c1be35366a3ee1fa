#pragma once

#include <map>
#include <string>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::radar {

/// What a radar receives from each place on the ground.
struct PowerMap {
  GroundGrid grid;
  /// [column, row], W: mean power of a compressed pulse at the antenna's terminals, in the bin at the cell; NaN where
  /// the radar did not look.
  Array2D<Channels> power_w;
  double noise_w = 0.0;  ///< mean noise beside it, the same in every cell
  std::string crs;       ///< of the local frame, as PROJ understands it
  std::map<std::string, std::string> metadata;
};

}  // namespace sigmascape::radar
