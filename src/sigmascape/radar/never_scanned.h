#pragma once

#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar_title.h"

namespace sigmascape::radar {

/// What is said of a radar whose scan never comes to what is to be mapped, in the middle of which lies this azimuth.
[[nodiscard]] inline Error never_scanned(const Radar& radar, double azimuth_rad) {
  return {title_of(radar), "never points to what is to be mapped",
          fmt::format("let its scan take in azimuth {:.1f}°", deg_from_radians(wrapped_azimuth(azimuth_rad)))};
}

}  // namespace sigmascape::radar
