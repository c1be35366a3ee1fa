#pragma once

#include <string>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::radar {

/// A mapping radar: what of it shapes a ground map.
struct Radar {
  std::string name = "radar";
  Vec3d position;  ///< local frame, height above mean sea level
  double frequency_hz = 10e9;
  Polarization polarization = Polarization::VV;  ///< what pictures and comparisons show; maps hold all
  double range_resolution_m = 2.0;               ///< half-power width of the pulse after compression
  double beam_width_rad = 0.01;  ///< one-way half-power width in azimuth, of the real or the sharpened beam
};

/// Where a radar stands that sees `target` from `azimuth_rad`, `elevation_rad` above the horizontal, at
/// `slant_range_m`.
[[nodiscard]] Vec3d position_seeing(Vec3d target, double azimuth_rad, double elevation_rad, double slant_range_m);

}  // namespace sigmascape::radar
