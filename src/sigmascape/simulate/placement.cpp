#include "sigmascape/simulate/placement.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/coordinate_transform.h"

namespace sigmascape::simulate {
namespace {

struct Placer {
  const geo::LocalFrame& frame;
  const terrain::HeightField& terrain;
  const radar::Rectangle& extent;

  Vec3d operator()(const radar::SeenFrom& seen) const {
    const Vec2d target = seen.target.value_or(extent.centre());
    return radar::position_seeing({target.x, target.y, terrain.height_at(target)}, seen.azimuth_rad, seen.elevation_rad,
                                  seen.slant_range_m);
  }
  Vec3d operator()(const radar::LocalPlace& place) const { return place.position; }
  Vec3d operator()(const radar::GeographicPlace& place) const {
    const Vec2d local = geo::position_in_frame(frame, {place.latitude_deg, place.longitude_deg});
    return {local.x, local.y, place.altitude_m};
  }
};

}  // namespace

radar::Radar placed_radar(const radar::RadarFile& file, const geo::LocalFrame& frame,
                          const terrain::HeightField& terrain, const radar::Rectangle& extent) {
  radar::Radar radar = file.radar;
  radar.position = std::visit(Placer{frame, terrain, extent}, file.place);
  return radar;
}

radar::GroundGrid map_grid(const radar::MapRequest& request, const radar::Rectangle& extent) {
  const radar::Rectangle asked = request.area.value_or(extent);
  const double west = std::max(asked.west_m, extent.west_m), east = std::min(asked.east_m, extent.east_m);
  const double south = std::max(asked.south_m, extent.south_m), north = std::min(asked.north_m, extent.north_m);
  const double columns = std::floor((east - west) / request.cell_m + 1e-9),
               rows = std::floor((north - south) / request.cell_m + 1e-9);
  if (columns < 1.0 || rows < 1.0) {
    throw Error("map area", "has no cell in common with the scene",
                "choose an area within the extent that `sigmascape scene info` prints");
  }
  return {west, north, request.cell_m, static_cast<std::size_t>(columns), static_cast<std::size_t>(rows)};
}

}  // namespace sigmascape::simulate
