#include "sigmascape/atlas/aspect_cell.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::atlas {

AspectCells::AspectCells(const AspectGrid& grid, double frequency_hz) : grid_(grid), azimuths_rad_(grid.azimuths_rad) {
  for (const double elevation : grid.elevations_rad) {
    cotangents_.push_back(static_cast<float>(std::cos(elevation) / std::sin(elevation)));
    sines_.push_back(static_cast<float>(std::sin(elevation)));
  }
  if (cotangents_.size() == 1) {
    cotangents_.push_back(cotangents_.front());
    sines_.push_back(sines_.front());
  }

  const std::vector<double>& axis = grid.frequencies_hz;
  const auto above = std::ranges::upper_bound(axis, frequency_hz);
  if (above == axis.begin() || above == axis.end()) {
    frequencies_[0] = above == axis.begin() ? 0 : axis.size() - 1;
    return;
  }
  const auto first = static_cast<std::size_t>(above - axis.begin()) - 1;
  const double fraction = std::log(frequency_hz / axis[first]) / std::log(*above / axis[first]);
  frequencies_ = {first, first + 1};
  if (fraction == 0.0) return;
  frequency_count_ = 2;
  frequency_parts_ = {static_cast<float>(1.0 - fraction), static_cast<float>(fraction)};
}

std::array<LookIndex, AspectCells::most_looks> AspectCells::looks_of(AspectCell cell) const {
  std::array<LookIndex, most_looks> looks{};
  std::size_t count = 0;
  const std::size_t last_elevation = grid_.elevations_rad.size() - 1;
  for (std::size_t f = 0; f < frequency_count_; ++f) {
    for (std::size_t e = 0; e < 2; ++e) {
      for (std::size_t a = 0; a < 2; ++a) {
        looks[count++] = grid_.index_of((cell.azimuth + a) % azimuths_rad_.size(),
                                        std::min(cell.elevation + e, last_elevation), frequencies_[f]);
      }
    }
  }
  return looks;
}

std::uint32_t AspectCells::azimuth_cell(double azimuth_rad) const {
  const double wrapped = wrapped_azimuth(azimuth_rad);
  const auto above = std::ranges::upper_bound(azimuths_rad_, wrapped);
  if (above == azimuths_rad_.begin()) return static_cast<std::uint32_t>(azimuths_rad_.size() - 1);
  return static_cast<std::uint32_t>(above - azimuths_rad_.begin() - 1);
}

double AspectCells::azimuth_width(std::uint32_t cell) const {
  if (cell + 1U < azimuths_rad_.size()) return azimuths_rad_[cell + 1U] - azimuths_rad_[cell];
  return azimuths_rad_.front() + 2.0 * pi - azimuths_rad_[cell];
}

}  // namespace sigmascape::atlas
