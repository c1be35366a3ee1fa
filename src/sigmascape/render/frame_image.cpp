#include "sigmascape/render/frame_image.h"

#include <cstddef>

#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/receiver/response_spread.h"

namespace sigmascape::render {

radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose) {
  const auto& [grid, amplitudes_m, powers_m2, report] = frame;
  radar::RangeAzimuthImage image{grid, pose.position, Array2D<radar::Channels>(grid.azimuths, grid.ranges)};
  for (std::size_t beam = 0; beam < grid.azimuths; ++beam) {
    for (std::size_t range = 0; range < grid.ranges; ++range) {
      const std::size_t first = 4 * (beam * grid.ranges + range);
      image.rcs_m2(beam, range) =
          powers_m2.empty()
              ? radar::power_of({amplitudes_m[first], amplitudes_m[first + 1], amplitudes_m[first + 2]})
              : radar::Channels{powers_m2[first], powers_m2[first + 1], powers_m2[first + 2], powers_m2[first + 3]};
    }
  }
  return image;
}

radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose, const radar::Radar& radar) {
  radar::RangeAzimuthImage image = image_of(frame, pose);
  receiver::spread_responses(image, radar);
  return image;
}

}  // namespace sigmascape::render
