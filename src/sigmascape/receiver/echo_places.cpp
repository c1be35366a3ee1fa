#include "sigmascape/receiver/echo_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/range_ambiguity.h"

namespace sigmascape::receiver {
namespace {

// Of the elevation pattern's table: so many to its half-power width, within what cache and memory bear.
constexpr double elevation_steps_a_width = 256.0, fewest_elevation_steps = 0x1p12, most_elevation_steps = 0x1p20;

/// Two-way relative gain at evenly spaced depression angles from −90° to 90°; empty for an antenna that does not tell
/// elevations apart.
std::vector<float> gain_over_depression(const radar::Radar& radar) {
  const auto pattern = radar::antenna_pattern(radar);
  if (pattern.elevation().even()) return {};
  const double wanted = std::ceil(elevation_steps_a_width * pi / radar.antenna.elevation_width_rad);
  const double steps = std::clamp(wanted, fewest_elevation_steps, most_elevation_steps);
  std::vector<float> gain;
  for (double k = 0.0; k <= steps; ++k) {
    const double elevation = pi * (0.5 - k / steps);
    gain.push_back(static_cast<float>(pattern.elevation().two_way_power(elevation - pattern.tilt_rad())));
  }
  return gain;
}

float interpolated(const std::vector<float>& gain, float sin_depression) {
  const double depression_rad = std::asin(std::clamp(static_cast<double>(sin_depression), -1.0, 1.0));
  const double place = (depression_rad / pi + 0.5) * static_cast<double>(gain.size() - 1);
  const auto left = std::min(static_cast<std::size_t>(place), gain.size() - 2);
  return std::lerp(gain[left], gain[left + 1], static_cast<float>(place - static_cast<double>(left)));
}

}  // namespace

EchoPlaces::EchoPlaces(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid)
    : radar_(radar),
      grid_(grid),
      gain_over_depression_(gain_over_depression(radar)),
      gate_end_m_(radar.receiver.last_range_m.value_or(std::numeric_limits<double>::infinity())),
      unambiguous_m_(radar::unambiguous_range_m(radar.waveform.pulse_repetition_hz)) {
  move_to(grid);
}

void EchoPlaces::move_to(const radar::RangeAzimuthGrid& grid, double gate_start_m) {
  grid_ = grid;
  gate_start_m_ = radar_.receiver.first_range_m.value_or(gate_start_m);
}

std::optional<EchoPlaces::Heard> EchoPlaces::heard(const radar::Echo& echo) const {
  double range_m = echo.range_m;
  radar::Channels rcs_m2 = echo.rcs_m2;
  if (range_m < gate_start_m_ || range_m >= gate_start_m_ + unambiguous_m_) {
    range_m = radar::apparent_range_m(echo.range_m, gate_start_m_, radar_.waveform.pulse_repetition_hz);
    const double nearer = range_m / echo.range_m;
    const double through_air = std::exp(-2.0 * radar_.atmosphere_per_m * (echo.range_m - range_m));
    rcs_m2 = rcs_m2 * static_cast<float>(nearer * nearer * nearer * nearer * through_air);
  }
  if (range_m > gate_end_m_) return std::nullopt;
  if (!gain_over_depression_.empty()) rcs_m2 = rcs_m2 * interpolated(gain_over_depression_, echo.sin_depression);
  return Heard{(range_m - grid_.first_range_m) / grid_.range_step_m, rcs_m2};
}

double EchoPlaces::column_of(double azimuth_rad) const {
  const double middle_rad =
      grid_.first_azimuth_rad + 0.5 * static_cast<double>(grid_.azimuths) * grid_.azimuth_step_rad;
  return (middle_rad + turned_by_least(azimuth_rad - middle_rad) - grid_.first_azimuth_rad) / grid_.azimuth_step_rad;
}

void EchoPlaces::blank_unheard(radar::RangeAzimuthImage& image) const {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t column = 0; column < grid_.azimuths; ++column) {
    const bool looks_there = looked_at(radar_, grid_, column);
    for (std::size_t row = 0; row < grid_.ranges; ++row) {
      if (!looks_there || !is_within_gate(row)) image.rcs_m2(column, row) = {nan, nan, nan, nan};
    }
  }
}

bool EchoPlaces::is_within_gate(std::size_t row) const {
  const double middle_m = grid_.first_range_m + (static_cast<double>(row) + 0.5) * grid_.range_step_m;
  const double last_m = std::min(gate_end_m_, gate_start_m_ + unambiguous_m_);
  return middle_m > gate_start_m_ - grid_.range_step_m && middle_m < last_m + grid_.range_step_m;
}

bool looked_at(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid, std::size_t column) {
  if (radar.mode != radar::Mode::RealBeam) return true;
  const double left = grid.first_azimuth_rad + static_cast<double>(column) * grid.azimuth_step_rad;
  return radar::reaches(radar.scan, left + 0.5 * grid.azimuth_step_rad, grid.azimuth_step_rad);
}

}  // namespace sigmascape::receiver
