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
        height_m_(ground(foot_)) {}

  /// Height and distance follow from each other. Where ground lies over other ground any of its places will do: their
  /// elevations differ by no more than their heights over the range.
  double elevation_rad(double range_m) {
    constexpr int most_steps = 8;
    constexpr double close_enough_m = 0.01;
    double distance_m = 0.0;
    for (int step = 0; step < most_steps; ++step) {
      distance_m = radar::distance_of_range_m(earth_, radar_.z, height_m_, range_m);
      const double before_m = height_m_;
      height_m_ = ground_(foot_ + outwards_ * distance_m);
      if (std::abs(height_m_ - before_m) < close_enough_m) break;
    }
    const Vec2d place = foot_ + outwards_ * distance_m;
    const double rise_m = earth_.bent({place.x, place.y, height_m_}, foot_).z - radar_.z;
    return std::asin(std::clamp(rise_m / range_m, -1.0, 1.0));
  }

 private:
  Vec3d radar_;
  Vec2d foot_, outwards_;
  const GroundHeight& ground_;
  const radar::CurvedEarth& earth_;
  double height_m_;  // of the range before, where the search for the next begins
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
