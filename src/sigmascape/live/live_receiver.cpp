#include "sigmascape/live/live_receiver.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/live/ground_along.h"
#include "sigmascape/live/line_sums.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/radar/radar_title.h"

namespace sigmascape::live {
namespace {

/// A gain in elevation takes as long as so many products in a response.
constexpr std::size_t operations_to_weigh = 500;
/// No beam that is heard has that number.
constexpr std::uint64_t never_heard = DrawnBeam::unfinished;

}  // namespace

receiver::ReceivedPower received_power(const HeardPower& heard) {
  const radar::RangeAzimuthGrid& grid = heard.grid;
  receiver::ReceivedPower power{grid, Array2D<float>(grid.azimuths, grid.ranges), heard.noise_w};
  for (std::size_t range = 0; range < grid.ranges; ++range) {
    for (std::size_t beam = 0; beam < grid.azimuths; ++beam)
      power.signal_w(beam, range) = heard.signal_w[beam * grid.ranges + range];
  }
  return power;
}

LiveReceiver::Responses::Responses(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid)
    : range_step_m(grid.range_step_m),
      azimuth_step_rad(grid.azimuth_step_rad),
      compression_gain(radar::compression_gain(radar)),
      along(receiver::range_response(radar, grid.range_step_m)),
      across(receiver::azimuth_response(radar, grid.azimuth_step_rad)),
      point_along(receiver::placed_range_response(radar, grid.range_step_m)),
      point_across(receiver::placed_azimuth_response(radar, grid.azimuth_step_rad)),
      ground(radar, grid),
      targets(ground.places()) {
  targets.move_to(grid, targets_heard_from_m(grid));
}

void LiveReceiver::Responses::move_to(const radar::RangeAzimuthGrid& grid) {
  ground.move_to(grid);
  targets.move_to(grid, targets_heard_from_m(grid));
}

LiveReceiver::LiveReceiver(radar::Radar radar, radar::Polarization polarization, KeptGround ground, unsigned threads)
    : radar_(that_scans(std::move(radar))), polarization_(polarization), ground_(std::move(ground)), team_(threads) {
  receiver::check_receivable(polarization_);
  if (!ground_.is_known() && !radar::antenna_pattern(radar_).elevation().even()) {
    throw Error(radar::title_of(radar_), "has an antenna that tells elevations apart, which bins do not",
                "give the ground that they lie on too, or an antenna that is even in elevation");
  }
  heard_.noise_w = radar::noise_power_w(radar_);
  scratch_.resize(team_.size());
}

const HeardPower& LiveReceiver::hear(const Frame& frame) {
  check_holds(frame, "live receiver");
  check_frequency(frame, radar_);
  if (!has_bins_ || frame.grid != grid_) {
    has_bins_ = false;
    take_bins(frame.grid);
  }
  has_bins_ = false;  // until all beams that were drawn are as they should be
  if (responses_->ground.places().tell_elevations_apart()) {
    const Vec3d radar = drawn_last(frame.beams).radar;
    ground_.cover(grid_, {radar.x, radar.y}, frame.earth);
  }
  const Beams drawn = drawn_since(frame);
  hear_ground(frame, drawn);
  const Beams changed = with_beside(drawn, std::max(responses_->ground_reach(), responses_->target_reach()));
  place_targets(frame, with_beside(changed, responses_->target_reach()));
  run(changed.count, grid_.ranges * responses_->across.weights.size(),
      [&](std::size_t index, Scratch& scratch) { lay_over(frame, (changed.first + index) % grid_.azimuths, scratch); });
  heard_.grid = grid_;
  heard_.signal_w = *signal_w_;
  heard_.first_changed = changed.first;
  heard_.changed = changed.count;
  has_bins_ = true;
  return heard_;
}

LiveReceiver::Beams LiveReceiver::drawn_since(const Frame& frame) const {
  const std::size_t all = grid_.azimuths;
  const auto is_new = [&](std::size_t beam) {
    return heard_drawings_[beam] != frame.beams[beam].drawing ||
           (weighed_from_[beam] && ground_.knows_better(weighed_from_[beam]->window));
  };
  std::size_t first = 0;
  while (first < all && !is_new(first)) ++first;
  if (first == all) return {};
  if (!grid_.goes_round()) {
    std::size_t last = all - 1;
    while (!is_new(last)) --last;
    return {first, last - first + 1};
  }
  // All beams of the turn but the longest row of those that have been heard.
  Beams drawn{first, all};
  std::size_t heard = 0;
  for (std::size_t step = 1; step <= all; ++step) {
    const std::size_t beam = (first + step) % all;
    if (!is_new(beam)) {
      ++heard;
      continue;
    }
    if (all - heard < drawn.count) drawn = {beam, all - heard};
    heard = 0;
  }
  return drawn;
}

LiveReceiver::Beams LiveReceiver::over_one_window(const Frame& frame, Beams beams) {
  if (!responses_->ground.places().tell_elevations_apart()) return beams;
  std::optional<Vec3d> covered;
  std::size_t count = 0;
  for (; count < beams.count; ++count) {
    const DrawnBeam& beam = frame.beams[(beams.first + count) % grid_.azimuths];
    const Vec3d radar = beam.radar;
    if (beam.drawing == 0 || radar == covered) continue;
    if (covered && !ground_.covers(grid_, {radar.x, radar.y}, frame.earth)) break;
    if (!covered) ground_.cover(grid_, {radar.x, radar.y}, frame.earth);
    covered = radar;
  }
  return {beams.first, count};
}

bool LiveReceiver::is_to_be_weighed(const Frame& frame, std::size_t beam) const {
  return responses_->ground.places().tell_elevations_apart() && frame.beams[beam].drawing != 0 &&
         weighed_from_[beam] != weighed_from_now(frame, beam);
}

void LiveReceiver::hear_ground(const Frame& frame, Beams beams) {
  while (beams.count > 0) {
    const Beams together = over_one_window(frame, beams);
    bool weighs = false;
    for_each(together, [&](std::size_t beam) { weighs |= is_to_be_weighed(frame, beam); });
    run(together.count, grid_.ranges * (responses_->along.weights.size() + (weighs ? operations_to_weigh : 0)),
        [&](std::size_t index, Scratch& scratch) {
          const std::size_t beam = (together.first + index) % grid_.azimuths;
          if (is_to_be_weighed(frame, beam)) weigh(frame, beam);
          hear_ground(frame, beam, scratch);
          heard_drawings_[beam] = frame.beams[beam].drawing;
        });
    beams = {(beams.first + together.count) % grid_.azimuths, beams.count - together.count};
  }
}

void LiveReceiver::take_bins(const radar::RangeAzimuthGrid& grid) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  if (!responses_ || responses_->range_step_m != grid.range_step_m ||
      responses_->azimuth_step_rad != grid.azimuth_step_rad) {
    responses_.emplace(radar_, grid);
  } else {
    responses_->move_to(grid);
  }
  const receiver::EchoPlaces& places = responses_->ground.places();
  const bool is_as_many = grid.azimuths == grid_.azimuths && grid.ranges == grid_.ranges;
  grid_ = grid;
  factors_.resize(grid.ranges);
  const double bins_of_a_point = responses_->along.peak_bins * responses_->across.peak_bins;
  receiver::find_watts_per_m2(radar_, grid, responses_->compression_gain, bins_of_a_point, factors_);
  watts_per_m2_.resize(grid.ranges);
  for (std::size_t range = 0; range < grid.ranges; ++range)
    watts_per_m2_[range] = places.is_within_gate(range) ? static_cast<float>(factors_[range]) : nan;
  heard_drawings_.assign(grid.azimuths, never_heard);
  weighed_from_.assign(grid.azimuths, std::nullopt);
  looked_at_.resize(grid.azimuths);
  for (std::size_t beam = 0; beam < grid.azimuths; ++beam)
    looked_at_[beam] = receiver::looked_at(radar_, grid, beam) ? 1 : 0;

