#include "sigmascape/atlas/stac_document.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <vector>

#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/raster_placement.h"

namespace sigmascape::atlas {
namespace {

/// Where the digits of a hash that is recorded under `key` begin; nothing when there is none.
std::optional<std::size_t> place_of_digits(const std::string& text, std::string_view key) {
  const std::string before = fmt::format("\"{}\": \"", key);
  const std::size_t found = text.find(before);
  return found == std::string::npos ? std::nullopt : std::optional(found + before.size());
}

}  // namespace

double tidy_deg(double angle_rad) {
  return std::round(deg_from_radians(angle_rad) * 1e9) / 1e9;
}

std::string written(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string sealed(std::string text, std::string_view key) {
  const std::string digits = sha256_of(text);
  return text.insert(place_of_digits(text, key).value(), digits);
}

Seal seal_of(std::string text, std::string_view key) {
  const auto place = place_of_digits(text, key);
  if (!place) return Seal::Absent;
  const std::size_t digits = text.find('"', *place) - *place;
  const std::string recorded = text.substr(*place, digits);
  text.erase(*place, digits);
  return sha256_of(text) == recorded ? Seal::Fits : Seal::Broken;
}

Json link(const char* relation, const std::string& target) {
  return {{"rel", relation}, {"href", target}, {"type", "application/json"}};
}

std::string place_name(const PyramidTile& tile) {
  const std::string patch = patch_name(tile.south_west);
  return tile.level == 0 ? patch : fmt::format("pyramid_{}_{}", tile.level, patch);
}

std::string href_from(const PyramidTile& tile, const std::filesystem::path& file) {
  return (tile.level == 0 ? "../" : "../../") + file.generic_string();
}

radar::GroundGrid whole_grid(const AtlasDescription& description) {
  const PatchBlock block = description.patches.block_over(description.extent);
  radar::GroundGrid grid = description.patches.texels_of(block[0]);
  grid.columns *= block.columns();
  grid.rows *= block.rows();
  return grid;
}

namespace {

using Ring = std::vector<Vec2d>;

double nine_decimals(double degrees) {
  return std::round(degrees * 1e9) / 1e9;
}

/// In [-180°, 180°].
double usual_longitude(double degrees) {
  return nine_decimals(degrees < -180.0 ? degrees + 360.0 : degrees > 180.0 ? degrees - 360.0 : degrees);
}

/// What of a convex ring lies where `inside` is positive: Sutherland's and Hodgman's clipping by one line.
template <typename Inside>
Ring part_of(std::span<const Vec2d> ring, const Inside& inside) {
  Ring part;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d here = ring[i], next = ring[(i + 1) % ring.size()];
    const double depth = inside(here), depth_of_next = inside(next);
    if (depth > 0.0) part.push_back(here);
    if ((depth > 0.0) != (depth_of_next > 0.0))
      part.push_back(here + (next - here) * (depth / (depth - depth_of_next)));
  }
  return part;
}

Json closed(std::span<const Vec2d> ring, double turned_deg) {
  Json places = Json::array();
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    const Vec2d place = ring[i % ring.size()];
    places.push_back({nine_decimals(place.x + turned_deg), nine_decimals(place.y)});
  }
  return places;
}

}  // namespace

Footprint::Footprint(const AtlasDescription& description, const radar::GroundGrid& grid) {
  auto corners = geo::geographic_corners({grid.west_m, grid.north_m, grid.cell_m, description.frame.proj()},
                                         grid.columns, grid.rows);
  // About the first corner, so that none is torn from the others where longitudes begin anew.
  for (Vec2d& corner : corners) corner.x = corners[0].x + std::remainder(corner.x - corners[0].x, 360.0);
  const auto [west, east] = std::ranges::minmax(corners, {}, &Vec2d::x);
  const auto [south, north] = std::ranges::minmax(corners, {}, &Vec2d::y);
  box = {usual_longitude(west.x), nine_decimals(south.y), usual_longitude(east.x), nine_decimals(north.y)};
  const double antimeridian = west.x < -180.0 ? -180.0 : 180.0;
  const Ring before = part_of(corners, [&](Vec2d place) { return antimeridian - place.x; });
  const Ring beyond = part_of(corners, [&](Vec2d place) { return place.x - antimeridian; });
  if (before.size() < 3 || beyond.size() < 3) {
    polygon = {{"type", "Polygon"}, {"coordinates", Json::array({closed(corners, 0.0)})}};
    return;
  }
  const bool is_west = antimeridian < 0.0;
  polygon = {{"type", "MultiPolygon"},
             {"coordinates", Json::array({Json::array({closed(before, is_west ? 360.0 : 0.0)}),
                                          Json::array({closed(beyond, is_west ? 0.0 : -360.0)})})}};
}

}  // namespace sigmascape::atlas
