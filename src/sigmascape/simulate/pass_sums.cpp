#include "sigmascape/simulate/pass_sums.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sigmascape/base/units.h"
#include "sigmascape/simulate/error_of_passes.h"

namespace sigmascape::simulate {

PassSums::PassSums(const radar::RangeAzimuthGrid& grid, Vec3d radar_position, const radar::Rectangle& area,
                   double ground_height_m)
    : grid_(grid),
      radar_position_(radar_position),
      sums_(radar::Channels::count * grid.azimuths * grid.ranges),
      power_(grid_.azimuths, grid_.ranges),
      squares_(grid_.azimuths, grid_.ranges),
      is_in_area_(grid_.azimuths, grid_.ranges) {
  const double below_m = radar_position_.z - ground_height_m;
  for (std::size_t range = 0; range < grid_.ranges; ++range) {
    for (std::size_t beam = 0; beam < grid_.azimuths; ++beam)
      is_in_area_(beam, range) = is_in_area(area, below_m, range, beam) ? 1 : 0;
  }
}

bool PassSums::is_in_area(const radar::Rectangle& area, double below_m, std::size_t range, std::size_t beam) const {
  const double slant_m = grid_.first_range_m + (static_cast<double>(range) + 0.5) * grid_.range_step_m;
  const double ground_m = std::sqrt(std::max(slant_m * slant_m - below_m * below_m, 0.0));
  const double azimuth = grid_.first_azimuth_rad + (static_cast<double>(beam) + 0.5) * grid_.azimuth_step_rad;
  return area.contains(
      {radar_position_.x + ground_m * std::sin(azimuth), radar_position_.y + ground_m * std::cos(azimuth)});
}

void PassSums::add(const radar::RangeAzimuthImage& pass) {
  const auto values = pass.rcs_m2.values();
  for (std::size_t bin = 0; bin < values.size(); ++bin) {
    const radar::Channels& value = values[bin];
    const double channels[] = {value.vv, value.hh, value.hv, value.re_vvhh};
    for (std::size_t c = 0; c < radar::Channels::count; ++c) sums_[radar::Channels::count * bin + c] += channels[c];
    const double power = value.power(radar::Polarization::Sum);
    power_.values()[bin] += power;
    squares_.values()[bin] += power * power;
  }
  ++passes_;
}

std::optional<std::size_t> PassSums::bin_in_area(const radar::Echo& echo) const {
  const double middle = grid_.first_azimuth_rad + 0.5 * static_cast<double>(grid_.azimuths) * grid_.azimuth_step_rad;
  const double azimuth = middle + turned_by_least(echo.cross - middle);
  const double beam = (azimuth - grid_.first_azimuth_rad) / grid_.azimuth_step_rad;
  const double range = (echo.range_m - grid_.first_range_m) / grid_.range_step_m;
  if (!(beam >= 0.0 && beam < static_cast<double>(grid_.azimuths) && range >= 0.0 &&
        range < static_cast<double>(grid_.ranges))) {
    return std::nullopt;
  }
  const std::size_t bin = static_cast<std::size_t>(range) * grid_.azimuths + static_cast<std::size_t>(beam);
  if (is_in_area_.values()[bin] == 0) return std::nullopt;
  return bin;
}

double PassSums::relative_error(std::size_t bin) const {
  return relative_error_of_mean(power_.values()[bin], squares_.values()[bin], passes_);
}

double PassSums::median_error_db() const {
  std::vector<double> errors;
  for (std::size_t bin = 0; bin < power_.size(); ++bin) {
    if (is_in_area_.values()[bin] != 0 && power_.values()[bin] > 0.0) errors.push_back(relative_error(bin));
  }
  return simulate::median_error_db(std::move(errors), passes_);
}

radar::RangeAzimuthImage PassSums::mean() const {
  radar::RangeAzimuthImage image{grid_, radar_position_, Array2D<radar::Channels>(grid_.azimuths, grid_.ranges)};
  for (std::size_t bin = 0; bin < image.rcs_m2.size(); ++bin) {
    const auto mean_of = [&](std::size_t c) {
      return static_cast<float>(sums_[radar::Channels::count * bin + c] / passes_);
    };
    image.rcs_m2.values()[bin] = {mean_of(0), mean_of(1), mean_of(2), mean_of(3)};
  }
  return image;
}

Array2D<float> PassSums::relative_errors() const {
  Array2D<float> errors(grid_.azimuths, grid_.ranges);
  for (std::size_t bin = 0; bin < errors.size(); ++bin) {
    if (power_.values()[bin] > 0.0) errors.values()[bin] = static_cast<float>(relative_error(bin));
  }
  return errors;
}

}  // namespace sigmascape::simulate
