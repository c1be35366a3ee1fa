#include "sigmascape/render/frame_image.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/receiver/bin_response.h"

namespace sigmascape::render {
namespace {

/// A line of bins, of which each spreads over its neighbours: into the other end where the line goes round, elsewhere
/// what leaves it is lost.
std::vector<radar::Channels> spread(const std::vector<radar::Channels>& line, const std::vector<float>& weights,
                                    bool is_round) {
  const auto reach = static_cast<std::ptrdiff_t>(weights.size() / 2), bins = static_cast<std::ptrdiff_t>(line.size());
  std::vector<radar::Channels> spread(line.size());
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const float weight = weights[static_cast<std::size_t>(k + reach)];
    const std::ptrdiff_t first = is_round ? 0 : std::max<std::ptrdiff_t>(0, -k);
    const std::ptrdiff_t end = is_round ? bins : std::min(bins, bins - k);
    for (std::ptrdiff_t bin = first; bin < end; ++bin) {
      const std::ptrdiff_t from = ((bin + k) % bins + bins) % bins;
      spread[static_cast<std::size_t>(bin)] += line[static_cast<std::size_t>(from)] * weight;
    }
  }
  return spread;
}

void spread_over_ranges(Array2D<radar::Channels>& bins, const std::vector<float>& pulse) {
  std::vector<radar::Channels> beam(bins.rows());
  for (std::size_t column = 0; column < bins.columns(); ++column) {
    for (std::size_t range = 0; range < bins.rows(); ++range) beam[range] = bins(column, range);
    const std::vector<radar::Channels> received = spread(beam, pulse, false);
    for (std::size_t range = 0; range < bins.rows(); ++range) bins(column, range) = received[range];
  }
}

void spread_over_beams(Array2D<radar::Channels>& bins, const std::vector<float>& beam, bool is_round) {
  for (std::size_t range = 0; range < bins.rows(); ++range) {
    const auto row = bins.row(range);
    std::ranges::copy(spread({row.begin(), row.end()}, beam, is_round), row.begin());
  }
}

}  // namespace

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
  const radar::RangeAzimuthGrid& grid = image.grid;
  spread_over_beams(image.rcs_m2, receiver::azimuth_response(radar, grid.azimuth_step_rad).weights, grid.goes_round());
  spread_over_ranges(image.rcs_m2, receiver::range_response(radar, grid.range_step_m).weights);
  return image;
}

}  // namespace sigmascape::render