  const std::size_t bins = grid.azimuths * grid.ranges;
  lines_.resize(bins);
  // Others may look at it still.
  if (signal_w_ == nullptr || !is_as_many) signal_w_ = std::make_shared<std::vector<float>>(bins);
  dark_.resize(grid.azimuths);
  if (places.tell_elevations_apart()) {
    weights_.resize(bins);
  } else {
    weights_.resize(grid.ranges);
    responses_->ground.weigh_evenly(weights_);
  }
  for (Scratch& scratch : scratch_) {
    scratch.held.resize(grid.ranges);
    scratch.heard.assign(grid.ranges + responses_->along.weights.size() - 1, 0.0F);
    scratch.targets.resize(grid.ranges);
  }
}

LiveReceiver::Beams LiveReceiver::with_beside(Beams beams, std::size_t reach) const {
  const std::size_t all = grid_.azimuths;
  if (beams.count == 0) return beams;
  if (!grid_.goes_round()) {
    const std::size_t first = beams.first - std::min(beams.first, reach);
    return {first, std::min(beams.first + beams.count + reach, all) - first};
  }
  if (beams.count + 2 * reach >= all) return {0, all};
  return {(beams.first + all - reach) % all, beams.count + 2 * reach};
}

template <typename Body>
void LiveReceiver::for_each(Beams beams, Body&& body) const {
  for (std::size_t index = 0; index < beams.count; ++index) body((beams.first + index) % grid_.azimuths);
}

