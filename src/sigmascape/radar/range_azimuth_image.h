#pragma once

#include <cmath>
#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/units.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::radar {

/// Whether so many azimuths make a whole turn, so that the first lies next to the last.
[[nodiscard]] inline bool goes_round(std::size_t azimuths, double azimuth_step_rad) {
  return std::abs(static_cast<double>(azimuths) * azimuth_step_rad - 2.0 * pi) < 1e-6;
}

/// The bins of a radar's receive buffer: slant range by azimuth. Azimuth is that of the direction from the radar,
/// clockwise from north, not wrapped: it grows steadily across the sector even through north.
struct RangeAzimuthGrid {
  double first_range_m = 0.0;  ///< near edge of bin row 0
  double range_step_m = 1.0;
  std::size_t ranges = 0;
  double first_azimuth_rad = 0.0;  ///< left edge of bin column 0
  double azimuth_step_rad = 1e-3;
  std::size_t azimuths = 0;

  [[nodiscard]] bool goes_round() const { return radar::goes_round(azimuths, azimuth_step_rad); }

  friend constexpr bool operator==(const RangeAzimuthGrid&, const RangeAzimuthGrid&) = default;
};

/// What the receiver has in its bins.
struct RangeAzimuthImage {
  RangeAzimuthGrid grid;
  Vec3d radar_position;
  /// [azimuth, range]: cross-section of all that answers in the bin, linear. In `values()` azimuths run fastest, ranges
  /// slowest: the other way round than the bins of a live frame.
  Array2D<Channels> rcs_m2;
};

}  // namespace sigmascape::radar
