#include "sigmascape/simulate/answering_ground.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sigmascape/radar/antenna_pattern.h"
#include "sigmascape/radar/distance_of_range.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/receiver/bin_response.h"

namespace sigmascape::simulate {
namespace {

constexpr double range_resolutions_beside = 4.0;

constexpr double part_from_beyond = 0.01;
constexpr double steps_a_width = 32.0;

/// Off the axis, to either side: what lies beyond brings the beam no more than `part_from_beyond`.
double reach_of_beam_rad(const radar::Radar& radar) {
  const double step_rad = radar::antenna_pattern(radar).azimuth().two_way_width_rad() / steps_a_width;
  const std::vector<float> weights = receiver::azimuth_response(radar, step_rad).weights;
  const std::size_t middle = weights.size() / 2;
  std::size_t steps = middle;
  for (double left = 0.0, right = 0.0; steps > 0; --steps) {
    left += static_cast<double>(weights[middle - steps]);
    right += static_cast<double>(weights[middle + steps]);
    if (std::max(left, right) > part_from_beyond) break;
  }
  return static_cast<double>(steps) * step_rad;
}

/// Where a range resolution and a beam's width reach farthest over the ground: its corners, and of each edge the point
/// nearest to the radar, where ranges change least.
std::vector<Vec2d> places_at_edge(const radar::Rectangle& area, Vec2d foot) {
  const Vec2d nearest = radar::nearest_point(area, foot);
  std::vector<Vec2d> places{
      {area.west_m, nearest.y}, {area.east_m, nearest.y}, {nearest.x, area.south_m}, {nearest.x, area.north_m}};
  for (const Vec2d corner : radar::corners_of(area)) places.push_back(corner);
  return places;
}

}  // namespace

radar::Rectangle answering_ground(const radar::Radar& radar, const radar::Rectangle& area,
                                  const radar::Rectangle& extent, double lowest_ground_m) {
  const double reach_rad = reach_of_beam_rad(radar);
  const Vec2d foot{radar.position.x, radar.position.y};
  radar::Rectangle answering = area;
  for (const Vec2d place : places_at_edge(area, foot)) {
    const Vec2d away = place - foot;
    const double distance_m = length(away);
    const double height_m = radar.position.z - lowest_ground_m, range_m = std::hypot(distance_m, height_m),
                 spare_m = range_resolutions_beside * radar.range_resolution_m;
    const auto ground_m = [height_m](double of_range_m) {
      return radar::distance_of_range_m(radar::CurvedEarth::flat(), height_m, 0.0, std::max(of_range_m, 0.0));
    };
    // Towards the radar, which is farther, and where it stands within the area away from it.
    const double along_m = std::max(distance_m - ground_m(range_m - spare_m), ground_m(range_m + spare_m) - distance_m);
    const double across_m = reach_rad * distance_m;
    const Vec2d outwards =
        distance_m > 0.0 ? Vec2d{std::abs(away.x) / distance_m, std::abs(away.y) / distance_m} : Vec2d{1.0, 1.0};
    const double east_m = outwards.x * along_m + outwards.y * across_m;
    const double north_m = outwards.y * along_m + outwards.x * across_m;
    // Never less than the area itself, wherever the extent ends.
    answering.west_m = std::min(answering.west_m, std::max(place.x - east_m, extent.west_m));
    answering.east_m = std::max(answering.east_m, std::min(place.x + east_m, extent.east_m));
    answering.south_m = std::min(answering.south_m, std::max(place.y - north_m, extent.south_m));
    answering.north_m = std::max(answering.north_m, std::min(place.y + north_m, extent.north_m));
  }
  return answering;
}

}  // namespace sigmascape::simulate
