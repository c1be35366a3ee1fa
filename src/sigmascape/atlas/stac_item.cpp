#include "sigmascape/atlas/stac_item.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/error_texture.h"
#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/stac_document.h"
#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/coordinate_reference_system.h"

namespace sigmascape::atlas {
namespace {

double rounded(double value, double step) {
  return std::round(value / step) * step;
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

/// Where an item stands: what it covers, and what lies above it.
struct ItemPlace {
  Footprint footprint;
  std::string root, collection, parent;
};

/// In the folder of a place.
ItemPlace place_of(const AtlasDescription& description, const PyramidTile& tile) {
  return {Footprint(description, texels_of(description.patches, tile)), href_from(tile, root_of(description)),
          href_from(tile, collection_name), fmt::format("./{}", catalog_name)};
}

/// Beside the collection, of a file of these cells.
ItemPlace beside_collection(const AtlasDescription& description, const radar::GroundGrid& cells) {
  const std::string collection = fmt::format("./{}", collection_name);
  return {Footprint(description, cells), collection, collection, collection};
}

constexpr const char* own_hash = "sigmascape:item_sha256";
/// Of items of looks: those of the bake, as the collection has them.
constexpr const char* settings = "sigmascape:settings";
/// Of items of all files; those without it are of the first.
constexpr const char* physics_revision = "sigmascape:physics_revision";
constexpr const char* mantissa_bits = "sigmascape:mantissa_bits";
constexpr const char* kept_digits = "sigmascape:digits";
/// Of items of patches: PowerError.
constexpr const char* mean_power = "sigmascape:mean_power";
constexpr const char* mean_standard_error = "sigmascape:mean_standard_error";
constexpr const char* mean_power_above_target = "sigmascape:mean_power_above_target";
constexpr const char* mean_ground_power = "sigmascape:mean_ground_power";

/// What is wrong with an item by its own hash; empty when nothing is.
std::string fault_by_own_hash(const std::string& text, int format_version) {
  const Seal seal = seal_of(text, own_hash);
  if (seal == Seal::Broken) return broken_seal;
  return seal == Seal::Fits || format_version < 2 ? "" : "was altered: it does not record its own SHA-256";
}

/// What the item beside a file of a store is called: "patch_+000_-001_az045.0_el13.0_f10.000GHz".
std::string id_beside(std::filesystem::path file) {
  std::string id = file.replace_extension().generic_string();
  std::ranges::replace(id, '/', '_');
  return id;
}

/// What tells that an item was made for another file of such an atlas; empty when nothing does.
std::string fault_by_place(const Json& item, const std::filesystem::path& file) {
  const std::string there = item.value("id", ""), here = id_beside(file);
  return there == here ? "" : fmt::format("is of {} and stands in the place of {}", there, here);
}

/// The settings by which a look was baked, as far as an item tells that does not hold them all.
std::map<std::string, std::string> settings_told_by(const Json& properties) {
  std::map<std::string, std::string> told;
  if (properties.contains("sigmascape:seed")) told["seed"] = properties.at("sigmascape:seed").dump();
  if (properties.contains("sigmascape:simd")) told["simd"] = properties.at("sigmascape:simd").get<std::string>();
  return told;
}

std::string of_another_bake(std::string_view name, const std::string& there, const std::string& here) {
  return fmt::format("is of another bake: {} is {} there and {} in the collection", name, there, here);
}

/// What tells that a look was baked by other settings than those of this atlas; empty when nothing does. A setting that
/// only one of the two has differs too: an atlas tells of none that it was baked without.
std::string fault_by_settings(const Json& properties, const std::map<std::string, std::string>& here) {
  const bool tells_all = properties.contains(settings);
  const auto there =
      tells_all ? properties.at(settings).get<std::map<std::string, std::string>>() : settings_told_by(properties);
  std::map<std::string, std::string> names = there;
  if (tells_all) names.insert(here.begin(), here.end());
  names.erase(std::string(physics_revision_setting));
  for (const auto& [name, ignored] : names) {
    const auto one = there.find(name), other = here.find(name);
    const bool is_there = one != there.end(), is_here = other != here.end();
    if (is_there && is_here && one->second == other->second) continue;
    if (!tells_all && !is_here) continue;
    return of_another_bake(name, is_there ? one->second : "not given", is_here ? other->second : "not given");
  }
  return "";
}

/// What tells that an item is of a look that names of files take for one of this atlas; empty when nothing does.
std::string fault_by_look(const Json& properties, const AspectGrid& aspects) {
  const auto fault = [&](const char* name, const std::vector<double>& axis, auto unit_of) {
    const std::string key = fmt::format("sigmascape:{}", name);
    if (!properties.contains(key)) return std::string();
    const auto there = properties.at(key).get<double>();
    // As closely as a number comes back from radians.
    const auto is_there = [&](double value) { return std::abs(unit_of(value) - there) <= 1e-8 * (1.0 + there); };
    if (std::ranges::any_of(axis, is_there)) return std::string();
    return fmt::format("is of another bake: {} is {} there, which the collection does not have", name, there);
  };
  for (const std::string& told :
       {fault("azimuth_deg", aspects.azimuths_rad, tidy_deg), fault("elevation_deg", aspects.elevations_rad, tidy_deg),
        fault("frequency_hz", aspects.frequencies_hz, std::identity())}) {
    if (!told.empty()) return told;
  }
  return "";
}

/// What tells that an item is of other texels than lie at its place in this atlas; empty when nothing does.
std::string fault_by_texel(const Json& properties, const PatchGrid& patches) {
  if (!properties.contains("gsd") || !properties.contains("proj:shape")) return "";
  const auto level = properties.value("sigmascape:pyramid_level", std::size_t{0});
  constexpr std::size_t highest_level = 30;  // that patches can be counted under
  if (level > highest_level) return "cannot be understood";
  const auto [x, y] = properties.at("sigmascape:patch").get<std::array<int, 2>>();
  const radar::GroundGrid here = texels_of(patches, {level, {x, y}});
  const auto texel_m = properties.at("gsd").get<double>();
  if (std::abs(texel_m - here.cell_m) > 1e-9 * here.cell_m)
    return of_another_bake("gsd", fmt::format("{}", texel_m), fmt::format("{}", here.cell_m));
  const Json shape = {here.rows, here.columns};
  const Json& there = properties.at("proj:shape");
  return there == shape ? "" : of_another_bake("proj:shape", there.dump(), shape.dump());
}

/// What tells that an item's texels were rounded otherwise than those of this atlas; empty when nothing does.
std::string fault_by_digits(const Json& properties, const AtlasDescription& description) {
  const int bits = properties.value(mantissa_bits, description.mantissa_bits);
  if (bits != description.mantissa_bits)
    return of_another_bake("mantissa_bits", std::to_string(bits), std::to_string(description.mantissa_bits));
  const std::string here = word_for(description.digits), there = properties.value(kept_digits, here);
  return there == here ? "" : of_another_bake("digits", there, here);
}

/// What tells that an item does not belong to this atlas; empty when nothing does.
std::string fault_by_origin(const Json& properties, const AtlasDescription& description) {
  const std::string scene = properties.value("sigmascape:scene_hash", description.scene_hash);
  if (scene != description.scene_hash) return of_another_bake("scene_hash", scene, description.scene_hash);
  const std::string physics = properties.value(physics_revision, "1");
  if (physics != description.physics_revision())
    return of_another_bake(physics_revision_setting, physics, description.physics_revision());
  std::string fault = fault_by_settings(properties, description.settings);
  if (fault.empty()) fault = fault_by_look(properties, description.aspects);
  if (fault.empty()) fault = fault_by_digits(properties, description);
  return fault.empty() ? fault_by_texel(properties, description.patches) : fault;
}

std::string item_of(const std::string& id, const AtlasDescription& description, const ItemPlace& place,
                    const Json& extensions, Json properties, const Json& assets) {
  properties[own_hash] = "";
  if (description.settings.contains(physics_revision_setting))
    properties[physics_revision] = description.physics_revision();
  const Json item = {
      {"type", "Feature"},
      {"stac_version", stac_version},
      {"stac_extensions", extensions},
      {"id", id},
      {"collection", description.name},
      {"geometry", place.footprint.polygon},
      {"bbox", place.footprint.box},
      {"properties", properties},
      {"assets", assets},
      {"links",
       Json::array({link("root", place.root), link("parent", place.parent), link("collection", place.collection)})},
  };
  return sealed(written(item, 2) + "\n", own_hash);
}

/// Nothing when these are not properties of ours.
std::optional<TextureRecord> record_from(const Json& properties) {
  const auto is = [&](const char* key, auto has_type) {
    return properties.contains(key) && (properties.at(key).*has_type)();
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
  if (is(mean_power, &Json::is_number) && is(mean_standard_error, &Json::is_number)) {
    record.error = {.power = properties.at(mean_power).get<double>(),
                    .standard_error = properties.at(mean_standard_error).get<double>()};
    if (is(mean_power_above_target, &Json::is_number))
      record.error->above_target = properties.at(mean_power_above_target).get<double>();
    if (is(mean_ground_power, &Json::is_number))
      record.error->ground_power = properties.at(mean_ground_power).get<double>();
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

}  // namespace

std::string item_text(const AtlasDescription& description, const Unit& unit, const std::filesystem::path& texture_file,
                      const TextureRecord& record, const BakeFacts& facts) {
  const radar::GroundGrid grid = description.patches.texels_of(unit.patch);
  const radar::Look look = description.aspects.look(unit.look);
  Json properties = common_properties(description, grid, look);
  properties.update(Json{
      {"sigmascape:patch", {unit.patch.x, unit.patch.y}},
      {"sigmascape:scene_hash", description.scene_hash},
      {settings, Json(description.settings)},
      {"sigmascape:seed", facts.seed},
      {"sigmascape:samples_per_texel", facts.samples_per_texel},
      {"sigmascape:simd", facts.simd},
      {"sigmascape:counts", Json(facts.counts)},
      {"sigmascape:scale", record.scale},
      {mantissa_bits, description.mantissa_bits},
      {kept_digits, word_for(description.digits)},
      {"sigmascape:size_bytes", record.size_bytes},
      {"sigmascape:sha256", record.sha256},
      {"sigmascape:attribution", description.attribution},
  });
  if (facts.error) {
    properties[mean_power] = facts.error->power;
    properties[mean_standard_error] = facts.error->standard_error;
    if (facts.error->above_target) properties[mean_power_above_target] = *facts.error->above_target;
    if (facts.error->ground_power > 0.0) properties[mean_ground_power] = facts.error->ground_power;
  }
  Json assets = {{"sigma0", sigma0_asset(grid.cell_m, texture_file, record)}};
  if (record.errors) {
    properties["sigmascape:errors_size_bytes"] = record.errors->size_bytes;
    properties["sigmascape:errors_sha256"] = record.errors->sha256;
    assets["errors"] = errors_asset(texture_file, *record.errors);
  }
  return item_of(patch_name(unit.patch) + "_" + look_name(look), description, place_of(description, {0, unit.patch}),
                 extensions(look), properties, assets);
}

std::string pyramid_item_text(const AtlasDescription& description, const PyramidTile& tile, LookIndex look_index,
                              const std::filesystem::path& texture_file, const TextureRecord& record) {
  const radar::GroundGrid grid = texels_of(description.patches, tile);
  const radar::Look look = description.aspects.look(look_index);
  Json properties = common_properties(description, grid, look);
  properties.update(pyramid_properties(tile));
  properties.update(file_properties(description, record));
  return item_of(place_name(tile) + "_" + look_name(look), description, place_of(description, tile), extensions(look),
                 properties, {{"sigma0", sigma0_asset(grid.cell_m, texture_file, record)}});
}

std::string obstacles_item_text(const AtlasDescription& description, const PyramidTile& tile,
                                const std::filesystem::path& file, const TextureRecord& record) {
  const radar::GroundGrid grid = texels_of(description.patches, tile);
  Json properties = timeless();
  properties.update(place_properties(description, grid));
  properties["gsd"] = grid.cell_m;
  if (tile.level == 0) {
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
  return item_of(place_name(tile) + "_obstacles", description, place_of(description, tile), extensions, properties,
                 {{"obstacles", asset}});
}

std::string terrain_item_text(const AtlasDescription& description, const radar::GroundGrid& cells,
                              const TextureRecord& record) {
  Json properties = timeless();
  properties.update(place_properties(description, cells));
  properties.update(file_properties(description, record));
  return item_of("terrain", description, beside_collection(description, cells), place_extensions(), properties,
                 {{"terrain", file_asset(terrain_name, "Heights of the ground in metres, orthometric", cloud_optimised,
                                         "data", record)}});
}

std::string buildings_item_text(const AtlasDescription& description, const TextureRecord& record) {
  const radar::GroundGrid whole = whole_grid(description);
  Json properties = timeless();
  properties.update(place_properties(description, whole));
  properties.update(file_properties(description, record));
  return item_of("buildings", description, beside_collection(description, whole), place_extensions(), properties,
                 {{"buildings", file_asset(buildings_name, "Walls and roofs, and what they return by angle",
                                           "model/gltf-binary", "data", record)}});
}

FoundItem item_from(const std::string& text, const AtlasDescription& description, const std::filesystem::path& file) {
  const Json item = Json::parse(text, nullptr, false);
  const FoundItem none{{}, "cannot be understood"};
  if (!item.is_object() || !item.contains("properties") || !item.at("properties").is_object()) return none;
  const Json& properties = item.at("properties");
  const auto record = record_from(properties);
  if (!record) return none;
  std::string fault = fault_by_own_hash(text, description.format_version);
  try {
    if (fault.empty()) fault = fault_by_place(item, file);
    if (fault.empty()) fault = fault_by_origin(properties, description);
  } catch (const Json::exception&) {
    return none;
  }
  if (!fault.empty()) return {{}, std::move(fault)};
  return {record, ""};
}

}  // namespace sigmascape::atlas
