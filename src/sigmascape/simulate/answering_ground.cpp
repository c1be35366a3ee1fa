#include "sigmascape/simulate/answering_ground.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/radar/antenna_pattern.h"
#include "sigmascape/radar/rectangle_distances.h"

namespace sigmascape::simulate {
namespace {

constexpr double range_resolutions_beside = 4.0;

}  // namespace

radar::Rectangle answering_ground(const radar::Radar& radar, const radar::Rectangle& area,
                                  const radar::Rectangle& extent) {
  const double width_rad = radar::antenna_pattern(radar).azimuth().two_way_width_rad();
  const Vec2d foot{radar.position.x, radar.position.y};
  radar::Rectangle answering = area;
  for (const Vec2d corner : radar::corners_of(area)) {
    const Vec2d away = corner - foot;
    const double distance_m = length(away);
    if (distance_m == 0.0) continue;
    const double range_m = std::hypot(distance_m, radar.position.z);
    const double along_m = range_resolutions_beside * radar.range_resolution_m * range_m / distance_m;
    const double across_m = width_rad * distance_m;
    const Vec2d outwards{std::abs(away.x) / distance_m, std::abs(away.y) / distance_m};
    const double east_m = outwards.x * along_m + outwards.y * across_m;
    const double north_m = outwards.y * along_m + outwards.x * across_m;
    // Never less than the area itself, wherever the extent ends.
    answering.west_m = std::min(answering.west_m, std::max(corner.x - east_m, extent.west_m));
    answering.east_m = std::max(answering.east_m, std::min(corner.x + east_m, extent.east_m));
    answering.south_m = std::min(answering.south_m, std::max(corner.y - north_m, extent.south_m));
    answering.north_m = std::max(answering.north_m, std::min(corner.y + north_m, extent.north_m));
  }
  return answering;
}

}  // namespace sigmascape::simulate
