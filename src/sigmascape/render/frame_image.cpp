#include "sigmascape/render/frame_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

#include "sigmascape/base/error.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/distance_of_range.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/receiver/response_spread.h"
#include "sigmascape/render/frame_reach.h"
#include "sigmascape/terrain/terrain_view.h"
#include "sigmascape/terrain/terrain_window.h"

namespace sigmascape::render {
namespace {

constexpr std::size_t most_nodes_a_side = 2048;

/// Elevation of the ground, seen from a radar, along one azimuth at growing slant ranges.
class GroundAlong {
 public:
  GroundAlong(Vec3d radar, double azimuth_rad, const GroundHeight& ground, const radar::CurvedEarth& earth)
      : radar_(radar),
        foot_{radar.x, radar.y},
        outwards_(radar::horizontal_direction(azimuth_rad)),
        ground_(ground),
        earth_(earth),
        distance_m_(nearest_m()) {}

  /// Where ground lies over other ground any of its places will do: their elevations differ by no more than their
  /// heights over the range.
  double elevation_rad(double range_m) {
    distance_m_ = next_m(distance_m_, range_m);
    const Vec2d place = foot_ + outwards_ * distance_m_;
    const double rise_m = earth_.bent({place.x, place.y, ground_(place)}, foot_).z - radar_.z;
    return std::asin(std::clamp(rise_m / range_m, -1.0, 1.0));
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

/// As receiver::RangeAzimuthReceiver weights echoes before their responses are laid over the bins.
void weight_by_elevation(radar::RangeAzimuthImage& image, const radar::AntennaPattern& antenna,
                         const GroundHeight& ground, const radar::CurvedEarth& earth) {
  const radar::RangeAzimuthGrid& grid = image.grid;
  for (std::size_t beam = 0; beam < grid.azimuths; ++beam) {
    const double azimuth_rad = grid.first_azimuth_rad + (static_cast<double>(beam) + 0.5) * grid.azimuth_step_rad;
    GroundAlong along(image.radar_position, azimuth_rad, ground, earth);
    for (std::size_t range = 0; range < grid.ranges; ++range) {
      radar::Channels& bin = image.rcs_m2(beam, range);
      if (bin == radar::Channels{}) continue;
      const double range_m = grid.first_range_m + (static_cast<double>(range) + 0.5) * grid.range_step_m;
      const double off_axis_rad = along.elevation_rad(range_m) - antenna.tilt_rad();
      bin = bin * static_cast<float>(antenna.elevation().two_way_power(off_axis_rad));
    }
  }
}

}  // namespace

radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose) {
  const auto& [grid, amplitudes_m, powers_m2, report] = frame;
  radar::RangeAzimuthImage image{grid, pose.position, Array2D<radar::Channels>(grid.azimuths, grid.ranges)};
  for (std::size_t beam = 0; beam < grid.azimuths; ++beam) {
    for (std::size_t range = 0; range < grid.ranges; ++range) {
      const std::size_t first = 4 * (beam * grid.ranges + range);
      image.rcs_m2(beam, range) =
          powers_m2.empty()
              ? radar::power_of({amplitudes_m[first], amplitudes_m[first + 1], amplitudes_m[first + 2]})
              : radar::Channels{powers_m2[first], powers_m2[first + 1], powers_m2[first + 2], powers_m2[first + 3]};
    }
  }
  return image;
}

radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose, const radar::Radar& radar) {
  if (!radar::antenna_pattern(radar).elevation().even()) {
    throw Error(radar::title_of(radar), "has an antenna that tells elevations apart, which bins do not",
                "give the ground that they lie on too (render::ground_below), or an antenna that is even in elevation");
  }
  radar::RangeAzimuthImage image = image_of(frame, pose);
  receiver::spread_responses(image, radar);
  return image;
}

radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose, const radar::Radar& radar,
                                  const GroundHeight& ground, const radar::CurvedEarth& earth) {
  radar::RangeAzimuthImage image = image_of(frame, pose);
  const radar::AntennaPattern antenna = radar::antenna_pattern(radar);
  if (!antenna.elevation().even()) weight_by_elevation(image, antenna, ground, earth);
  receiver::spread_responses(image, radar);
  return image;
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
