#include "sigmascape/receiver/range_azimuth_receiver.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/never_scanned.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/receiver/bin_response.h"
#include "sigmascape/receiver/response_spread.h"

namespace sigmascape::receiver {
namespace {

constexpr double most_bins = 0x1p27;
/// An azimuth so near the middle of a column, in columns, is there: what is left is rounding.
constexpr double middle_of_column = 1e-6;

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
  const double middle = azimuth_of(first);
  for (const Vec3d& point : points) {
    const Vec3d away = point - radar.position;
    // Azimuths are unwrapped about the first point's, so that a sector across south does not fall apart.
    const double azimuth = middle + std::remainder(azimuth_of(away) - middle, 2.0 * pi);
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
    : radar_(radar), grid_(grid), places_(radar, grid), bins_(grid.azimuths, grid.ranges) {}

void RangeAzimuthReceiver::add(std::span<const radar::Echo> echoes) {
  const bool goes_round = grid_.goes_round();
  const auto turn = static_cast<double>(grid_.azimuths);
  for (const radar::Echo& echo : echoes) {
    const auto at = places_.heard(echo);
    if (!at) continue;
    const double column = places_.column_of(echo.cross);
    bins_.add_shared(column, at->row, at->rcs_m2);
    if (!goes_round) continue;
    // The share of the bin at the other end.
    if (column < 0.5) bins_.add_shared(column + turn, at->row, at->rcs_m2);
    if (column > turn - 0.5) bins_.add_shared(column - turn, at->row, at->rcs_m2);
  }
}

void RangeAzimuthReceiver::add_at_azimuth(double azimuth_rad, std::span<const radar::Echo> echoes) {
  const double place = places_.column_of(azimuth_rad) - 0.5;
  const double left = std::floor(place + middle_of_column);
  const double right_share = place - left < middle_of_column ? 0.0 : place - left;
  PowerLine in_left(grid_.ranges), in_right(right_share > 0.0 ? grid_.ranges : 0);
  for (const radar::Echo& echo : echoes) {
    const auto at = places_.heard(echo);
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
  places_.blank_unheard(image);
  return image;
}

}  // namespace sigmascape::receiver
