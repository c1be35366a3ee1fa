#pragma once

#include <cmath>
#include <fmt/format.h>
#include <string>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {

/// An azimuth in degrees clockwise from north, in [0, 360) after rounding too: "0.00" of what rounds to 360.
[[nodiscard]] inline std::string azimuth_text_deg(double azimuth_rad, int decimals) {
  const double azimuth_deg = deg_from_radians(wrapped_azimuth(azimuth_rad));
  const double half_of_last_digit = 0.5 * std::pow(10.0, -decimals);
  return fmt::format("{:.{}f}", azimuth_deg < 360.0 - half_of_last_digit ? azimuth_deg : 0.0, decimals);
}

}  // namespace sigmascape::radar
