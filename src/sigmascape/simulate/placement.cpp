#include "sigmascape/simulate/placement.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/axis_units.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/geodesic.h"
#include "sigmascape/radar/radar_title.h"

namespace sigmascape::simulate {
namespace {

/// As far as a radar file lets a radar be from what it sees.
constexpr double furthest_m = 1e6;

/// Where a radar stands, and what azimuth true north has there in the frame, for what it measures from that.
struct Stand {
  Vec3d position;
  double north_rad = 0.0;
};

/// Over the scene it stands where the frame has its place, a mast on its own hill. Beside it, at the distance and
/// azimuth of its geodesic from the scene's middle, so that it sees the scene from where it does: the frame is true to
/// scale and angle about the scene, and bends straight lines that go far. The azimuth of the way back at the radar
/// tells what true north is there.
Stand on_globe(const radar::GeographicPlace& place, const geo::LocalFrame& frame, const radar::Rectangle& extent) {
  const Vec2d middle = extent.centre();
  const geo::GeographicPosition there{place.latitude_deg, place.longitude_deg},
      here = geo::place_on_globe(frame, middle);
  const std::string crs = frame.proj();
  const geo::Geodesic out = geo::geodesic_between(here, there);
  const Vec2d projected = geo::position_in_frame(frame, there), way = geo::way_at_azimuth(crs, middle, out.azimuth_rad),
              local = extent.contains(projected)
                          ? projected
                          : middle + way * (out.length_m / geo::ground_metres_per_unit(crs, middle));
  constexpr double has_direction_m = 1.0;
  const double north_rad = out.length_m > has_direction_m
                               ? azimuth_of(middle - local) - geo::geodesic_between(there, here).azimuth_rad
                               : azimuth_of(geo::way_at_azimuth(crs, middle, 0.0));
  return {{local.x, local.y, place.altitude_m}, turned_by_least(north_rad)};
}

struct Placer {
  const geo::LocalFrame& frame;
  const terrain::HeightField& terrain;
  const radar::Rectangle& extent;
  radar::CurvedEarth earth;

  Stand operator()(const radar::SeenFrom& seen) const {
    const Vec2d target = seen.target.value_or(extent.centre());
    return {radar::position_seeing({target.x, target.y, terrain.height_at(target)}, seen.azimuth_rad,
                                   seen.elevation_rad, seen.slant_range_m, earth)};
  }
  Stand operator()(const radar::LocalPlace& place) const { return {place.position}; }
  Stand operator()(const radar::Unplaced&) const {
    throw Error("position of the radar", "is not stated",
                "give its file a [position], or in Python call see_from or stand_at first");
  }
  Stand operator()(const radar::GeographicPlace& place) const { return on_globe(place, frame, extent); }
};

/// Turns what a radar measures from true north to what it is in the frame.
void turn_to_frame(radar::Radar& radar, double north_rad) {
  radar.north_rad = north_rad;
  if (north_rad == 0.0) return;
  const double sine = std::sin(north_rad), cosine = std::cos(north_rad);
  const Vec3d v = radar.velocity_mps;
  radar.velocity_mps = {v.x * cosine + v.y * sine, v.y * cosine - v.x * sine, v.z};
  radar.heading_rad += north_rad;
  if (radar.scan.azimuth_rad) *radar.scan.azimuth_rad += north_rad;
}

/// Puts the places of one target where they are.
struct TargetPlacer {
  const geo::LocalFrame& frame;
  const TargetGround& ground;
  const std::string& where;

