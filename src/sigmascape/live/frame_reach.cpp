#include "sigmascape/live/frame_reach.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/live/sector.h"
#include "sigmascape/radar/distance_of_range.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::live {
namespace {

struct SlantRanges {
  double near_m, far_m;
};

double far_range_m(const LiveSettings& settings, const Pose& pose) {
  return pose.first_range_m + static_cast<double>(settings.ranges) * settings.range_step_m;
}

FrameReach reach_between(SlantRanges ranges, const Pose& pose, double near_height_m, double highest_m,
                         const radar::CurvedEarth& earth) {
  // Nothing is farther for its slant range than what is as high as the radar.
  const double far_height_m = std::min(highest_m, pose.position.z);
  return {radar::distance_of_range_m(earth, pose.position.z, near_height_m, ranges.near_m),
          radar::distance_of_range_m(earth, pose.position.z, far_height_m, ranges.far_m)};
}

/// Bins that all ground is farther away than look at so much of it below the radar, none of which answers in them.
FrameReach a_metre_at_least(FrameReach reach) {
  return {reach.near_m, std::max(reach.far_m, reach.near_m + 1.0)};
}

}  // namespace

FrameReach frame_reach(const LiveSettings& settings, const Pose& pose, double lowest_m, double highest_m,
                       const radar::CurvedEarth& earth) {
  return reach_between({pose.first_range_m, far_range_m(settings, pose)}, pose, lowest_m, highest_m, earth);
}

FrameReach sharing_reach(const LiveSettings& settings, const Pose& pose, double lowest_m, double highest_m,
                         double highest_near_m, const radar::CurvedEarth& earth) {
  const double half_m = 0.5 * settings.range_step_m, z = pose.position.z;
  // Of one slant range what differs most from the radar in height is nearest.
  const double near_height_m = highest_near_m - z > z - lowest_m ? highest_near_m : lowest_m;
  return a_metre_at_least(
      reach_between({std::max(pose.first_range_m - half_m, 0.0), far_range_m(settings, pose) + half_m}, pose,
                    near_height_m, highest_m, earth));
}

std::size_t horizon_distances(const LiveSettings& settings) {
  return 2 * (settings.ranges + 1);
}

std::size_t azimuths_a_beam(const LiveSettings& settings, FrameReach reach, double terrain_spacing_m) {
  constexpr double most = 32.0;
  constexpr std::size_t most_nodes = 1U << 24U;
  const std::size_t distances = horizon_distances(settings);
  const double along_m = (reach.far_m - reach.near_m) / static_cast<double>(distances);
  const double across_m = 0.5 * (reach.near_m + reach.far_m) * settings.beam_step_rad;
  if (across_m <= terrain_spacing_m) return 1;
  // By powers of two, so that they seldom change along a flight, and then by little.
  const double wanted = std::clamp(across_m / std::max(along_m, terrain_spacing_m), 2.0, most);
  auto lines = static_cast<std::size_t>(std::exp2(std::ceil(std::log2(wanted))));
  while (lines > 1 && settings.beams * lines > most_nodes / distances) lines /= 2;
  return lines;
}

radar::Rectangle ground_under(Vec2d radar, double first_azimuth_rad, double width_rad, FrameReach reach) {
  // A sector is less than half a turn wide.
  const int parts = static_cast<int>(width_rad / (pi / 2.0)) + 1;
  radar::Rectangle box{1e300, 1e300, -1e300, -1e300};
  for (int part = 0; part < parts; ++part) {
    const Sector sector(first_azimuth_rad + width_rad * part / parts, width_rad / parts, reach.near_m, reach.far_m);
    box = radar::joined(box, sector.bounds());
  }
  return {radar.x + box.west_m, radar.y + box.south_m, radar.x + box.east_m, radar.y + box.north_m};
}

render::DetailQuestion question_of_bins(const LiveSettings& settings, FrameReach level_ground) {
  const auto [near_m, far_m] = a_metre_at_least(level_ground);
  const double length_m = far_m - near_m;
  render::DetailQuestion question;
  // Bins lie along the slant range; what they are on the ground follows from where they begin and end.
  question.range_resolution_m = length_m / static_cast<double>(settings.ranges);
  question.grazing_rad = 0.0;
  question.cross_range_m = (near_m + length_m / 2.0) * settings.beam_step_rad;
  question.samples_per_cell = settings.cells_per_bin;
  return question;
}

}  // namespace sigmascape::live
