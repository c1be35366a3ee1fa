#include "sigmascape/receiver/range_azimuth_receiver.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/never_scanned.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/receiver/bin_response.h"
#include "sigmascape/receiver/response_spread.h"

namespace sigmascape::receiver {
namespace {

// Of the elevation pattern's table: so many to its half-power width, within what cache and memory bear.
constexpr double elevation_steps_a_width = 256.0, fewest_elevation_steps = 0x1p12, most_elevation_steps = 0x1p20;
constexpr double most_bins = 0x1p27;
/// An azimuth so near the middle of a column, in columns, is there: what is left is rounding.
constexpr double middle_of_column = 1e-6;

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

/// Whether the beam's axis comes between the middles of this column and one beside it, of which a map reads both. The
/// other modes make their own azimuths.
bool looked_at(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid, std::size_t column) {
  if (radar.mode != radar::Mode::RealBeam) return true;
  const double left = grid.first_azimuth_rad + static_cast<double>(column) * grid.azimuth_step_rad;
  return radar::reaches(radar.scan, left + 0.5 * grid.azimuth_step_rad, grid.azimuth_step_rad);
}

/// Bins to spare at the edges of what is mapped, so that responses fit: 4 to 16 resolution cells.
double room_for(const BinResponse& response, double oversampling) {
  return std::clamp(std::floor(static_cast<double>(response.weights.size()) / 2.0) + 1.0, 4.0 * oversampling,
                    16.0 * oversampling);
}

void check(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid) {
  if (static_cast<double>(grid.ranges) * static_cast<double>(grid.azimuths) > most_bins) {
    throw Error(
        radar::title_of(radar),
        fmt::format("resolves {:.3g} m by {:.3g}°, which over the mapped area makes {} by {} bins",
                    radar.range_resolution_m, deg_from_radians(radar.beam_width_rad), grid.ranges, grid.azimuths),
        fmt::format("widen the pulse or the beam, or map less, for at most {:.1e} bins", most_bins));
  }
  for (std::size_t column = 0; column < grid.azimuths; ++column) {
    if (looked_at(radar, grid, column)) return;
  }
  const double middle = grid.first_azimuth_rad + 0.5 * static_cast<double>(grid.azimuths) * grid.azimuth_step_rad;
  throw radar::never_scanned(radar, middle);
}

}  // namespace

radar::RangeAzimuthGrid grid_covering(const radar::Radar& radar, std::span<const Vec3d> points, double oversampling) {
  double nearest = 1e30, farthest = 0.0, leftmost = 1e30, rightmost = -1e30;
  bool goes_round = false;
  const Vec3d first = points.front() - radar.position;
  const double middle = std::atan2(first.x, first.y);
  for (const Vec3d& point : points) {
    const Vec3d away = point - radar.position;
    // Azimuths are unwrapped about the first point's, so that a sector across south does not fall apart.
    const double azimuth = middle + std::remainder(std::atan2(away.x, away.y) - middle, 2.0 * pi);
    nearest = std::min(nearest, length(away));
    farthest = std::max(farthest, length(away));
    leftmost = std::min(leftmost, azimuth);
    rightmost = std::max(rightmost, azimuth);
    goes_round = goes_round || (away.x == 0.0 && away.y == 0.0);
  }
  const double beam_rad = radar::antenna_pattern(radar).azimuth().two_way_width_rad();
  const double range_step = radar.range_resolution_m / oversampling;
  const double azimuth_step = beam_rad / oversampling;
  const double spare_range = room_for(range_response(radar, range_step), oversampling) * range_step;
  const double spare_azimuth = room_for(azimuth_response(radar, azimuth_step), oversampling) * azimuth_step;
  const double first_range = std::max(0.0, nearest - spare_range);
  radar::RangeAzimuthGrid grid{
      .first_range_m = first_range,
      .range_step_m = range_step,
      .ranges = static_cast<std::size_t>(std::ceil((farthest + spare_range - first_range) / range_step)),
      .first_azimuth_rad = leftmost - spare_azimuth,
      .azimuth_step_rad = azimuth_step,
      .azimuths = static_cast<std::size_t>(std::ceil((rightmost - leftmost + 2.0 * spare_azimuth) / azimuth_step))};
  if (goes_round || static_cast<double>(grid.azimuths) * azimuth_step >= 2.0 * pi) {
    grid.azimuths = static_cast<std::size_t>(std::ceil(2.0 * pi / azimuth_step));
    grid.azimuth_step_rad = 2.0 * pi / static_cast<double>(grid.azimuths);
  }
  check(radar, grid);
  return grid;
}

RangeAzimuthReceiver::RangeAzimuthReceiver(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid)
    : radar_(radar),
      grid_(grid),
      gain_over_depression_(gain_over_depression(radar)),
      gate_start_m_(radar.receiver.first_range_m.value_or(grid.first_range_m)),
      gate_end_m_(radar.receiver.last_range_m.value_or(std::numeric_limits<double>::infinity())),
      unambiguous_m_(radar::unambiguous_range_m(radar.waveform.pulse_repetition_hz)),
      bins_(grid.azimuths, grid.ranges) {}

std::optional<RangeAzimuthReceiver::Heard> RangeAzimuthReceiver::heard(const radar::Echo& echo) const {
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

double RangeAzimuthReceiver::column_of(double azimuth_rad) const {
  const double middle_rad =
      grid_.first_azimuth_rad + 0.5 * static_cast<double>(grid_.azimuths) * grid_.azimuth_step_rad;
  return (middle_rad + turned_by_least(azimuth_rad - middle_rad) - grid_.first_azimuth_rad) / grid_.azimuth_step_rad;
}

void RangeAzimuthReceiver::add(std::span<const radar::Echo> echoes) {
  const bool goes_round = grid_.goes_round();
  const auto turn = static_cast<double>(grid_.azimuths);
  for (const radar::Echo& echo : echoes) {
    const auto at = heard(echo);
    if (!at) continue;
    const double column = column_of(echo.cross);
    bins_.add_shared(column, at->row, at->rcs_m2);
    if (!goes_round) continue;
    // The share of the bin at the other end.
    if (column < 0.5) bins_.add_shared(column + turn, at->row, at->rcs_m2);
    if (column > turn - 0.5) bins_.add_shared(column - turn, at->row, at->rcs_m2);
  }
}

void RangeAzimuthReceiver::add_at_azimuth(double azimuth_rad, std::span<const radar::Echo> echoes) {
  const double place = column_of(azimuth_rad) - 0.5;
  const double left = std::floor(place + middle_of_column);
  const double right_share = place - left < middle_of_column ? 0.0 : place - left;
  PowerLine in_left(grid_.ranges), in_right(right_share > 0.0 ? grid_.ranges : 0);
  for (const radar::Echo& echo : echoes) {
    const auto at = heard(echo);
    if (!at) continue;
    in_left.add_shared(at->row, at->rcs_m2 * static_cast<float>(1.0 - right_share));
    if (right_share > 0.0) in_right.add_shared(at->row, at->rcs_m2 * static_cast<float>(right_share));
  }
  add_line(left, in_left);
  if (right_share > 0.0) add_line(left + 1.0, in_right);
}

void RangeAzimuthReceiver::add_line(double column, const PowerLine& line) {
  const auto columns = static_cast<double>(grid_.azimuths);
  if (grid_.goes_round()) column -= columns * std::floor(column / columns);
  if (column >= 0.0 && column < columns) bins_.add_column(static_cast<std::size_t>(column), line);
}

radar::RangeAzimuthImage RangeAzimuthReceiver::image() const {
  if (bins_.overflows() > 0) {
    throw Error("map of " + radar::title_of(radar_), "a bin is brighter than the sums can hold, 6.7e7 m²",
                "use finer resolution or rougher materials");
  }
  radar::RangeAzimuthImage image{grid_, radar_.position, bins_.sums()};
  spread_responses(image, radar_);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t column = 0; column < grid_.azimuths; ++column) {
    const bool looks_there = looked_at(radar_, grid_, column);
    for (std::size_t row = 0; row < grid_.ranges; ++row) {
      if (!looks_there || !is_within_gate(row)) image.rcs_m2(column, row) = {nan, nan, nan, nan};
    }
  }
  return image;
}

bool RangeAzimuthReceiver::is_within_gate(std::size_t row) const {
  const double middle_m = grid_.first_range_m + (static_cast<double>(row) + 0.5) * grid_.range_step_m;
  const double last_m = std::min(gate_end_m_, gate_start_m_ + unambiguous_m_);
  return middle_m > gate_start_m_ - grid_.range_step_m && middle_m < last_m + grid_.range_step_m;
}

}  // namespace sigmascape::receiver