std::span<const float> LiveReceiver::weights_of(std::size_t beam) const {
  if (!responses_->ground.places().tell_elevations_apart()) return weights_;
  return std::span(weights_).subspan(beam * grid_.ranges, grid_.ranges);
}

void LiveReceiver::weigh(const Frame& frame, std::size_t beam) {
  const WeighedFrom from = weighed_from_now(frame, beam);
  const auto weights = std::span(weights_).subspan(beam * grid_.ranges, grid_.ranges);
  ground_.with_height([&](const auto& height_m) {
    GroundAlong along(from.position, middle_rad(grid_, beam), last_range_m(grid_), height_m, frame.earth);
    responses_->ground.weigh([&](double range_m) { return along.sin_depression(range_m); }, weights);
  });
  weighed_from_[beam] = from;
}

void LiveReceiver::hear_ground(const Frame& frame, std::size_t beam, Scratch& scratch) {
  const auto of_polarization = [this](const radar::Channels& bin) { return bin.power(polarization_); };
  ground_of_beam(frame, beam, of_polarization, std::span(scratch.held));
  const std::vector<float>& along = responses_->along.weights;
  const auto heard = std::span(scratch.heard).subspan(along.size() / 2, grid_.ranges);
  responses_->ground.hear<float>(scratch.held, weights_of(beam), heard);
  dark_[beam] = std::ranges::all_of(heard, [](float rcs_m2) { return rcs_m2 == 0.0F; }) ? 1 : 0;
  if (dark_[beam] == 0) weigh_neighbours(scratch.heard.data(), along, line_of(beam));
}

void LiveReceiver::place_targets(const Frame& frame, Beams beams) {
  constexpr std::size_t operations_each = 64;
  echoes_.resize(frame.targets.echoes.size());
  if (echoes_.empty()) return;
  run(beams.count, operations_each * echoes_.size() / grid_.azimuths, [&](std::size_t index, Scratch&) {
    const std::size_t beam = (beams.first + index) % grid_.azimuths;
    const auto of_beam = receiver::of_beams(frame.targets, beam, 1, grid_.ranges).echoes;
    const auto first = static_cast<std::size_t>(of_beam.data() - frame.targets.echoes.data());
    for (std::size_t i = 0; i < of_beam.size(); ++i) place(of_beam[i], echoes_[first + i]);
  });
}

void LiveReceiver::place(const receiver::EchoInBeam& echo, PlacedEcho& placed) const {
  placed.rcs_m2 = 0.0F;
  const auto heard = responses_->targets.heard(echo.echo);
  if (!heard) return;
  placed = {.across = responses_->point_across.at(responses_->targets.column_of(echo.echo.cross)),
            .along = responses_->point_along.at(heard->row),
            .rcs_m2 = heard->rcs_m2.power(polarization_)};
}

