#include "sigmascape/atlas/stac.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "sigmascape/atlas/error_texture.h"
#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/geotiff.h"

namespace sigmascape::atlas {
namespace {

using Json = nlohmann::ordered_json;

constexpr int format_version = 1;
constexpr const char* stac_version = "1.0.0";
/// STAC wants a time for everything. A bake has none, and a clock in it would make equal bakes differ.
constexpr const char* no_time = "1970-01-01T00:00:00Z";

double rounded(double value, double step) {
  return std::round(value / step) * step;
}

/// Degrees as a person would have typed them, so that radians → degrees → radians comes back to the same number.
double tidy_deg(double angle_rad) {
  return std::round(deg_from_radians(angle_rad) * 1e9) / 1e9;
}

std::vector<double> degrees(const std::vector<double>& angles_rad) {
  std::vector<double> angles_deg(angles_rad.size());
  std::ranges::transform(angles_rad, angles_deg.begin(), tidy_deg);
  return angles_deg;
}

std::vector<double> radians(const std::vector<double>& angles_deg) {
  std::vector<double> angles_rad(angles_deg.size());
  std::ranges::transform(angles_deg, angles_rad.begin(), radians_from_deg);
  return angles_rad;
}

/// Text that is not UTF-8 (an old attribution, say) gets replacement characters rather than an exception.
std::string written(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json described(const AtlasDescription& description) {
  const radar::Rectangle& extent = description.extent;
  return {
      {"format_version", format_version},
      {"frame_latitude_deg", description.frame.latitude_deg()},
      {"frame_longitude_deg", description.frame.longitude_deg()},
      {"frame", description.frame.proj()},
      {"extent_m", {extent.west_m, extent.south_m, extent.east_m, extent.north_m}},
      {"texel_m", description.patches.texel_m},
      {"texels_per_side", description.patches.texels_per_side},
      {"azimuths_deg", degrees(description.aspects.azimuths_rad)},
      {"elevations_deg", degrees(description.aspects.elevations_rad)},
      {"frequencies_hz", description.aspects.frequencies_hz},
      {"scene_hash", description.scene_hash},
      {"settings", Json(description.settings)},
      {"mantissa_bits", description.mantissa_bits},
      {"attribution", description.attribution},
  };
}

AtlasDescription undescribed(const std::string& name, const Json& json) {
  AtlasDescription description;
  description.name = name;
  description.frame = {json.at("frame_latitude_deg").get<double>(), json.at("frame_longitude_deg").get<double>()};
  const auto extent = json.at("extent_m").get<std::array<double, 4>>();
  description.extent = {extent[0], extent[1], extent[2], extent[3]};
  description.patches = {json.at("texel_m").get<double>(), json.at("texels_per_side").get<std::size_t>()};
  description.aspects.azimuths_rad = radians(json.at("azimuths_deg").get<std::vector<double>>());
  description.aspects.elevations_rad = radians(json.at("elevations_deg").get<std::vector<double>>());
  description.aspects.frequencies_hz = json.at("frequencies_hz").get<std::vector<double>>();
  description.scene_hash = json.at("scene_hash").get<std::string>();
  description.settings = json.at("settings").get<std::map<std::string, std::string>>();
  description.mantissa_bits = json.at("mantissa_bits").get<int>();
  description.attribution = json.at("attribution").get<std::string>();
  return description;
}

/// The first difference between two objects, looked for inside nested ones too.
std::optional<std::string> first_difference(const Json& there, const Json& here, const std::string& prefix) {
  for (const auto& [key, value] : there.items()) {
    const std::string name = prefix + key;
    if (!here.contains(key)) return fmt::format("{} is {} there and not given here", name, value.dump());
    const Json& other = here.at(key);
    if (value == other) continue;
    if (value.is_object() && other.is_object()) return first_difference(value, other, name + ".");
    return fmt::format("{} is {} there and {} here", name, value.dump(), other.dump());
  }
  for (const auto& [key, value] : here.items()) {
    if (!there.contains(key)) return fmt::format("{}{} is not given there and {} here", prefix, key, value.dump());
  }
  return std::nullopt;
}

/// A ring of longitudes and latitudes. Nine decimals of a degree are a tenth of a millimetre.
struct Footprint {
  Json polygon, box;

  Footprint(const AtlasDescription& description, const radar::GroundGrid& grid) {
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
};

/// All patches as one grid of texels.
radar::GroundGrid whole_grid(const AtlasDescription& description) {
  const auto patches = description.patches.covering(description.extent);
  const radar::GroundGrid first = description.patches.texels_of(patches.front());
  const auto columns = static_cast<std::size_t>(patches.back().x - patches.front().x + 1) * first.columns;
  const auto rows = static_cast<std::size_t>(patches.front().y - patches.back().y + 1) * first.rows;
  return {first.west_m, first.north_m, first.cell_m, columns, rows};
}

/// Letters of IEEE 521 that the SAR extension of STAC knows; empty elsewhere.
std::string_view band_letter(double frequency_hz) {
  struct Band {
    double from_hz, to_hz;
    std::string_view letter;
  };
  static constexpr std::array<Band, 8> bands{{{0.25e9, 0.5e9, "P"},
                                              {1e9, 2e9, "L"},
                                              {2e9, 4e9, "S"},
                                              {4e9, 8e9, "C"},
                                              {8e9, 12e9, "X"},
                                              {12e9, 18e9, "Ku"},
                                              {18e9, 27e9, "K"},
                                              {27e9, 40e9, "Ka"}}};
  for (const Band& band : bands) {
    if (frequency_hz >= band.from_hz && frequency_hz < band.to_hz) return band.letter;
  }
  return {};
}

Json link(const char* relation, const std::string& target) {
  return {{"rel", relation}, {"href", target}, {"type", "application/json"}};
}

Json look_properties(double texel_m, const radar::Look& look) {
  Json properties = {
      {"gsd", texel_m},
      {"view:azimuth", tidy_deg(wrapped_azimuth(look.aspect.azimuth_rad + pi))},
      {"view:incidence_angle", rounded(90.0 - tidy_deg(look.aspect.elevation_rad), 1e-9)},
      {"sigmascape:azimuth_deg", tidy_deg(look.aspect.azimuth_rad)},
      {"sigmascape:elevation_deg", tidy_deg(look.aspect.elevation_rad)},
      {"sigmascape:frequency_hz", look.frequency_hz},
  };
  const std::string_view letter = band_letter(look.frequency_hz);
  if (!letter.empty()) {
    properties["sar:instrument_mode"] = "simulated";
    properties["sar:frequency_band"] = letter;
    properties["sar:center_frequency"] = look.frequency_hz / 1e9;
    properties["sar:polarizations"] = {"VV", "HH", "HV", "VH"};
    properties["sar:product_type"] = "sigma0";
  }
  return properties;
}

constexpr const char* raster_extension = "https://stac-extensions.github.io/raster/v1.1.0/schema.json";

Json place_extensions() {
  return {"https://stac-extensions.github.io/projection/v2.0.0/schema.json",
          "https://stac-extensions.github.io/file/v2.1.0/schema.json"};
}

Json extensions(const radar::Look& look) {
  Json list = place_extensions();
  list.push_back("https://stac-extensions.github.io/view/v1.0.0/schema.json");
  list.push_back(raster_extension);
  if (!band_letter(look.frequency_hz).empty()) {
    list.push_back("https://stac-extensions.github.io/sar/v1.0.0/schema.json");
  }
  return list;
}

Json place_properties(const AtlasDescription& description, const radar::GroundGrid& grid) {
  return {
      {"proj:code", nullptr},
      {"proj:wkt2", geo::wkt2_from(description.frame.proj())},
      {"proj:shape", {grid.rows, grid.columns}},
      {"proj:transform", {grid.cell_m, 0.0, grid.west_m, 0.0, -grid.cell_m, grid.north_m}},
  };
}

constexpr const char* cloud_optimised = "image/tiff; application=geotiff; profile=cloud-optimized";

/// A file beside the item, of which `record` tells size and SHA-256.
template <typename Record>
Json file_asset(const std::filesystem::path& file, const char* title, const char* type, const char* role,
                const Record& record) {
  // A multihash: 0x12 is SHA-256, 0x20 its length in bytes.
  return {{"href", "./" + file.filename().string()},
          {"title", title},
          {"type", type},
          {"roles", {role}},
          {"file:size", record.size_bytes},
          {"file:checksum", "1220" + record.sha256}};
}

Json texture_asset(double texel_m, const std::filesystem::path& file, const char* title, const TextureRecord& record) {
  const Json band = {
      {"data_type", "float16"}, {"scale", record.scale}, {"offset", 0.0}, {"spatial_resolution", texel_m}};
  Json asset = file_asset(file, title, cloud_optimised, "data", record);
  asset["raster:bands"] = {band, band, band, band};
  return asset;
}

Json sigma0_asset(double texel_m, const std::filesystem::path& file, const TextureRecord& record) {
  return texture_asset(texel_m, file, "Area reflectivity, bands VV, HH, HV (= VH) and Re<S_VV S_HH*>", record);
}

Json errors_asset(const std::filesystem::path& texture_file, const ErrorsRecord& record) {
  return file_asset(
      errors_path(texture_file),
      "Relative standard error of VV + HH + 2 HV: 0.001 * 10^((code - 1) / 50), code 0 where nothing returns",
      "image/tiff; application=geotiff", "metadata", record);
}

Json timeless() {
  return {{"datetime", nullptr}, {"start_datetime", no_time}, {"end_datetime", no_time}};
}

/// What items of patches and of the pyramid say alike.
Json common_properties(const AtlasDescription& description, const radar::GroundGrid& grid, const radar::Look& look) {
  Json properties = timeless();
  properties.update(look_properties(grid.cell_m, look));
  properties.update(place_properties(description, grid));
  return properties;
}

/// What items of the pyramid say of their place.
Json pyramid_properties(const PyramidTile& tile) {
  return {
      {"sigmascape:pyramid_level", tile.level},
      {"sigmascape:patch", {tile.south_west.x, tile.south_west.y}},
      {"sigmascape:patches_per_side", 1 << tile.level},
  };
}

/// What items say of a file that no rays went into.
Json file_properties(const AtlasDescription& description, const TextureRecord& record) {
  Json properties = {{"sigmascape:scene_hash", description.scene_hash}};
  if (!record.made_from.empty()) properties["sigmascape:made_from"] = record.made_from;
  if (record.tallest_m) properties["sigmascape:tallest_m"] = *record.tallest_m;
  properties.update(Json{
      {"sigmascape:scale", record.scale},
      {"sigmascape:size_bytes", record.size_bytes},
      {"sigmascape:sha256", record.sha256},
      {"sigmascape:attribution", description.attribution},
  });
  return properties;
}

std::string item_of(const std::string& id, const AtlasDescription& description, const radar::GroundGrid& grid,
                    const Json& extensions, const Json& properties, const Json& assets, const std::string& collection) {
  const Footprint footprint(description, grid);
  const Json item = {
      {"type", "Feature"},
      {"stac_version", stac_version},
      {"stac_extensions", extensions},
      {"id", id},
      {"collection", description.name},
      {"geometry", footprint.polygon},
      {"bbox", footprint.box},
      {"properties", properties},
      {"assets", assets},
      {"links", Json::array({link("root", collection), link("parent", collection), link("collection", collection)})},
  };
  return written(item, 2) + "\n";
}

}  // namespace

std::string collection_text(const AtlasDescription& description) {
  const Footprint footprint(description, whole_grid(description));
  Json links = Json::array({link("root", "./collection.json")});
  const auto look_count = static_cast<LookIndex>(description.aspects.look_count());
  for (const PatchIndex& patch : description.patches.covering(description.extent)) {
    for (LookIndex look = 0; look < look_count; ++look) {
      links.push_back(
          link("item", fmt::format("./{}/{}.json", patch_name(patch), look_name(description.aspects.look(look)))));
    }
  }
  const Json collection = {
      {"type", "Collection"},
      {"stac_version", stac_version},
      {"stac_extensions", Json::array()},
      {"id", description.name},
      {"description",
       "Baked radar area reflectivity (sigma0, linear, per horizontal area) by patch and look. "
       "The dates are not times: bakes carry no clock."},
      {"license", "various"},
      {"extent",
       {{"spatial", {{"bbox", Json::array({footprint.box})}}},
        {"temporal", {{"interval", Json::array({{no_time, no_time}})}}}}},
      {"sigmascape:atlas", described(description)},
      {"links", links},
  };
  return written(collection, 2) + "\n";
}

AtlasDescription description_from(const std::string& text, const std::filesystem::path& file) {
  try {
    const Json collection = Json::parse(text);
    const Json& atlas = collection.at("sigmascape:atlas");
    const int version = atlas.at("format_version").get<int>();
    if (version != format_version) {
      throw Error(file.string() + ", sigmascape:atlas.format_version", fmt::format("is {}", version),
                  fmt::format("this version of the library reads {}: bake again, or use the version that wrote it",
                              format_version));
    }
    return undescribed(collection.at("id").get<std::string>(), atlas);
  } catch (const Json::exception& exception) {
    throw Error(file.string(), fmt::format("is not the collection of a Sigmascape atlas ({})", exception.what()),
                "choose the folder of an atlas, or an empty one to bake into");
  }
}

std::optional<std::string> difference(const AtlasDescription& there, const AtlasDescription& here) {
  // Both as they would stand in a file, since only that can be compared with what was read from one.
  const auto as_read = [](const AtlasDescription& description) {
    return Json::parse(written(described(description), -1));
  };
  return first_difference(as_read(there), as_read(here), "");
}

std::string item_text(const AtlasDescription& description, const Unit& unit, const std::filesystem::path& texture_file,
                      const TextureRecord& record, const BakeFacts& facts) {
  const radar::GroundGrid grid = description.patches.texels_of(unit.patch);
  const radar::Look look = description.aspects.look(unit.look);
  Json properties = common_properties(description, grid, look);
  properties.update(Json{
      {"sigmascape:patch", {unit.patch.x, unit.patch.y}},
      {"sigmascape:scene_hash", description.scene_hash},
      {"sigmascape:seed", facts.seed},
      {"sigmascape:samples_per_texel", facts.samples_per_texel},
      {"sigmascape:relative_standard_error", facts.relative_standard_error},
      {"sigmascape:simd", facts.simd},
      {"sigmascape:counts", Json(facts.counts)},
      {"sigmascape:scale", record.scale},
      {"sigmascape:mantissa_bits", description.mantissa_bits},
      {"sigmascape:size_bytes", record.size_bytes},
      {"sigmascape:sha256", record.sha256},
      {"sigmascape:attribution", description.attribution},
  });
  Json assets = {{"sigma0", sigma0_asset(grid.cell_m, texture_file, record)}};
  if (record.errors) {
    properties["sigmascape:errors_size_bytes"] = record.errors->size_bytes;
    properties["sigmascape:errors_sha256"] = record.errors->sha256;
    assets["errors"] = errors_asset(texture_file, *record.errors);
  }
  return item_of(patch_name(unit.patch) + "_" + look_name(look), description, grid, extensions(look), properties,
                 assets, "../collection.json");
}

std::string pyramid_item_text(const AtlasDescription& description, const PyramidTile& tile, LookIndex look_index,
                              const std::filesystem::path& texture_file, const TextureRecord& record) {
  const radar::GroundGrid grid = texels_of(description.patches, tile);
  const radar::Look look = description.aspects.look(look_index);
  Json properties = common_properties(description, grid, look);
  properties.update(pyramid_properties(tile));
  properties.update(file_properties(description, record));
  const std::string id = fmt::format("pyramid_{}_{}_{}", tile.level, patch_name(tile.south_west), look_name(look));
  return item_of(id, description, grid, extensions(look), properties,
                 {{"sigma0", sigma0_asset(grid.cell_m, texture_file, record)}}, "../../collection.json");
}

std::string obstacles_item_text(const AtlasDescription& description, const PyramidTile& tile,
                                const std::filesystem::path& file, const TextureRecord& record) {
  const bool is_patch = tile.level == 0;
  const radar::GroundGrid grid = texels_of(description.patches, tile);
  Json properties = timeless();
  properties.update(place_properties(description, grid));
  properties["gsd"] = grid.cell_m;
  if (is_patch) {
    properties["sigmascape:patch"] = {tile.south_west.x, tile.south_west.y};
  } else {
    properties.update(pyramid_properties(tile));
  }
  properties.update(file_properties(description, record));
  const Json asset = texture_asset(grid.cell_m, file,
                                   "What stands on the ground: top of solids, base and top of crowns in metres above "
                                   "it, extinction of crowns per metre",
                                   record);
  Json extensions = place_extensions();
  extensions.push_back(raster_extension);
  const std::string id = (is_patch ? "" : fmt::format("pyramid_{}_", tile.level)) + patch_name(tile.south_west);
  return item_of(id + "_obstacles", description, grid, extensions, properties, {{"obstacles", asset}},
                 is_patch ? "../collection.json" : "../../collection.json");
}

std::optional<TextureRecord> record_from(const std::string& text) {
  const Json item = Json::parse(text, nullptr, false);
  if (!item.is_object() || !item.contains("properties")) return std::nullopt;
  const Json& properties = item.at("properties");
  const auto is = [&](const char* key, auto has_type) {
    return properties.is_object() && properties.contains(key) && (properties.at(key).*has_type)();
  };
  if (!is("sigmascape:size_bytes", &Json::is_number_unsigned) || !is("sigmascape:sha256", &Json::is_string) ||
      !is("sigmascape:scale", &Json::is_number)) {
    return std::nullopt;
  }
  TextureRecord record{properties.at("sigmascape:size_bytes").get<std::uint64_t>(),
                       properties.at("sigmascape:sha256").get<std::string>(),
                       properties.at("sigmascape:scale").get<double>()};
  if (is("sigmascape:made_from", &Json::is_string)) {
    record.made_from = properties.at("sigmascape:made_from").get<std::string>();
  }
  if (is("sigmascape:relative_standard_error", &Json::is_number)) {
    record.relative_standard_error = properties.at("sigmascape:relative_standard_error").get<double>();
  }
  if (is("sigmascape:tallest_m", &Json::is_number)) {
    record.tallest_m = properties.at("sigmascape:tallest_m").get<float>();
  }
  if (is("sigmascape:errors_size_bytes", &Json::is_number_unsigned) &&
      is("sigmascape:errors_sha256", &Json::is_string)) {
    record.errors = {properties.at("sigmascape:errors_size_bytes").get<std::uint64_t>(),
                     properties.at("sigmascape:errors_sha256").get<std::string>()};
  }
  return record;
}

}  // namespace sigmascape::atlas
