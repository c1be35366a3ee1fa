#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sigmascape/live/frame.h"
#include "sigmascape/live/frame_power.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/receiver/echo_places.h"
#include "sigmascape/receiver/targets_by_beam.h"

namespace sigmascape::live {

/// How a radar hears the ground in the bins of live frames before its pulse and its beam are laid over them: what
/// receiver::RangeAzimuthReceiver does to echoes, one from the middle of each bin.
///
/// Two steps, for the first needs to be done only where the radar has moved: how strongly each bin of a beam is heard,
/// and what is heard of a beam that holds so much.
class GroundHearing {
 public:
  GroundHearing(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid);
  /// Of bins that are as wide, but elsewhere or of another number.
  void move_to(const radar::RangeAzimuthGrid& grid);

  [[nodiscard]] const receiver::EchoPlaces& places() const { return places_; }

  /// How strongly the bins of one beam are heard, [range]: by the gain in elevation towards their middles, and by what
  /// folds into the gate from nearer or farther. `sin_depression(range_m)`, as of radar::Echo, is called at growing
  /// ranges.
  template <typename SinDepression>
  void weigh(SinDepression&& sin_depression, std::span<float> weights) const {
    for (std::size_t range = 0; range < grid_.ranges; ++range) {
      const auto heard = places_.heard(unit_echo(range, static_cast<float>(sin_depression(middle_m(range)))));
      weights[range] = heard ? heard->rcs_m2.vv : 0.0F;
    }
  }
  /// The same for an antenna to which all depressions are one.
  void weigh_evenly(std::span<float> weights) const;

  /// What is heard in each range of a beam that holds `held`: of bins wider than a pulse or the beam the part that one
  /// pulse hears. A number may be a power of one polarization or all of them (radar::Channels).
  template <typename Number>
  void hear(std::span<const Number> held, std::span<const float> weights, std::span<Number> heard) const {
    for (Number& number : heard) number = Number{};
    for (std::size_t range = 0; range < held.size(); ++range) {
      const Number rcs_m2 = held[range] * part_heard_ * weights[range];
      const Place& place = places_of_ranges_[range];
      if (place.near_share > 0.0F) heard[place.near] += rcs_m2 * place.near_share;
      if (place.far_share > 0.0F) heard[place.far] += rcs_m2 * place.far_share;
    }
  }

 private:
  /// In which two bins a range is heard; neither has a share of what is heard outside the bins or not at all.
  struct Place {
    std::size_t near = 0, far = 0;
    float near_share = 0.0F, far_share = 0.0F;
  };

  [[nodiscard]] double middle_m(std::size_t range) const {
    return grid_.first_range_m + (static_cast<double>(range) + 0.5) * grid_.range_step_m;
  }
  [[nodiscard]] radar::Echo unit_echo(std::size_t range, float sin_depression) const;
  [[nodiscard]] Place place_of(std::size_t range) const;

  radar::RangeAzimuthGrid grid_;
  receiver::EchoPlaces places_;
  float part_heard_;
  std::vector<Place> places_of_ranges_;
};

/// Azimuth of the middle of a beam.
[[nodiscard]] inline double middle_rad(const radar::RangeAzimuthGrid& grid, std::size_t beam) {
  return grid.first_azimuth_rad + (static_cast<double>(beam) + 0.5) * grid.azimuth_step_rad;
}

/// Where the last range of a grid ends.
[[nodiscard]] inline double last_range_m(const radar::RangeAzimuthGrid& grid) {
  return grid.first_range_m + static_cast<double>(grid.ranges) * grid.range_step_m;
}

/// Throws Error for a radar whose frequency is more than a hundredth from the frame's: neither the ground's
/// cross-sections nor the targets' are those of another.
void check_frequency(const Frame& frame, const radar::Radar& radar);

/// The radar, whatever images its mode would make: frames are what a beam sees that goes round.
[[nodiscard]] radar::Radar that_scans(radar::Radar radar);

/// From where on targets are heard unless the radar says so: half a bin before the first range, as far as the first
/// bins hold them.
[[nodiscard]] double targets_heard_from_m(const radar::RangeAzimuthGrid& grid);
/// A radar that hears them from there on.
[[nodiscard]] radar::Radar hearing_first_bins(radar::Radar radar, const radar::RangeAzimuthGrid& grid);

/// What a beam of a frame holds besides targets, [range]: `number_of(channels)` of each bin. Where a bin is told
/// several times the first that was told counts, and is put in last.
template <typename Number, typename NumberOf>
void ground_of_beam(const Frame& frame, std::size_t beam, NumberOf&& number_of, std::span<Number> held) {
  const std::size_t first = beam * frame.grid.ranges;
  for (std::size_t range = 0; range < held.size(); ++range) held[range] = number_of(power_of_bin(frame, first + range));
  const auto told = receiver::of_beams(frame.targets, beam, 1, frame.grid.ranges).bins;
  for (auto one = told.rbegin(); one != told.rend(); ++one) held[one->bin - first] = number_of(one->rcs_m2);
}

}  // namespace sigmascape::live
