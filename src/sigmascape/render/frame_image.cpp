#include "sigmascape/render/frame_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <memory>
#include <ranges>
#include <span>
#include <tuple>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/distance_of_range.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/receiver/bin_response.h"
#include "sigmascape/receiver/echo_places.h"
#include "sigmascape/receiver/response_spread.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/render/frame_reach.h"
#include "sigmascape/terrain/terrain_view.h"
#include "sigmascape/terrain/terrain_window.h"

namespace sigmascape::render {
namespace {

constexpr std::size_t most_nodes_a_side = 2048;

/// How far below a radar the ground lies along one azimuth, at growing slant ranges.
class GroundAlong {
 public:
  GroundAlong(Vec3d radar, double azimuth_rad, const GroundHeight& ground, const radar::CurvedEarth& earth)
      : radar_(radar),
        foot_{radar.x, radar.y},
        outwards_(radar::horizontal_direction(azimuth_rad)),
        ground_(ground),
        earth_(earth),
        here_(nearest()) {}

  /// As of radar::Echo. Where ground lies over other ground any of its places will do: they differ by no more than
  /// their heights over the range.
  double sin_depression(double range_m) {
    here_ = next(here_, range_m);
    // The law of cosines over the enlarged Earth (docs/physics/curved_earth.md, Eq. (4)), solved for the angle at the
    // radar.
    const double c = earth_.curvature_per_m(), above_m = radar_.z - here_.height_m;
    const double sine = (c * here_.range_m * here_.range_m + above_m * (2.0 + c * (radar_.z + here_.height_m))) /
                        (2.0 * range_m * (1.0 + c * radar_.z));
    return std::clamp(sine, -1.0, 1.0);
  }

 private:
  static constexpr double near_enough_m = 1e-3;

  /// On the ground.
  struct Place {
    double distance_m, height_m, range_m;
  };

  [[nodiscard]] Place at(double distance_m) const {
    const double height_m = ground_(foot_ + outwards_ * distance_m);
    return {distance_m, height_m, earth_.slant_range_m(radar_.z, height_m, distance_m)};
  }

  /// Where the ground is nearest: straight below, unless it rises ahead by more than it recedes.
  [[nodiscard]] Place nearest() const {
    constexpr int places = 64;
    const Place below = at(0.0);
    Place nearest = below;
    for (int number = 1; number < places; ++number) {
      const Place there = at(below.range_m * number / places);
      if (there.range_m < nearest.range_m) nearest = there;
    }
    return nearest;
  }

  /// A place of that range beyond one of less; that one where it is no less. However steep the ground, one lies between
  /// it and whatever is farther away, whereas height and distance found from each other in turn run off at steep looks.
  [[nodiscard]] Place next(Place near, double wanted_m) const {
    if (near.range_m >= wanted_m) return near;
    Place far = at(std::max(radar::distance_of_range_m(earth_, radar_.z, near.height_m, wanted_m),
                            near.distance_m + near_enough_m));
    // Along the sea half a circle is the longest way between two points, and less than twice their range.
    for (double step_m = far.distance_m - near.distance_m;
         far.range_m < wanted_m - near_enough_m && far.distance_m < 2.0 * wanted_m; step_m *= 2.0) {
      near = far;
      far = at(far.distance_m + 2.0 * step_m);
    }
    return between(near, far, wanted_m);
  }

  /// Regula falsi in its Illinois form.
  [[nodiscard]] Place between(const Place& near, const Place& far, double wanted_m) const {
    constexpr int most_steps = 40;
    double near_m = near.distance_m, far_m = far.distance_m;
    // By how much the two are farther away than is wanted.
    double near_by_m = near.range_m - wanted_m, far_by_m = far.range_m - wanted_m;
    if (far_by_m < near_enough_m) return far;
    int last_side = 0;
    for (int step = 0; step < most_steps && far_m - near_m > near_enough_m; ++step) {
      const Place middle = at((near_m * far_by_m - far_m * near_by_m) / (far_by_m - near_by_m));
      const double middle_by_m = middle.range_m - wanted_m;
      if (std::abs(middle_by_m) < near_enough_m) return middle;
      const int side = middle_by_m > 0.0 ? 1 : -1;
      (side > 0 ? far_m : near_m) = middle.distance_m;
      (side > 0 ? far_by_m : near_by_m) = middle_by_m;
      if (side == last_side) (side > 0 ? near_by_m : far_by_m) *= 0.5;
      last_side = side;
    }
    return at(0.5 * (near_m + far_m));
  }