  Vec2d operator()(Vec2d place) const { return place; }
  Vec2d operator()(const radar::LatitudeLongitude& place) const {
    return geo::position_in_frame(frame, {place.latitude_deg, place.longitude_deg});
  }
  [[nodiscard]] radar::WayPoint way_point(const radar::TargetPlace& source) const {
    const Vec2d place = std::visit(*this, source.place);
    const radar::Rectangle& extent = ground.extent;
    if (!std::isfinite(place.x) || !std::isfinite(place.y)) {
      throw Error(where, "has a place on the globe that the scene's frame does not reach",
                  "give latitude and longitude near the scene");
    }
    if (source.above_ground && !extent.contains(place)) {
      throw Error(
          where, fmt::format("has a place at ({:.1f}, {:.1f}) m, outside the terrain", place.x, place.y),
          fmt::format("move it to between {:.0f} and {:.0f} m east, {:.0f} and {:.0f} m north, or state altitude_m",
                      extent.west_m, extent.east_m, extent.south_m, extent.north_m));
    }
    const double ground_m = source.above_ground ? ground.height_at(place) : 0.0;
    return {source.time_s, {place.x, place.y, ground_m + source.height_m}};
  }
};

}  // namespace

radar::Radar placed_radar(const radar::RadarFile& file, const geo::LocalFrame& frame,
                          const terrain::HeightField& terrain, const radar::Rectangle& extent, double time_s) {
  radar::Radar radar = file.radar;
  const Stand stand = std::visit(Placer{frame, terrain, extent, radar::earth_of(radar)}, file.place);
  turn_to_frame(radar, stand.north_rad);
  radar.position = stand.position + radar.velocity_mps * time_s;
  const Vec2d away = Vec2d{radar.position.x, radar.position.y} - extent.centre();
  if (!(length(away) <= furthest_m)) {
    throw Error(radar::title_of(radar),
                fmt::format("stands {:.0f} km from the middle of the scene", length(away) / 1e3),
                fmt::format("place it within {:.0f} km", furthest_m / 1e3));
  }
  return radar;
}

radar::GroundGrid map_grid(const radar::MapRequest& request, const radar::Rectangle& extent) {
  const radar::Rectangle asked = request.area.value_or(extent);
  const double west = std::max(asked.west_m, extent.west_m), east = std::min(asked.east_m, extent.east_m);
  const double south = std::max(asked.south_m, extent.south_m), north = std::min(asked.north_m, extent.north_m);
  const double columns = std::floor((east - west) / request.cell_m + 1e-9),
               rows = std::floor((north - south) / request.cell_m + 1e-9);
  if (columns < 1.0 || rows < 1.0) {
    if (east > west && north > south) {
      throw Error("map area",
                  fmt::format("has {:g} x {:g} m in common with the scene and cells of {:g} m", east - west,
                              north - south, request.cell_m),
                  "make cell_m smaller, or the area larger");
    }
    throw Error("map area", "has no cell in common with the scene",
                fmt::format("choose an area within the scene's extent, x {:.1f} to {:.1f} m, y {:.1f} to {:.1f} m",
                            extent.west_m, extent.east_m, extent.south_m, extent.north_m));
  }
  return {west, north, request.cell_m, static_cast<std::size_t>(columns), static_cast<std::size_t>(rows)};
}

TargetGround::TargetGround(const terrain::HeightField& terrain)
    : extent(terrain.extent()), height_at([&terrain](Vec2d place) { return terrain.height_at(place); }) {}

TargetGround::TargetGround(const live::LiveTerrain& terrain)
    : extent(terrain.pyramid().extent()), height_at([&terrain](Vec2d place) { return terrain.height_at(place); }) {}

std::vector<radar::Target> placed_targets(std::span<const radar::TargetSource> sources, const geo::LocalFrame& frame,
                                          const TargetGround& ground, std::uint64_t seed, double time_s) {
  std::vector<radar::Target> targets;
  for (const radar::TargetSource& source : sources) {
    const TargetPlacer placer{frame, ground, source.where};
    std::vector<radar::WayPoint> way_points;
    for (const radar::TargetPlace& place : source.places) way_points.push_back(placer.way_point(place));
    radar::Target target = source.target;
    target.track = way_points.size() == 1 ? radar::Track::straight(way_points.front().position, source.velocity_mps)
                                          : radar::Track::through(std::move(way_points), source.where);
    target.track = target.track.counted_from(time_s);
    if (target.seed == 0) target.seed = hashed(seed, targets.size() + 1);
    targets.push_back(std::move(target));
  }
  return targets;
}

std::vector<radar::Target> targets_of(const scene::Scene& scene) {
  std::vector<radar::Target> targets;
  for (const scene::PointTarget& point : scene.point_targets) {
    const double height_m = scene.terrain.height_at(point.position) + point.height_m;
    targets.push_back({.name = point.name,
                       .track = radar::Track::straight({point.position.x, point.position.y, height_m}),
                       .rcs_m2 = point.rcs_m2});
  }
  return targets;
}

std::vector<radar::Target> all_targets(const scene::Scene* scene, std::span<const radar::TargetSource> given,
                                       const geo::LocalFrame& frame, const TargetGround& ground, std::uint64_t seed,
                                       double time_s) {
  std::vector<radar::Target> targets;
  if (scene != nullptr) targets = targets_of(*scene);
  std::ranges::move(placed_targets(given, frame, ground, seed, time_s), std::back_inserter(targets));
  return targets;
}

}  // namespace sigmascape::simulate
