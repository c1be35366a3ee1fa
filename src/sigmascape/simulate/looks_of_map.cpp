#include "sigmascape/simulate/looks_of_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/azimuth_span.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/simulate/answering_ground.h"

namespace sigmascape::simulate {
namespace {

/// What rounding may add to an angle.
constexpr double hair_rad = 1e-6;

/// Places on an ascending axis from the last that is no higher than `lowest` to the first that is no lower than
/// `highest`.
std::vector<std::size_t> places_about(const std::vector<double>& axis, double lowest, double highest) {
  const auto above_lowest = std::ranges::upper_bound(axis, lowest);
  const auto from_highest = std::ranges::lower_bound(axis, highest);
  std::vector<std::size_t> places;
  for (auto place = above_lowest == axis.begin() ? above_lowest : above_lowest - 1; place != axis.end(); ++place) {
    places.push_back(static_cast<std::size_t>(place - axis.begin()));
    if (place == from_highest) break;
  }
  return places;
}

/// Of an axis that closes on itself: those between which the span lies.
std::vector<std::size_t> azimuths_about(const std::vector<double>& axis, const radar::AzimuthSpan& towards_radar) {
  const auto gap_after = [&](std::size_t place) {
    const double next = place + 1 < axis.size() ? axis[place + 1] : axis.front() + 2.0 * pi;
    return next - axis[place];
  };
  std::vector<bool> wanted(axis.size(), false);
  for (std::size_t place = 0; place < axis.size(); ++place) {
    // The gap behind this azimuth meets the span when the span begins before its end and ends after its begin.
    const double begin = wrapped_azimuth(axis[place] - (towards_radar.middle_rad + towards_radar.left_rad - hair_rad));
    const double width = towards_radar.right_rad - towards_radar.left_rad + 2.0 * hair_rad;
    if (begin > width && begin + gap_after(place) < 2.0 * pi) continue;
    wanted[place] = wanted[(place + 1) % axis.size()] = true;
  }
  std::vector<std::size_t> places;
  for (std::size_t place = 0; place < axis.size(); ++place) {
    if (wanted[place]) places.push_back(place);
  }
  return places;
}

}  // namespace

atlas::AspectSelection looks_of_map(const atlas::AspectGrid& baked, const radar::Radar& radar,
                                    const radar::Rectangle& area, const terrain::HeightField& terrain) {
  const radar::Rectangle answering = answering_ground(radar, area, terrain.extent(), terrain.lowest_m());
  const Vec2d foot{radar.position.x, radar.position.y};
  const double near_m = radar::nearest_m(answering, foot), far_m = radar::farthest_m(answering, foot);
  const double above_highest_m = radar.position.z - static_cast<double>(terrain.highest_m());
  const double above_lowest_m = radar.position.z - static_cast<double>(terrain.lowest_m());
  const double lowest_rad = std::atan2(above_highest_m, above_highest_m > 0.0 ? far_m : near_m);
  const double highest_rad = std::atan2(above_lowest_m, above_lowest_m > 0.0 ? near_m : far_m);
  radar::AzimuthSpan azimuths = radar::azimuths_of(answering, foot);
  azimuths.middle_rad += pi;
  return {azimuths_about(baked.azimuths_rad, azimuths),
          places_about(baked.elevations_rad, lowest_rad - hair_rad, highest_rad + hair_rad)};
}

}  // namespace sigmascape::simulate