void LiveReceiver::lay_over(const Frame& frame, std::size_t beam, Scratch& scratch) {
  const auto signal_w = std::span(*signal_w_).subspan(beam * grid_.ranges, grid_.ranges);
  if (looked_at_[beam] == 0) {
    std::ranges::fill(signal_w, std::numeric_limits<float>::quiet_NaN());
    return;
  }
  std::ranges::fill(signal_w, 0.0F);
  const std::vector<float>& across = responses_->across.weights;
  const auto reach = static_cast<std::ptrdiff_t>(responses_->ground_reach());
  const auto all = static_cast<std::ptrdiff_t>(grid_.azimuths);
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    std::ptrdiff_t from = static_cast<std::ptrdiff_t>(beam) + k;
    if (grid_.goes_round())
      from = ((from % all) + all) % all;
    else if (from < 0 || from >= all)
      continue;
    const auto of = static_cast<std::size_t>(from);
    if (dark_[of] == 0) add_weighted(line_of(of).data(), across[static_cast<std::size_t>(k + reach)], signal_w);
  }
  // By themselves, lest many weak ones be rounded to nothing beside bright ground.
  const std::span<float> targets(scratch.targets);
  if (!echoes_.empty()) {
    std::ranges::fill(targets, 0.0F);
    add_targets(frame, beam, targets);
    add_weighted(targets.data(), 1.0F, signal_w);
  }
  for (std::size_t range = 0; range < grid_.ranges; ++range) signal_w[range] *= watts_per_m2_[range];
}

void LiveReceiver::add_targets(const Frame& frame, std::size_t beam, std::span<float> sums) const {
  for_each(with_beside({beam, 1}, responses_->target_reach()), [&](std::size_t from) {
    const auto of_beam = receiver::of_beams(frame.targets, from, 1, grid_.ranges).echoes;
    const auto first = static_cast<std::size_t>(of_beam.data() - frame.targets.echoes.data());
    for (std::size_t i = 0; i < of_beam.size(); ++i) add_target(echoes_[first + i], beam, sums);
  });
}

void LiveReceiver::add_target(const PlacedEcho& echo, std::size_t beam, std::span<float> sums) const {
  if (!(echo.rcs_m2 > 0.0F)) return;
  const receiver::PlacedResponseTable& point_across = responses_->point_across;
  const receiver::PlacedResponseTable& point_along = responses_->point_along;
  const auto all = static_cast<std::ptrdiff_t>(grid_.azimuths), bins = static_cast<std::ptrdiff_t>(grid_.ranges);
  const auto taps_across = static_cast<std::ptrdiff_t>(point_across.taps()),
             taps_along = static_cast<std::ptrdiff_t>(point_along.taps());
  std::ptrdiff_t tap = static_cast<std::ptrdiff_t>(beam) - echo.across.first_bin;
  if (grid_.goes_round()) tap = ((tap % all) + all) % all;
  float rcs_m2 = 0.0F;
  // Round a turn of few beams more than once.
  for (; tap >= 0 && tap < taps_across; tap += grid_.goes_round() ? all : taps_across)
    rcs_m2 += echo.rcs_m2 * point_across.weight(echo.across, static_cast<std::size_t>(tap));
  if (rcs_m2 == 0.0F) return;
  const std::ptrdiff_t first = echo.along.first_bin;
  const std::ptrdiff_t near = std::clamp<std::ptrdiff_t>(-first, 0, taps_along),
                       far = std::clamp<std::ptrdiff_t>(bins - first, 0, taps_along);
  if (near >= far) return;
  const auto to = sums.subspan(static_cast<std::size_t>(first + near), static_cast<std::size_t>(far - near));
  add_weighted(point_along.lower(echo.along).data() + near, rcs_m2 * (1.0F - echo.along.part), to);
  add_weighted(point_along.upper(echo.along).data() + near, rcs_m2 * echo.along.part, to);
}

template <typename Body>
void LiveReceiver::run(std::size_t count, std::size_t operations_each, Body&& body) {
  constexpr std::size_t worth_waking = 1'000'000;
  if (count * operations_each < worth_waking) {
    for (std::size_t index = 0; index < count; ++index) body(index, scratch_[0]);
  } else {
    team_.run(count, [&](std::size_t index, unsigned worker) { body(index, scratch_[worker]); });
  }
}

}  // namespace sigmascape::live
