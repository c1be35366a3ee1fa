#include "atlas_info.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <optional>
#include <system_error>
#include <vector>

#include "atlas_faults.h"
#include "command.h"
#include "number_or_null.h"
#include "power_error_text.h"
#include "words.h"

#include "sigmascape/atlas/atlas_summary.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/terrain/pyramid_faults.h"

namespace sigmascape::cli {
namespace {

std::vector<double> degrees(const std::vector<double>& angles_rad) {
  std::vector<double> angles_deg(angles_rad.size());
  std::ranges::transform(angles_rad, angles_deg.begin(),
                         [](double angle_rad) { return std::round(deg_from_radians(angle_rad) * 1e9) / 1e9; });
  return angles_deg;
}

/// What is missing of the terrain, in one piece and in tiles.
std::vector<atlas::StoreFault> terrain_faults(const atlas::Store& atlas, const atlas::AtlasSummary& summary) {
  std::vector<atlas::StoreFault> faults = in_list(summary.terrain_fault);
  std::ranges::move(tile_faults(atlas, terrain::missing_files), std::back_inserter(faults));
  return faults;
}

/// Null where no look tells of anything that answers.
nlohmann::ordered_json json_of(const atlas::PowerErrors& errors) {
  const auto spread = errors.spread();
  return {{"mean", number_or_null(errors.relative())},
          {"smallest", spread ? number_or_null(spread->smallest) : nullptr},
          {"largest", spread ? number_or_null(spread->largest) : nullptr}};
}

nlohmann::ordered_json json_of(const atlas::AtlasSummary::Files& files) {
  return {{"files", files.planned}, {"files_done", files.done}};
}

/// How many files a layer has nobody knows without its collection.
nlohmann::ordered_json json_of(const atlas::AtlasSummary::Layer& layer) {
  nlohmann::ordered_json json = json_of(layer.textures);
  if (layer.fault) json["files"] = nullptr;
  json["faults"] = cli::json_of(in_list(layer.fault));
  return json;
}

nlohmann::ordered_json json_of(const atlas::AtlasSummary::Buildings& buildings) {
  return {{"faults", cli::json_of(in_list(buildings.fault))},
          {"textures", buildings.textures ? json_of(*buildings.textures) : nullptr}};
}

/// Null of what this atlas is not to have.
template <typename Part>
nlohmann::ordered_json json_of(const std::optional<Part>& part) {
  return part ? json_of(*part) : nullptr;
}

std::string errors_text(const atlas::AtlasSummary& summary) {
  if (summary.looks_done == 0) return "none yet";
  if (summary.errors.empty()) return "not told by what is there";
  std::string text = error_text(summary.errors);
  if (const auto spread = summary.errors.spread(); spread) {
    const auto percent = [](double error) { return fmt::format("{:.1f} %", 100.0 * error); };
    const std::string smallest = percent(spread->smallest), largest = percent(spread->largest);
    if (smallest != largest) text += fmt::format(", {} to {} by look", smallest, largest);
  }
  if (summary.looks_told < summary.looks_done) {
    text += fmt::format(" (told by {} of {}; the others were baked by an earlier program)", summary.looks_told,
                        counted(summary.looks_done, "look", "looks"));
  }
  return text;
}

/// "k of n files, those above the patches included".
std::string files_text(const atlas::AtlasSummary::Files& files) {
  return fmt::format("{} of {}, those above the patches included", files.done, counted(files.planned, "file", "files"));
}

/// The first of them for all.
std::string faults_text(const std::vector<atlas::StoreFault>& faults) {
  const atlas::StoreFault& first = faults.front();
  return fmt::format("{} {}{}", first.file.string(), first.what,
                     faults.size() == 1 ? "" : fmt::format(", and {} more like it", faults.size() - 1));
}

std::string layer_text(const atlas::AtlasSummary::Layer& layer) {
  return layer.fault ? faults_text({*layer.fault}) : files_text(layer.textures);
}

}  // namespace

nlohmann::ordered_json json_of(const atlas::Store& store, const atlas::AtlasSummary& summary) {
  const atlas::AtlasDescription& atlas = store.description();
  return {{"name", atlas.name},
          {"crs", atlas.frame.proj()},
          {"extent_m", {atlas.extent.west_m, atlas.extent.south_m, atlas.extent.east_m, atlas.extent.north_m}},
          {"texel_m", atlas.patches.texel_m},
          {"texels_per_side", atlas.patches.texels_per_side},
          {"patches", summary.patches},
          {"azimuths_deg", degrees(atlas.aspects.azimuths_rad)},
          {"elevations_deg", degrees(atlas.aspects.elevations_rad)},
          {"frequencies_hz", atlas.aspects.frequencies_hz},
          {"looks", summary.looks},
          {"looks_done", summary.looks_done},
          {"pyramid",
           {{"levels", summary.pyramid_levels},
            {"textures", summary.pyramid.planned},
            {"textures_done", summary.pyramid.done}}},
          {"obstacles", json_of(summary.obstacles)},
          {"ground", json_of(summary.ground)},
          {"buildings", json_of(summary.buildings)},
          {"terrain", {{"faults", cli::json_of(terrain_faults(store, summary))}}},
          {"bytes", summary.bytes},
          {"bytes_per_look", summary.bytes_per_look},
          {"relative_standard_error", json_of(summary.errors)},
          {"above_target", number_or_null(summary.errors.part_above_target())},
          {"part_of_all", number_or_null(summary.errors.part_of_all())},
          {"looks_told", summary.looks_told},
          {"mantissa_bits", atlas.mantissa_bits},
          {"digits", atlas::word_for(atlas.digits)},
          {"settings", atlas.settings},
          {"scene_hash", atlas.scene_hash},
          {"attribution", atlas.attribution}};
}

std::string text_of(const atlas::Store& store, const atlas::AtlasSummary& summary) {
  const atlas::AtlasDescription& atlas = store.description();
  std::string text = fmt::format("{}\n", atlas.name);
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("  {:<18}{}\n", name, value);
  };
  const geo::GeographicPosition middle = geo::place_on_globe(atlas.frame, atlas.extent.centre());
  line("extent", fmt::format("{:.0f} m x {:.0f} m about {:.5f} N, {:.5f} E", atlas.extent.width_m(),
                             atlas.extent.height_m(), middle.latitude_deg, middle.longitude_deg));
  line("patches", fmt::format("{} of {} x {} texels of {:g} m", summary.patches, atlas.patches.texels_per_side,
                              atlas.patches.texels_per_side, atlas.patches.texel_m));
  line("azimuths", fmt::format("{:g}°", fmt::join(degrees(atlas.aspects.azimuths_rad), "°, ")));
  line("elevations", fmt::format("{:g}°", fmt::join(degrees(atlas.aspects.elevations_rad), "°, ")));
  std::vector<double> frequencies_ghz = atlas.aspects.frequencies_hz;
  for (double& frequency : frequencies_ghz) frequency /= 1e9;
  line("frequencies", fmt::format("{:g} GHz", fmt::join(frequencies_ghz, ", ")));
  line("looks done", fmt::format("{} of {}", summary.looks_done, summary.looks));
  line("looks above", fmt::format("{} of {} in {} above the patches", summary.pyramid.done,
                                  counted(summary.pyramid.planned, "file", "files"),
                                  counted(summary.pyramid_levels, "level", "levels")));
  if (summary.obstacles) line("obstacles", files_text(*summary.obstacles));
  if (summary.ground) line("ground", layer_text(*summary.ground));
  if (const auto& buildings = summary.buildings) {
    if (buildings->textures) line("buildings' looks", layer_text(*buildings->textures));
    line("buildings", buildings->fault ? faults_text({*buildings->fault}) : "all there");
  }
  const std::vector<atlas::StoreFault> of_terrain = terrain_faults(store, summary);
  line("terrain", of_terrain.empty() ? "all there" : faults_text(of_terrain));
  line("size",
       fmt::format("{}, {} a look", size_text(static_cast<double>(summary.bytes)), size_text(summary.bytes_per_look)));
  line("error", errors_text(summary));
  if (const std::string part = above_target_text(summary.errors); !part.empty()) line("above target", part);
  for (const auto& [name, value] : atlas.settings) line(name, value);
  line("mantissa bits", fmt::format("{}{}", atlas.mantissa_bits,
                                    atlas.digits == atlas::Digits::ToNoise ? ", fewer where noise drowns them" : ""));
  line("scene hash", atlas.scene_hash);
  if (!atlas.attribution.empty()) line("data", atlas.attribution);
  text.pop_back();
  return text;
}

}  // namespace sigmascape::cli