  Vec3d radar_;
  Vec2d foot_, outwards_;
  const GroundHeight& ground_;
  const radar::CurvedEarth& earth_;
  Place here_;  // of the range before, where the search for the next begins
};

radar::RangeAzimuthImage dark_image(const Frame& frame, const Pose& pose) {
  return {frame.grid, pose.position, Array2D<radar::Channels>(frame.grid.azimuths, frame.grid.ranges)};
}

/// Puts `put(beam, range)` into every bin, for some beams together: they lie side by side in an image, and in a
/// frame one after the other.
template <typename Put>
void for_each_bin(radar::RangeAzimuthImage& image, Put&& put) {
  constexpr std::size_t together = 8;
  const radar::RangeAzimuthGrid& grid = image.grid;
  for (std::size_t first = 0; first < grid.azimuths; first += together) {
    const std::size_t end = std::min(first + together, grid.azimuths);
    for (std::size_t range = 0; range < grid.ranges; ++range) {
      for (std::size_t beam = first; beam < end; ++beam) image.rcs_m2(beam, range) = put(beam, range);
    }
  }
}

/// What is not targets, [beam][range]. Where a bin is told several times the first that was told is put in last.
std::vector<radar::Channels> without_targets(const Frame& frame) {
  std::vector<radar::Channels> bins(frame.grid.azimuths * frame.grid.ranges);
  for (std::size_t bin = 0; bin < bins.size(); ++bin) bins[bin] = power_of_bin(frame, bin);
  for (const auto& [bin, rcs_m2] : frame.targets.bins | std::views::reverse) bins[bin] = rcs_m2;
  return bins;
}

/// Of targets, each once: what two beams of a step hold of one is put together again.
std::vector<radar::Echo> echoes_of(const receiver::TargetsApart& targets) {
  std::vector<radar::Echo> echoes;
  echoes.reserve(targets.echoes.size());
  for (const receiver::EchoInBeam& of_beam : targets.echoes) echoes.push_back(of_beam.echo);
  const auto place = [](const radar::Echo& echo) { return std::tuple(echo.range_m, echo.cross, echo.sin_depression); };
  std::ranges::stable_sort(echoes, {}, place);
  std::size_t count = 0;
  for (const radar::Echo& echo : echoes) {
    if (count > 0 && place(echoes[count - 1]) == place(echo))
      echoes[count - 1].rcs_m2 += echo.rcs_m2;
    else
      echoes[count++] = echo;
  }
  echoes.resize(count);
  return echoes;
}

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

/// As receiver::RangeAzimuthReceiver hears echoes before their responses are laid over the bins, one from the middle of
/// each bin. `bins`, [beam][range], becomes what is heard. `ground_along(azimuth_rad)` gives how far below the radar,
/// at growing ranges, they are.
template <typename GroundAlongAzimuth>
void hear(std::vector<radar::Channels>& bins, const radar::RangeAzimuthGrid& grid, const receiver::EchoPlaces& places,
          float part_heard, GroundAlongAzimuth&& ground_along) {
  constexpr double in_place = 1e-6;  // in bins; what is left is rounding
  std::vector<radar::Channels> heard_by_beam(grid.ranges);
  for (std::size_t beam = 0; beam < grid.azimuths; ++beam) {
    const auto of_beam = std::span(bins).subspan(beam * grid.ranges, grid.ranges);
    const double azimuth_rad = grid.first_azimuth_rad + (static_cast<double>(beam) + 0.5) * grid.azimuth_step_rad;
    auto sin_depression = ground_along(azimuth_rad);
    std::ranges::fill(heard_by_beam, radar::Channels{});
    const auto add = [&](double bin, const radar::Channels& rcs_m2) {
      if (bin >= 0.0 && bin < static_cast<double>(grid.ranges)) heard_by_beam[static_cast<std::size_t>(bin)] += rcs_m2;
    };
    for (std::size_t range = 0; range < grid.ranges; ++range) {
      const radar::Channels rcs_m2 = of_beam[range] * part_heard;
      if (rcs_m2 == radar::Channels{}) continue;
      const double range_m = grid.first_range_m + (static_cast<double>(range) + 0.5) * grid.range_step_m;
      const auto heard = places.heard({.range_m = range_m,
                                       .cross = azimuth_rad,
                                       .rcs_m2 = rcs_m2,
                                       .bounces = 1,
                                       .sin_depression = static_cast<float>(sin_depression(range_m))});
      if (!heard) continue;
      const double near = std::floor(heard->row - 0.5 + in_place), far_share = heard->row - 0.5 - near;
      add(near, heard->rcs_m2 * static_cast<float>(1.0 - std::max(far_share, 0.0)));
      if (far_share > in_place) add(near + 1.0, heard->rcs_m2 * static_cast<float>(far_share));
    }
    std::ranges::copy(heard_by_beam, of_beam.begin());
  }
}

/// That hears what the first bins hold, half of one before the frame's first range too, unless it says from where on.
radar::Radar hearing_first_bins(radar::Radar radar, const radar::RangeAzimuthGrid& grid) {
  if (!radar.receiver.first_range_m)
    radar.receiver.first_range_m = std::max(grid.first_range_m - 0.5 * grid.range_step_m, 0.0);
  return radar;
}

/// Neither the ground's cross-sections nor the targets' are those of another frequency.
void check_frequency(const Frame& frame, const radar::Radar& radar) {
  constexpr double as_good_as_one = 0.01;
  if (frame.frequency_hz == 0.0) return;
  if (std::abs(radar.frequency_hz - frame.frequency_hz) <= as_good_as_one * frame.frequency_hz) return;
  throw Error(radar::title_of(radar),
              fmt::format("has a frequency of {:g} GHz, and the frame shows ground at {:g} GHz",
                          radar.frequency_hz / 1e9, frame.frequency_hz / 1e9),
              "open the ground at the radar's frequency, or give a radar of the ground's");
}

template <typename GroundAlongAzimuth>
radar::RangeAzimuthImage heard_image(const Frame& frame, const Pose& pose, const radar::Radar& radar,
                                     GroundAlongAzimuth&& ground_along) {
  check_frequency(frame, radar);
  radar::RangeAzimuthImage image = dark_image(frame, pose);
  const receiver::EchoPlaces places(radar, image.grid);
  std::vector<radar::Channels> ground = without_targets(frame);
  hear(ground, image.grid, places, part_of_ground_heard(radar, image.grid), ground_along);
  for_each_bin(image, [&](std::size_t beam, std::size_t range) { return ground[beam * image.grid.ranges + range]; });
  receiver::spread_responses(image, radar);
  receiver::add_echoes(image, hearing_first_bins(radar, image.grid), echoes_of(frame.targets));
  places.blank_unheard(image);
  return image;
}

/// For antennas to which it is all the same.
auto at_any_depression(double) {
  return [](double) { return 0.0; };
}

}  // namespace

radar::Channels power_of_bin(const Frame& frame, std::size_t bin) {
  if (!frame.powers_m2.empty()) {
    const auto power_m2 = frame.powers_m2.subspan(4 * bin, 4);
    return {power_m2[0], power_m2[1], power_m2[2], power_m2[3]};
  }
  const auto amplitude_m = frame.amplitudes_m.subspan(4 * bin, 4);
  return radar::power_of({amplitude_m[0], amplitude_m[1], amplitude_m[2]});
}

radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose) {
  radar::RangeAzimuthImage image = dark_image(frame, pose);
  for_each_bin(image, [&](std::size_t beam, std::size_t range) {
    return power_of_bin(frame, beam * frame.grid.ranges + range);
  });
  return image;
}

radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose, const radar::Radar& radar) {
  if (!radar::antenna_pattern(radar).elevation().even()) {
    throw Error(radar::title_of(radar), "has an antenna that tells elevations apart, which bins do not",
                "give the ground that they lie on too (render::ground_below), or an antenna that is even in elevation");
  }
  return heard_image(frame, pose, radar, at_any_depression);
}

radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose, const radar::Radar& radar,
                                  const GroundHeight& ground) {
  if (radar::antenna_pattern(radar).elevation().even()) return heard_image(frame, pose, radar, at_any_depression);
  return heard_image(frame, pose, radar, [&](double azimuth_rad) {
    return [along = GroundAlong(pose.position, azimuth_rad, ground, frame.earth)](double range_m) mutable {
      return along.sin_depression(range_m);
    };
  });
}

GroundHeight ground_below(const Frame& frame, const Pose& pose, const LiveGround& ground) {
  const radar::RangeAzimuthGrid& grid = frame.grid;
  const double far_m = grid.first_range_m + static_cast<double>(grid.ranges) * grid.range_step_m;
  const double width_rad = static_cast<double>(grid.azimuths) * grid.azimuth_step_rad;
  const Vec2d foot{pose.position.x, pose.position.y};
  const auto window = std::make_shared<const terrain::TerrainWindow>(ground.terrain().window_over(
      ground_under(foot, grid.first_azimuth_rad, width_rad, {0.0, far_m}), grid.range_step_m, most_nodes_a_side));
  return [window, view = window->view()](Vec2d place) { return terrain::height_at(view, place); };
}

}  // namespace sigmascape::render
