#include "sigmascape/atlas/stac_description.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <vector>

#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/stac_document.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::atlas {
namespace {

constexpr int oldest_format_version = 1;

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
  if (json.value("digits", "all") == word_for(Digits::ToNoise)) description.digits = Digits::ToNoise;
  description.attribution = json.at("attribution").get<std::string>();
  description.format_version = json.at("format_version").get<int>();
  return description;
}

/// What differs between two objects, inside nested ones too; first of all the scene.
std::vector<std::string> differences(const Json& there, const Json& here, const std::string& prefix) {
  std::vector<std::string> found;
  for (const auto& [key, value] : there.items()) {
    const std::string name = prefix + key;
    if (!here.contains(key)) {
      found.push_back(fmt::format("{} is {} there and not given here", name, value.dump()));
      continue;
    }
    const Json& other = here.at(key);
    if (value == other) continue;
    if (value.is_object() && other.is_object()) {
      std::ranges::move(differences(value, other, name + "."), std::back_inserter(found));
      continue;
    }
    const std::string values = fmt::format("{} is {} there and {} here", name, value.dump(), other.dump());
    if (name == "scene_hash") {
      found.insert(found.begin(), "its scene is another one (terrain, objects or materials differ): " + values);
    } else {
      found.push_back(values);
    }
  }
  for (const auto& [key, value] : here.items()) {
    if (!there.contains(key))
      found.push_back(fmt::format("{}{} is not given there and {} here", prefix, key, value.dump()));
  }
  return found;
}

}  // namespace

Json described(const AtlasDescription& description) {
  const radar::Rectangle& extent = description.extent;
  Json json = {
      {"format_version", description.format_version},
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
  // Absent where all are kept, as in atlases from before.
  if (description.digits == Digits::ToNoise) json["digits"] = word_for(Digits::ToNoise);
  return json;
}

AtlasDescription description_from(const std::string& text, const std::filesystem::path& file) {
  constexpr const char* remedy =
      "remove this one file and bake again with the same settings, which writes it anew and keeps what is baked";
  const auto damaged = [&] {
    return Error(file.string(), "is truncated or was altered, and does not tell what this atlas is of", remedy);
  };
  const Json collection = Json::parse(text, nullptr, false);
  if (!collection.is_object()) throw damaged();
  try {
    if (!collection.contains("sigmascape:atlas")) {
      throw Error(file.string(), "is not the collection of a Sigmascape atlas",
                  "choose the folder of an atlas, or an empty one to bake into");
    }
    const Json& atlas = collection.at("sigmascape:atlas");
    const int version = atlas.at("format_version").get<int>();
    if (version < oldest_format_version || version > newest_format_version) {
      throw Error(
          file.string() + ", sigmascape:atlas.format_version", fmt::format("is {}", version),
          fmt::format("this version of the library reads {} to {}: bake again, or use the version that wrote it",
                      oldest_format_version, newest_format_version));
    }
    AtlasDescription description = undescribed(collection.at("id").get<std::string>(), atlas);
    if (seal_of(text, collection_hash) == Seal::Broken) throw Error(file.string(), broken_seal, remedy);
    return description;
  } catch (const Json::exception&) {
    throw damaged();
  }
}

std::optional<std::string> difference(const AtlasDescription& there, const AtlasDescription& here) {
  // Both as they would stand in a file, since only that can be compared with what was read from one.
  const auto as_read = [](AtlasDescription description) {
    description.format_version = newest_format_version;
    description.settings[physics_revision_setting] = description.physics_revision();
    return Json::parse(written(described(description), -1));
  };
  std::vector<std::string> found = differences(as_read(there), as_read(here), "");
  if (found.empty()) return std::nullopt;
  constexpr std::size_t most_named = 3;
  if (found.size() > most_named) {
    found[most_named] = fmt::format("{} more", found.size() - most_named);
    found.resize(most_named + 1);
  }
  return fmt::format("{}", fmt::join(found, ", and "));
}

}  // namespace sigmascape::atlas
