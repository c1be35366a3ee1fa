#include "sigmascape/render/frame_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <ranges>
#include <tuple>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/distance_of_range.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/radar_title.h"
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
        distance_m_(nearest_m()) {}

  /// As of radar::Echo. Where ground lies over other ground any of its places will do: they differ by no more than
  /// their heights over the range.
  double sin_depression(double range_m) {
    distance_m_ = next_m(distance_m_, range_m);
    const Vec2d place = foot_ + outwards_ * distance_m_;
    const double rise_m = earth_.bent({place.x, place.y, ground_(place)}, foot_).z - radar_.z;
    return std::clamp(-rise_m / range_m, -1.0, 1.0);
  }

 private:
  static constexpr double near_enough_m = 1e-3;

  [[nodiscard]] double height_m(double distance_m) const { return ground_(foot_ + outwards_ * distance_m); }
  [[nodiscard]] double range_m(double distance_m) const {
    return earth_.slant_range_m(radar_.z, height_m(distance_m), distance_m);
  }

  /// Where the ground is nearest: straight below, unless it rises ahead by more than it recedes.
  [[nodiscard]] double nearest_m() const {
    constexpr int places = 64;
    const double depth_m = range_m(0.0);
    double nearest_m = 0.0, least_m = depth_m;
    for (int place = 1; place < places; ++place) {
      const double distance_m = depth_m * place / places, there_m = range_m(distance_m);
      if (there_m >= least_m) continue;
      nearest_m = distance_m;
      least_m = there_m;
    }
    return nearest_m;
  }

  /// A place of that range beyond one of less; that one where it is no less. However steep the ground, one lies between
  /// it and whatever is farther away, whereas height and distance found from each other in turn run off at steep looks.
  [[nodiscard]] double next_m(double near_m, double wanted_m) const {
    double near_by_m = range_m(near_m) - wanted_m;
    if (near_by_m >= 0.0) return near_m;
    double far_m =
        std::max(radar::distance_of_range_m(earth_, radar_.z, height_m(near_m), wanted_m), near_m + near_enough_m);
    double far_by_m = range_m(far_m) - wanted_m;
    // Along the sea half a circle is the longest way between two points, and less than twice their range.
    for (double step_m = far_m - near_m; far_by_m < 0.0 && far_m < 2.0 * wanted_m; step_m *= 2.0) {
      near_m = far_m;
      near_by_m = far_by_m;
      far_m += 2.0 * step_m;
      far_by_m = range_m(far_m) - wanted_m;
    }
    return between_m(near_m, near_by_m, far_m, far_by_m, wanted_m);
  }

  /// Regula falsi in its Illinois form. `near_by_m`, `far_by_m`: by how much the two are farther away than is wanted.
  [[nodiscard]] double between_m(double near_m, double near_by_m, double far_m, double far_by_m,
                                 double wanted_m) const {
    constexpr int most_steps = 40;
    if (far_by_m < near_enough_m) return far_m;
    int last_side = 0;
    for (int step = 0; step < most_steps && far_m - near_m > near_enough_m; ++step) {
      const double middle_m = (near_m * far_by_m - far_m * near_by_m) / (far_by_m - near_by_m);
      const double middle_by_m = range_m(middle_m) - wanted_m;
      if (std::abs(middle_by_m) < near_enough_m) return middle_m;
      const int side = middle_by_m > 0.0 ? 1 : -1;
      (side > 0 ? far_m : near_m) = middle_m;
      (side > 0 ? far_by_m : near_by_m) = middle_by_m;
      if (side == last_side) (side > 0 ? near_by_m : far_by_m) *= 0.5;
      last_side = side;
    }
    return 0.5 * (near_m + far_m);
  }

  Vec3d radar_;
  Vec2d foot_, outwards_;
  const GroundHeight& ground_;
  const radar::CurvedEarth& earth_;
  double distance_m_;  // of the range before, where the search for the next begins
};

/// Leaves what is not targets. Where a bin is told several times the first that was told is put in last.
void take_out_targets(radar::RangeAzimuthImage& image, const receiver::TargetsApart& targets) {
  const std::size_t ranges = image.grid.ranges;
  for (const auto& [bin, rcs_m2] : targets.bins | std::views::reverse)
    image.rcs_m2(bin / ranges, bin % ranges) = rcs_m2;
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

/// As receiver::RangeAzimuthReceiver hears echoes before their responses are laid over the bins, one from the middle of
/// each bin. `ground_along(azimuth_rad)` gives how far below the radar, at growing ranges, they are.
template <typename GroundAlongAzimuth>
void hear(radar::RangeAzimuthImage& image, const receiver::EchoPlaces& places, GroundAlongAzimuth&& ground_along) {
  constexpr double in_place = 1e-6;  // in bins; what is left is rounding
  const radar::RangeAzimuthGrid& grid = image.grid;
  std::vector<radar::Channels> heard_by_beam(grid.ranges);
  for (std::size_t beam = 0; beam < grid.azimuths; ++beam) {
    const double azimuth_rad = grid.first_azimuth_rad + (static_cast<double>(beam) + 0.5) * grid.azimuth_step_rad;
    auto sin_depression = ground_along(azimuth_rad);
    std::ranges::fill(heard_by_beam, radar::Channels{});
    const auto add = [&](double bin, const radar::Channels& rcs_m2) {
      if (bin >= 0.0 && bin < static_cast<double>(grid.ranges)) heard_by_beam[static_cast<std::size_t>(bin)] += rcs_m2;
    };
    for (std::size_t range = 0; range < grid.ranges; ++range) {
      const radar::Channels rcs_m2 = image.rcs_m2(beam, range);
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
    for (std::size_t range = 0; range < grid.ranges; ++range) image.rcs_m2(beam, range) = heard_by_beam[range];
  }
}

/// That hears what the first bins hold, half of one before the frame's first range too, unless it says from where on.
radar::Radar hearing_first_bins(radar::Radar radar, const radar::RangeAzimuthGrid& grid) {
  if (!radar.receiver.first_range_m)
    radar.receiver.first_range_m = std::max(grid.first_range_m - 0.5 * grid.range_step_m, 0.0);
  return radar;
}

template <typename GroundAlongAzimuth>
radar::RangeAzimuthImage heard_image(const Frame& frame, const Pose& pose, const radar::Radar& radar,
                                     GroundAlongAzimuth&& ground_along) {
  radar::RangeAzimuthImage image = image_of(frame, pose);
  take_out_targets(image, frame.targets);
  const receiver::EchoPlaces places(radar, image.grid);
  hear(image, places, ground_along);
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
  const radar::RangeAzimuthGrid& grid = frame.grid;
  radar::RangeAzimuthImage image{grid, pose.position, Array2D<radar::Channels>(grid.azimuths, grid.ranges)};
  for (std::size_t beam = 0; beam < grid.azimuths; ++beam) {
    for (std::size_t range = 0; range < grid.ranges; ++range)
      image.rcs_m2(beam, range) = power_of_bin(frame, beam * grid.ranges + range);
  }
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
                                  const GroundHeight& ground, const radar::CurvedEarth& earth) {
  if (radar::antenna_pattern(radar).elevation().even()) return heard_image(frame, pose, radar, at_any_depression);
  return heard_image(frame, pose, radar, [&](double azimuth_rad) {
    return [along = GroundAlong(pose.position, azimuth_rad, ground, earth)](double range_m) mutable {
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
