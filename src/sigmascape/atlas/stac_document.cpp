#include "sigmascape/atlas/stac_document.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

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

Footprint::Footprint(const AtlasDescription& description, const radar::GroundGrid& grid) {
  const auto corners = geo::geographic_corners({grid.west_m, grid.north_m, grid.cell_m, description.frame.proj()},
                                               grid.columns, grid.rows);
  double west = corners[0].x, south = corners[0].y, east = west, north = south;
  Json ring = Json::array();
  for (const std::size_t i : {0U, 1U, 2U, 3U, 0U}) {
    const double longitude = std::round(corners[i].x * 1e9) / 1e9;
    const double latitude = std::round(corners[i].y * 1e9) / 1e9;
    ring.push_back({longitude, latitude});
    west = std::min(west, longitude);
    east = std::max(east, longitude);
    south = std::min(south, latitude);
    north = std::max(north, latitude);
  }
  polygon = {{"type", "Polygon"}, {"coordinates", Json::array({ring})}};
  box = {west, south, east, north};
}

}  // namespace sigmascape::atlas
