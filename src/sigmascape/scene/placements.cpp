#include "sigmascape/scene/placements.h"

#include <cmath>

#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/scene/vector_section.h"

namespace sigmascape::scene {

Placements read_placements(const TomlSection& section) {
  Placements placements;
  placements.in_frame_m = section.pairs("positions_m");
  placements.lat_lon_deg = section.pairs("positions_lat_lon_deg");
  require_on_globe(section, "positions_lat_lon_deg", placements.lat_lon_deg);
  if (const auto points = section.section("positions")) {
    placements.points = read_vector_source(*points, geo::GeometryKind::Points);
    points->refuse_unknown_keys();
  }
  return placements;
}

void require_on_globe(const TomlSection& section, std::string_view key,
                      std::span<const std::array<double, 2>> lat_lon_deg) {
  for (const auto& [latitude_deg, longitude_deg] : lat_lon_deg) {
    if (std::abs(latitude_deg) <= 90.0 && std::abs(longitude_deg) <= 360.0) continue;
    throw section.fault(
        key, std::abs(latitude_deg) <= 90.0 ? "holds a longitude beyond 360°" : "holds a latitude beyond 90°",
        "write latitude first, then longitude, in degrees");
  }
}

FoundPlaces places_in(const Scene& scene, const Placements& placements) {
  FoundPlaces places;
  std::vector<Vec2d>& positions = places.positions;
  for (const auto& [x, y] : placements.in_frame_m) positions.push_back({x, y});
  for (const auto& [latitude_deg, longitude_deg] : placements.lat_lon_deg) {
    positions.push_back(geo::position_in_frame(scene.frame, {latitude_deg, longitude_deg}));
  }
  if (placements.points) {
    places.of_file = geo::for_each_feature(*placements.points, scene.frame, [&](const geo::Feature& feature) {
      positions.insert(positions.end(), feature.points.begin(), feature.points.end());
    });
  }
  return places;
}

}  // namespace sigmascape::scene
