#include "sigmascape/live/ground_hearing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/receiver/bin_response.h"

namespace sigmascape::live {
namespace {

/// By how much less ground answers than its bins, sampled at their middles alone, would have it.
///
/// `received_power` takes a bin's cross-section for what a pulse hears with its peak in the bin's middle, between which
/// the responses are reckoned with at steps of the bins: over even ground w Δ of it, w being `peak_bins` and Δ the
/// step. A pulse hears ∫|h|² of even ground. Where bins are finer than responses the two are one; where they are
/// coarser, most of a bin's ground lies beside the pulse.
float part_of_ground_heard(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid) {
  const double along = receiver::range_energy_bins(radar, grid.range_step_m) /
                       receiver::range_response(radar, grid.range_step_m).peak_bins;
  const double across = receiver::azimuth_energy_bins(radar, grid.azimuth_step_rad) /
                        receiver::azimuth_response(radar, grid.azimuth_step_rad).peak_bins;
  return static_cast<float>(along * across);
}

}  // namespace

GroundHearing::GroundHearing(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid)
    : places_(radar, grid), part_heard_(part_of_ground_heard(radar, grid)) {
  move_to(grid);
}

void GroundHearing::move_to(const radar::RangeAzimuthGrid& grid) {
  grid_ = grid;
  places_.move_to(grid);
  places_of_ranges_.resize(grid.ranges);
  for (std::size_t range = 0; range < grid.ranges; ++range) places_of_ranges_[range] = place_of(range);
}

void GroundHearing::weigh_evenly(std::span<float> weights) const {
  weigh([](double) { return 0.0; }, weights);
}

radar::Echo GroundHearing::unit_echo(std::size_t range, float sin_depression) const {
  return {.range_m = middle_m(range),
          .cross = 0.0,
          .rcs_m2 = {1.0F, 1.0F, 1.0F, 1.0F},
          .bounces = 1,
          .sin_depression = sin_depression};
}

GroundHearing::Place GroundHearing::place_of(std::size_t range) const {
  constexpr double in_place = 1e-6;  // in bins; what is left is rounding
  const auto heard = places_.heard(unit_echo(range, 0.0F));
  if (!heard) return {};
  const double near = std::floor(heard->row - 0.5 + in_place), far_share = heard->row - 0.5 - near;
  const auto is_there = [this](double bin) { return bin >= 0.0 && bin < static_cast<double>(grid_.ranges); };
  Place place;
  if (is_there(near)) {
    place.near = static_cast<std::size_t>(near);
    place.near_share = static_cast<float>(1.0 - std::max(far_share, 0.0));
  }
  if (far_share > in_place && is_there(near + 1.0)) {
    place.far = static_cast<std::size_t>(near + 1.0);
    place.far_share = static_cast<float>(far_share);
  }
  return place;
}

void check_frequency(const Frame& frame, const radar::Radar& radar) {
  constexpr double as_good_as_one = 0.01;
  if (frame.frequency_hz == 0.0) return;
  if (std::abs(radar.frequency_hz - frame.frequency_hz) <= as_good_as_one * frame.frequency_hz) return;
  throw Error(radar::title_of(radar),
              fmt::format("has a frequency of {:g} GHz, and the frame shows ground at {:g} GHz",
                          radar.frequency_hz / 1e9, frame.frequency_hz / 1e9),
              "open the ground at the radar's frequency, or give a radar of the ground's");
}

radar::Radar that_scans(radar::Radar radar) {
  radar.mode = radar::Mode::RealBeam;
  return radar;
}

double targets_heard_from_m(const radar::RangeAzimuthGrid& grid) {
  return std::max(grid.first_range_m - 0.5 * grid.range_step_m, 0.0);
}

radar::Radar hearing_first_bins(radar::Radar radar, const radar::RangeAzimuthGrid& grid) {
  if (!radar.receiver.first_range_m) radar.receiver.first_range_m = targets_heard_from_m(grid);
  return radar;
}

}  // namespace sigmascape::live
