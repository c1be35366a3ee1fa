#include "sigmascape/scene/scene_extent.h"

#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"

namespace sigmascape::scene {
namespace {

constexpr Interval latitudes{-89.0, 89.0, "degrees"};
constexpr Interval longitudes{-360.0, 360.0, "degrees"};
constexpr Interval metres{-1e6, 1e6, "m"};

/// Of a scene's middle from its origin: lengths are too long there by x²/2R², a thousandth, as at the rim of a UTM
/// zone.
constexpr double farthest_from_origin_m = 300e3;

void check_scale(const ScenePlace& place, Vec2d middle) {
  if (length(middle) <= farthest_from_origin_m) return;
  if (place.extent_m) {
    throw Error(place.where + ".extent",
                fmt::format("has its middle {:.0f} km from {}, where the frame is out of scale", length(middle) / 1e3,
                            place.origin ? "the origin" : "the origin, which is the middle of the terrain"),
                fmt::format("state it in metres from an origin_lat_deg and origin_lon_deg within {:.0f} km of it, or "
                            "in degrees without an origin",
                            farthest_from_origin_m / 1e3));
  }
  const std::string distance =
      std::isfinite(length(middle)) ? fmt::format("{:.0f} km", length(middle) / 1e3) : "half the Earth";
  throw Error(place.where + ".origin_lat_deg",
              fmt::format("lies {} from the middle of the scene, where its frame is out of scale", distance),
              fmt::format("give latitude and longitude of a place within {:.0f} km, or leave both out",
                          farthest_from_origin_m / 1e3));
}

void read_extent(const TomlSection& section, ScenePlace& place) {
  const bool in_degrees =
      section.has("west_deg") || section.has("east_deg") || section.has("south_deg") || section.has("north_deg");
  if (in_degrees) {
    place.extent_deg = GeographicBox{section.number("west_deg", longitudes), section.number("south_deg", latitudes),
                                     section.number("east_deg", longitudes), section.number("north_deg", latitudes)};
  } else {
    place.extent_m = radar::Rectangle{section.number("west_m", metres), section.number("south_m", metres),
                                      section.number("east_m", metres), section.number("north_m", metres)};
  }
  section.refuse_unknown_keys();
  const bool empty = in_degrees ? place.extent_deg->east_deg <= place.extent_deg->west_deg ||
                                      place.extent_deg->north_deg <= place.extent_deg->south_deg
                                : place.extent_m->width_m() <= 0.0 || place.extent_m->height_m() <= 0.0;
  if (empty) {
    throw Error(section.where(), "holds no area",
                in_degrees ? "east must be greater than west and north than south: across 180°, count on to 180.1 or so"
                           : "east must be greater than west and north than south");
  }
}

}  // namespace

ScenePlace read_scene_place(const TomlSection& section) {
  ScenePlace place{.where = section.where(), .origin = {}, .extent_m = {}, .extent_deg = {}};
  const auto latitude_deg = section.optional_number("origin_lat_deg", latitudes);
  const auto longitude_deg = section.optional_number("origin_lon_deg", longitudes);
  if (latitude_deg.has_value() != longitude_deg.has_value()) {
    throw section.fault(latitude_deg ? "origin_lon_deg" : "origin_lat_deg", "is missing", "state both, or neither");
  }
  if (latitude_deg) place.origin = geo::GeographicPosition{*latitude_deg, *longitude_deg};
  if (const auto extent = section.section("extent")) read_extent(*extent, place);
  return place;
}

geo::LocalFrame frame_of(const ScenePlace& place, const geo::RasterBand& terrain) {
  const geo::GeographicPosition origin = place.origin       ? *place.origin
                                         : place.extent_deg ? place.extent_deg->centre()
                                                            : geo::Raster(terrain).centre();
  const geo::LocalFrame frame(origin.latitude_deg, origin.longitude_deg);
  const auto extent = extent_in(place, frame);
  if (extent) check_scale(place, extent->centre());
  if (!extent && place.origin) check_scale(place, geo::position_in_frame(frame, geo::Raster(terrain).centre()));
  return frame;
}

std::optional<radar::Rectangle> extent_in(const ScenePlace& place, const geo::LocalFrame& frame) {
  if (!place.extent_deg) return place.extent_m;
  const GeographicBox& box = *place.extent_deg;
  const auto [latitude_deg, longitude_deg] = box.centre();
  return radar::Rectangle{geo::position_in_frame(frame, {latitude_deg, box.west_deg}).x,
                          geo::position_in_frame(frame, {box.south_deg, longitude_deg}).y,
                          geo::position_in_frame(frame, {latitude_deg, box.east_deg}).x,
                          geo::position_in_frame(frame, {box.north_deg, longitude_deg}).y};
}

}  // namespace sigmascape::scene
