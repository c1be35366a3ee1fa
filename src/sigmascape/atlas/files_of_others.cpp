#include "sigmascape/atlas/files_of_others.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/building_textures.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/stac_description.h"
#include "sigmascape/atlas/stac_document.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/geo/is_absent.h"

namespace sigmascape::atlas {
namespace {

/// Whether the item beside the terrain or the buildings is one of an atlas, of whatever format. What it vouches for may
/// be damaged.
bool is_item(const std::filesystem::path& file) {
  const auto text = text_of(file).text;
  if (!text) return false;
  const Json item = Json::parse(*text, nullptr, false);
  const auto properties = item.find("properties");
  return properties != item.end() && properties->contains("sigmascape:sha256");
}

bool is_collection(const std::filesystem::path& file) {
  try {
    static_cast<void>(description_from(text_of(file).text.value_or(""), file));
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Whether nothing is in the folder of a layer but what a store has. Places have names that nobody else gives.
bool is_layer(const std::filesystem::path& folder) {
  const auto is_of_store = [](const std::filesystem::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return name == collection_name
               ? is_collection(entry.path())
               : name.starts_with("patch_") || name.starts_with("pyramid_") || name.starts_with(".");
  };
  std::error_code is_no_folder;
  const std::filesystem::directory_iterator entries(folder, is_no_folder);
  return !is_no_folder && std::ranges::all_of(entries, is_of_store);
}

}  // namespace

std::optional<std::string> file_of_others(const std::filesystem::path& folder, const AtlasDescription& description) {
  const auto is_there = [&](const std::filesystem::path& name) { return !geo::is_absent(folder / name); };
  std::vector<std::filesystem::path> files = {terrain_name};
  if (keeps_buildings_apart(description)) files.emplace_back(buildings_name);
  for (const std::filesystem::path& file : files) {
    const std::filesystem::path item = item_path(file);
    for (const std::filesystem::path& name : {file, item}) {
      if (is_there(name) && !is_item(folder / item)) return name.string();
    }
  }
  // A pyramid of tiles begins with one heading and ends with the other, and is built anew within itself:
  // terrain/pyramid_files.h.
  const std::filesystem::path pyramid = terrain_pyramid_name;
  const auto begins_with = [&](const char* name) { return is_there(pyramid / name); };
  if (is_there(pyramid) && !begins_with("pyramid.toml") && !begins_with("unfinished.toml") &&
      !begins_with(".unfinished"))
    return pyramid.string();
  std::vector<std::filesystem::path> layers = {ground_folder};
  if (keeps_building_textures(description)) layers.emplace_back(building_textures_folder);
  for (const std::filesystem::path& layer : layers) {
    if (is_there(layer) && !is_layer(folder / layer)) return layer.string();
  }
  return std::nullopt;
}

}  // namespace sigmascape::atlas
