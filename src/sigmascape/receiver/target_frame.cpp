#include "sigmascape/receiver/target_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/receiver/carrier_phase.h"

namespace sigmascape::receiver {
namespace {

/// Targets that one thread looks at before it takes more.
constexpr std::size_t chunk = 256;
/// How many targets ahead bins are fetched from memory.
constexpr std::uint32_t targets_ahead = 16;

/// What a bin of a frame holds, and what a target brings to it.
struct Amplitudes {
  static constexpr std::size_t numbers = 8;
  template <typename Placed>
  static std::array<float, numbers> of(const Placed& point, float weight) {
    const auto& a = point.amplitude_m;
    return {a[0] * weight, a[1] * weight, a[2] * weight, a[3] * weight,
            a[4] * weight, a[5] * weight, a[4] * weight, a[5] * weight};
  }
  static std::span<const float> weights(const PointResponse& response, std::size_t row) {
    return response.amplitude(row);
  }
  static radar::Channels power_in(const float* bin) {
    return radar::power_of({{bin[0], bin[1]}, {bin[2], bin[3]}, {bin[4], bin[5]}});
  }
};
struct Powers {
  static constexpr std::size_t numbers = 4;
  template <typename Placed>
  static std::array<float, numbers> of(const Placed& point, float weight) {
    const auto& p = point.power_m2;
    return {p[0] * weight, p[1] * weight, p[2] * weight, p[3] * weight};
  }
  static std::span<const float> weights(const PointResponse& response, std::size_t row) { return response.power(row); }
  static radar::Channels power_in(const float* bin) { return {bin[0], bin[1], bin[2], bin[3]}; }
};

/// The angle to a place so far ahead and to the right, to 1e-8 of a radian: that of the library is as good as double
/// and takes three times as long.
double angle_of(double ahead_m, double right_m, double distance_m) {
  if (!(ahead_m > 0.0)) return std::atan2(right_m, ahead_m);
  // Tangents of the half and of the quarter of it, which is at most 22.5°, and the series from there.
  const double half = right_m / (distance_m + ahead_m), quarter = half / (1.0 + std::sqrt(1.0 + half * half));
  const double q2 = quarter * quarter;
  double series = 1.0 / 17.0;
  for (const double odd : {15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0}) series = 1.0 / odd - q2 * series;
  return 4.0 * quarter * series;
}

}  // namespace

TargetFrame::TargetFrame(TargetFrameBins bins)
    : bins_(std::move(bins)),
      goes_round_(radar::goes_round(bins_.beams, bins_.beam_step_rad)),
      ranges_per_m_(1.0 / bins_.range_step_m),
      beams_per_rad_(1.0 / bins_.beam_step_rad),
      starts_(bins_.beams + bins_.across.taps()),
      by_beam_(bins_.ranges),
      next_kept_(bins_.beams),
      kept_end_(bins_.beams) {}

/// `middle`: unit vector over the ground to the middle of the frame.
TargetFrame::Placed TargetFrame::placed(const radar::Target& target, const TargetFramePose& pose, Vec2d middle,
                                        const radar::Moment& moment, const Sight& sight) const {
  Placed found{};
  const Vec3d position = target.track.position_at(moment.time_s);
  const Vec3d away = position - pose.position;
  const double distance_m = std::sqrt(away.x * away.x + away.y * away.y);
  const double range_m = pose.earth.slant_range_m(pose.position.z, position.z, distance_m);
  const double range = (range_m - pose.first_range_m) * ranges_per_m_;
  const auto farthest_taps = static_cast<double>(PointResponse::most_taps);
  if (!(range > -farthest_taps && range < static_cast<double>(bins_.ranges) + farthest_taps)) return found;

  // Azimuths are counted from the middle of the frame, so that none is a turn away.
  const double beam =
      0.5 * static_cast<double>(bins_.beams) +
      angle_of(away.x * middle.x + away.y * middle.y, away.x * middle.y - away.y * middle.x, distance_m) *
          beams_per_rad_;
  const PointResponse::Place across = bins_.across.place_of(beam), along = bins_.along.place_of(range);
  const auto lies_within = [](const PointResponse& response, const PointResponse::Place& place, std::size_t bins) {
    return place.first_bin > -static_cast<std::ptrdiff_t>(response.taps()) &&
           place.first_bin < static_cast<std::ptrdiff_t>(bins);
  };
  if (!lies_within(bins_.across, across, bins_.beams) || !lies_within(bins_.along, along, bins_.ranges)) return found;

  const float seen = sight ? sight({position, distance_m, beam}) : 1.0F;
  if (!(seen > 0.0F)) return found;
  const radar::Channels rcs = radar::rcs_of(target, pose.position, bins_.frequency_hz, moment, pose.earth) * seen;
  // How flatly the radar is met from there, for rays go both ways alike.
  const double sin_elevation = pose.earth.sin_grazing(position.z, pose.position.z, distance_m);
  const radar::ComplexChannels amplitude =
      radar::steady_amplitude(rcs) * carrier_phase(range_m, wavelength_m(bins_.frequency_hz));
  return {.amplitude_m = {amplitude.vv.real(), amplitude.vv.imag(), amplitude.hh.real(), amplitude.hh.imag(),
                          amplitude.hv.real(), amplitude.hv.imag()},
          .power_m2 = {rcs.vv, rcs.hh, rcs.hv, rcs.re_vvhh},
          .first_beam = static_cast<std::int32_t>(across.first_bin),
          .first_range = static_cast<std::int32_t>(along.first_bin),
          .beams_on = static_cast<float>(beam - static_cast<double>(across.first_bin)),
          .ranges_on = static_cast<float>(range - static_cast<double>(along.first_bin)),
          .sin_depression = static_cast<float>(-sin_elevation),
          .beam_row = static_cast<std::uint16_t>(across.row),
          .range_row = static_cast<std::uint16_t>(along.row)};
}

void TargetFrame::look(std::span<const radar::Target> targets, const TargetFramePose& pose, const radar::Moment& moment,
                       const Sight& sight, WorkerTeam* team) {
  found_.resize(targets.size());
  std::ranges::fill(next_kept_, 0U);
  std::ranges::fill(kept_end_, 0U);
  first_azimuth_rad_ = pose.first_azimuth_rad;
  first_range_m_ = pose.first_range_m;
  const double middle_rad = pose.first_azimuth_rad + 0.5 * static_cast<double>(bins_.beams) * bins_.beam_step_rad;
  const Vec2d middle{std::sin(middle_rad), std::cos(middle_rad)};
  const auto look_at = [&](std::size_t part, unsigned) {
    const std::size_t end = std::min(targets.size(), (part + 1) * chunk);
    for (std::size_t i = part * chunk; i < end; ++i) found_[i] = placed(targets[i], pose, middle, moment, sight);
  };
  const std::size_t parts = (targets.size() + chunk - 1) / chunk;
  if (team != nullptr) {
    team->run(parts, look_at);
  } else {
    for (std::size_t part = 0; part < parts; ++part) look_at(part, 0);
  }
  sort();
}

void TargetFrame::sort() {
  const auto slot_of = [before = static_cast<std::ptrdiff_t>(bins_.across.taps()) - 1](const Placed& point) {
    return static_cast<std::size_t>(point.first_beam + before);
  };
  std::ranges::fill(starts_, 0U);
  for (const Placed& point : found_) {
    if (point.is_seen()) ++starts_[slot_of(point) + 1];
  }
  for (std::size_t slot = 1; slot < starts_.size(); ++slot) starts_[slot] += starts_[slot - 1];
  sorted_.resize(starts_.back());
  // Filling moves every start to the next one's place; the last step moves them back.
  for (const Placed& point : found_) {
    if (point.is_seen()) sorted_[starts_[slot_of(point)]++] = point;
  }
  std::shift_right(starts_.begin(), starts_.end(), 1);
  starts_.front() = 0;
}

std::uint32_t TargetFrame::sharing(std::size_t beam) const {
  const auto taps = static_cast<std::ptrdiff_t>(bins_.across.taps()), beams = static_cast<std::ptrdiff_t>(bins_.beams);
  // Of targets whose first beam is one of those.
  const auto between = [&](std::ptrdiff_t first, std::ptrdiff_t last) {
    first = std::max(first, 1 - taps);
    last = std::min(last, beams - 1);
    if (first > last) return 0U;
    return starts_[static_cast<std::size_t>(last + taps)] - starts_[static_cast<std::size_t>(first + taps - 1)];
  };
  const auto here = static_cast<std::ptrdiff_t>(beam);
  const std::uint32_t straight_on = between(here - taps + 1, here);
  if (!goes_round_) return straight_on;
  return straight_on + between(here - taps + 1 - beams, here - beams) + between(here - taps + 1 + beams, here + beams);
}

void TargetFrame::tell_apart(std::size_t first_beam, std::size_t count) {
  std::uint32_t echoes = 0;
  for (std::size_t beam = first_beam; beam < first_beam + count; ++beam) {
    next_kept_[beam] = echoes;
    echoes += sharing(beam);
    kept_end_[beam] = echoes;
  }
  // As many again of beams that stay as they are: others may have stood there.
  const std::size_t taps = bins_.along.taps(), most = 2 * found_.size() * bins_.across.taps();
  by_beam_.reserve(most, most * taps);
  room_ = by_beam_.renewed(first_beam, count, echoes, echoes * taps);
}

template <typename Content>
void TargetFrame::keep(const Placed& point, std::size_t tap, std::size_t beam, const float* row) {
  if (next_kept_[beam] == kept_end_[beam]) return;
  const std::size_t number = next_kept_[beam]++;
  const std::span<const float> along = bins_.along.power(point.range_row);
  const auto ranges = static_cast<std::ptrdiff_t>(bins_.ranges);
  float held = 0.0F;
  for (std::size_t k = 0; k < along.size(); ++k) {
    const std::ptrdiff_t range = point.first_range + static_cast<std::ptrdiff_t>(k);
    // In place of one beyond the ends the last one: it is there twice.
    const auto within = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(range, 0, ranges - 1));
    if (range >= 0 && range < ranges) held += along[k];
    room_.bins[number * along.size() + k] = {.bin = static_cast<std::uint32_t>(beam * bins_.ranges + within),
                                             .rcs_m2 = Content::power_in(row + within * Content::numbers)};
  }
  const auto& p = point.power_m2;
  room_.echoes[number] = {
      .beam = static_cast<std::uint32_t>(beam),
      .echo = {
          .range_m = first_range_m_ + (point.first_range + static_cast<double>(point.ranges_on)) * bins_.range_step_m,
          .cross = first_azimuth_rad_ + (point.first_beam + static_cast<double>(point.beams_on)) * bins_.beam_step_rad,
          .rcs_m2 = radar::Channels{p[0], p[1], p[2], p[3]} * (held * bins_.across.power(point.beam_row)[tap]),
          .bounces = 1,
          .sin_depression = point.sin_depression}};
}

template <typename Content>
void TargetFrame::add(std::size_t first_beam, std::size_t count, float* frame) {
  const auto taps = static_cast<std::ptrdiff_t>(bins_.across.taps()), beams = static_cast<std::ptrdiff_t>(bins_.beams);
  const auto range_taps = static_cast<std::ptrdiff_t>(bins_.along.taps());
  const auto ranges = static_cast<std::ptrdiff_t>(bins_.ranges);
  constexpr auto numbers = static_cast<std::ptrdiff_t>(Content::numbers);
  const auto begin = static_cast<std::ptrdiff_t>(first_beam), end = static_cast<std::ptrdiff_t>(first_beam + count);

  // Those of one beam after the other, each into its rows from `first` on.
  const auto add_from = [&](std::size_t slot, std::ptrdiff_t first) {
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, begin - first), to = std::min(taps, end - first);
    if (from >= to) return;
    for (std::uint32_t i = starts_[slot]; i < starts_[slot + 1]; ++i) {
      const Placed& point = sorted_[i];
      const Placed& next = sorted_[std::min<std::size_t>(i + targets_ahead, sorted_.size() - 1)];
      const std::ptrdiff_t next_range = std::clamp<std::ptrdiff_t>(next.first_range, 0, ranges - 1);
      const std::span<const float> across = Content::weights(bins_.across, point.beam_row);
      const std::span<const float> along = Content::weights(bins_.along, point.range_row);
      const std::ptrdiff_t near = std::max<std::ptrdiff_t>(0, -point.first_range);
      const std::ptrdiff_t far = std::min<std::ptrdiff_t>(range_taps, ranges - point.first_range);
      for (std::ptrdiff_t tap = from; tap < to; ++tap) {
        float* const row = frame + (first + tap) * ranges * numbers;
        const std::ptrdiff_t next_row = std::clamp<std::ptrdiff_t>(next.first_beam + tap, 0, beams - 1);
        const float* const soon = frame + (next_row * ranges + next_range) * numbers;
        __builtin_prefetch(soon, 1);
        __builtin_prefetch(soon + 16, 1);
        keep<Content>(point, static_cast<std::size_t>(tap), static_cast<std::size_t>(first + tap), row);
        const auto shares = Content::of(point, across[static_cast<std::size_t>(tap)]);
        for (std::ptrdiff_t k = near; k < far; ++k) {
          float* const bin = row + (point.first_range + k) * numbers;
          const float weight = along[static_cast<std::size_t>(k)];
          for (std::size_t n = 0; n < Content::numbers; ++n) bin[n] += shares[n] * weight;
        }
      }
    }
  };
  for (std::ptrdiff_t first = 1 - taps; first < beams; ++first) {
    const auto slot = static_cast<std::size_t>(first + taps - 1);
    add_from(slot, first);
    if (!goes_round_) continue;
    // What begins before the first beam ends in the last ones, and what begins in the last ones ends in the first.
    if (first < 0) add_from(slot, first + beams);
    if (first + taps > beams) add_from(slot, first - beams);
  }
}

void TargetFrame::add_amplitudes(std::size_t first_beam, std::size_t count,
                                 std::span<std::complex<float>> amplitudes_m) {
  add<Amplitudes>(first_beam, count, reinterpret_cast<float*>(amplitudes_m.data()));
}

void TargetFrame::add_powers(std::size_t first_beam, std::size_t count, std::span<float> powers_m2) {
  add<Powers>(first_beam, count, powers_m2.data());
}

}  // namespace sigmascape::receiver
