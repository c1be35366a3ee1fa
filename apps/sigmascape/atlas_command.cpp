#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <optional>
#include <system_error>
#include <vector>

#include "command.h"
#include "number_or_null.h"
#include "number_within.h"
#include "power_error_text.h"
#include "standard_error.h"
#include "terminal_progress.h"
#include "word_option.h"
#include "words.h"

#include "sigmascape/atlas/atlas_summary.h"
#include "sigmascape/atlas/layer_store.h"
#include "sigmascape/atlas/levels_above.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/atlas/verify.h"
#include "sigmascape/bake/claims.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/raster.h"
#include "sigmascape/terrain/extent_about.h"
#include "sigmascape/terrain/height_difference.h"
#include "sigmascape/terrain/height_field_file.h"
#include "sigmascape/terrain/pyramid_builder.h"

namespace sigmascape::cli {
namespace {

std::vector<double> degrees(const std::vector<double>& angles_rad) {
  std::vector<double> angles_deg(angles_rad.size());
  std::ranges::transform(angles_rad, angles_deg.begin(),
                         [](double angle_rad) { return std::round(deg_from_radians(angle_rad) * 1e9) / 1e9; });
  return angles_deg;
}

nlohmann::ordered_json json_of(const std::vector<atlas::StoreFault>& faults) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const atlas::StoreFault& fault : faults) {
    list.push_back({{"file", fault.file.string()}, {"fault", fault.what}});
  }
  return list;
}

/// What is wrong with the tiles of the terrain, by file of the atlas. `faults_in` tells it of their folder. The ground
/// of an atlas has none of its own.
template <typename FaultsIn>
std::vector<atlas::StoreFault> tile_faults(const atlas::Store& atlas, const FaultsIn& faults_in) {
  if (atlas::is_layer_of_an_atlas(atlas.description())) return {};
  const std::filesystem::path name = atlas::terrain_pyramid_name;
  std::error_code error;
  if (!std::filesystem::exists(atlas.folder() / name, error) && !error) return {{name / "", "is missing", true}};
  std::vector<atlas::StoreFault> faults;
  for (const terrain::PyramidFault& fault : faults_in(atlas.folder() / name))
    faults.push_back({name / fault.file, fault.what});
  return faults;
}

std::vector<atlas::StoreFault> in_list(const std::optional<atlas::StoreFault>& fault) {
  return fault ? std::vector{*fault} : std::vector<atlas::StoreFault>{};
}

/// What is missing of the terrain, in one piece and in tiles.
std::vector<atlas::StoreFault> terrain_faults(const atlas::Store& atlas, const atlas::AtlasSummary& summary) {
  std::vector<atlas::StoreFault> faults = in_list(summary.terrain_fault);
  std::ranges::move(tile_faults(atlas, terrain::missing_files), std::back_inserter(faults));
  return faults;
}

void verify(const std::string& folder, const Output& output) {
  const atlas::Store store = atlas::Store::open(folder);
  TerminalProgress progress;
  std::vector<atlas::StoreFault> faults = atlas::verify(store, atlas::Scrutiny::Content, &progress);
  const std::size_t texture_faults = faults.size();
  const auto verified = [&](const std::filesystem::path& tiles) {
    return terrain::verify_pyramid(tiles, store.description().frame);
  };
  std::ranges::move(tile_faults(store, verified), std::back_inserter(faults));
  std::string text;
  for (const atlas::StoreFault& fault : faults) text += fmt::format("{} {}\n", fault.file.string(), fault.what);
  const std::size_t looks = store.unit_count();
  const bool is_one = faults.size() == 1;
  text += faults.empty()
              ? fmt::format("{}, all whole and as recorded", counted(looks, "look", "looks"))
              : fmt::format(
                    "{} fault{} in {}; 'sigmascape bake … --verify' mends {}{}", faults.size(), is_one ? "" : "s",
                    folder, is_one ? "it" : "them",
                    faults.size() > texture_faults ? ", and 'sigmascape atlas terrain' the terrain that it made" : "");
  output.finish(text, {{"atlas", folder}, {"looks", looks}, {"faults", json_of(faults)}});
  if (!faults.empty()) end_with(1);
}

std::string written_text(const atlas::LevelsAbove::Written& written) {
  std::string text = fmt::format("{} above the patches written", counted(written.all(), "file", "files"));
  if (written.all() == written.looks) return text + (written.looks > 0 ? ", all of looks" : "");
  const std::string of_buildings =
      written.buildings > 0 ? fmt::format(", {} of buildings", written.buildings) : std::string();
  return text + fmt::format(": {} of looks{}, {} of obstacles and {} of ground", written.looks, of_buildings,
                            written.obstacles, written.ground);
}

/// What could not be made and why, to stand behind what was.
std::string left_out_text(const atlas::LevelsAbove& made) {
  if (made.left_out == 0) return "";
  const std::size_t files = made.hindrances.size();
  if (files == 0) return fmt::format("; {} left out; call it again", made.left_out);
  const atlas::StoreFault& first = made.hindrances.front();
  return fmt::format("; {} left out for want of {} file{} of patches ({} {}{}); {}", made.left_out, files,
                     files == 1 ? "" : "s", first.file.string(), first.what, files == 1 ? "" : ", …",
                     atlas::bake_again);
}

void make_pyramid(const std::string& folder, const Output& output) {
  const atlas::LevelsAbove made = atlas::make_levels_above(atlas::Store::open(folder));
  output.finish(written_text(made.written) + left_out_text(made), {{"atlas", folder},
                                                                   {"written", made.written.all()},
                                                                   {"looks", made.written.looks},
                                                                   {"obstacles", made.written.obstacles},
                                                                   {"ground", made.written.ground},
                                                                   {"buildings", made.written.buildings},
                                                                   {"left_out", made.left_out},
                                                                   {"because", json_of(made.hindrances)}});
  if (made.left_out > 0) end_with(1);
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
  json["faults"] = json_of(in_list(layer.fault));
  return json;
}

nlohmann::ordered_json json_of(const atlas::AtlasSummary::Buildings& buildings) {
  return {{"faults", json_of(in_list(buildings.fault))},
          {"textures", buildings.textures ? json_of(*buildings.textures) : nullptr}};
}

/// Null of what this atlas is not to have.
template <typename Part>
nlohmann::ordered_json json_of(const std::optional<Part>& part) {
  return part ? json_of(*part) : nullptr;
}

nlohmann::ordered_json summary_of(const atlas::Store& store, const atlas::AtlasSummary& summary) {
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
          {"terrain", {{"faults", json_of(terrain_faults(store, summary))}}},
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

/// Where there can be terrain. Live frames look at the atlas' own ground first of all.
radar::Rectangle extent_of_terrain(const terrain::TerrainSource& source, const geo::Raster& heights,
                                   const geo::LocalFrame& frame, const radar::Rectangle& atlas) {
  if (const auto about = terrain::extent_about(heights, frame, atlas))
    return {about->west_m, about->south_m, about->east_m, about->north_m};
  const geo::Extent around = heights.outline_in(frame).extent_around();
  const std::string place = std::isfinite(around.east_m)
                                ? fmt::format(
                                      "{:.0f} to {:.0f} m east and {:.0f} to {:.0f} m north of the atlas' "
                                      "origin, and ",
                                      around.west_m, around.east_m, around.south_m, around.north_m)
                                : "";
  throw Error(source.raster.file.string(), fmt::format("lies {}nowhere over the atlas", place),
              fmt::format("give terrain over {:.0f} to {:.0f} m east and {:.0f} to {:.0f} m north", atlas.west_m,
                          atlas.east_m, atlas.south_m, atlas.north_m));
}

/// Before the work, which may be long.
void warn_of_guessed_unit(const terrain::TerrainSource& source, const geo::Raster& heights) {
  if (!heights.height_unit().is_guess) return;
  warn(fmt::format(
      "{}: states no unit of heights on a map in feet, taken to be in metres; --unit ft or us-ft says otherwise",
      source.raster.file.string()));
}

/// Live frames stand on the tiles, inside the scene as well. What was baked there belongs to the scene's own heights,
/// and where these are more than a texel away the ground has other slopes and shadows. At a few places they may be: no
/// raster has every edge of another.
void warn_of_other_heights(const atlas::Store& store, const std::string& raster, terrain::TerrainPyramid& tiles) {
  if (atlas::terrain_fault(store, atlas::Scrutiny::Content)) return;
  const auto baked = terrain::read_height_field(atlas::vouched_terrain(store, atlas::Scrutiny::Size));
  const auto apart = terrain::height_difference(tiles, baked, store.description().extent);
  if (!apart || apart->nearly_all_m <= store.description().patches.texel_m) return;
  warn(fmt::format(
      "{}: lies up to {:.1f} m above or below the heights that the atlas was baked on, {:.1f} m in the median; live "
      "frames stand on it inside the scene too: lay the scene's own elevation over it, and give --spacing {:.3g}",
      raster, apart->greatest_m, apart->median_m, baked.spacing_m));
}

/// Heights from a raster about the atlas, in tiles beside it.
void build_terrain(const std::string& folder, terrain::TerrainSource source, double no_data_height_m,
                   const Output& output) {
  const atlas::Store store = atlas::Store::open(folder);
  const geo::LocalFrame& frame = store.description().frame;
  const geo::Raster heights(source.raster);
  const radar::Rectangle reach = extent_of_terrain(source, heights, frame, store.description().extent);
  warn_of_guessed_unit(source, heights);
  // Cells of degrees are of other sizes at the far ends of what the raster reaches.
  if (!source.spacing_m) source.spacing_m = heights.cell_m(frame, store.description().extent.centre());
  const auto pyramid = std::filesystem::path(folder) / atlas::terrain_pyramid_name;
  // Two at once would take each other's unfinished files for those of other heights.
  const bake::Claims claims(folder);
  TerminalProgress progress;
  const bake::Claims::Claim claim = claims.take(bake::terrain_claim(store.description()), [&progress] {
    progress.waiting("terrain", "a bake that makes that of the atlas");
  });
  const terrain::PyramidBuild build = terrain::build_pyramid(pyramid, source, frame, reach, no_data_height_m);
  terrain::TerrainPyramid built = terrain::open_pyramid(pyramid, 0);
  warn_of_other_heights(store, source.raster.file.string(), built);
  const terrain::PyramidLayout& layout = built.layout();
  const radar::Rectangle extent = built.extent();
  std::string text = fmt::format("{}, {} x {} tiles of {} cells of {:g} m: {:.0f} m x {:.0f} m; {} written",
                                 counted(layout.levels(), "level", "levels"), layout.tiles_across, layout.tiles_down,
                                 terrain::HeightTile::cells, layout.spacing_m, extent.width_m(), extent.height_m(),
                                 counted(build.tiles_written, "tile", "tiles"));
  if (build.nodes_without_height > 0) {
    text += fmt::format("\n{} no height in {} and {} at {:g} m: --no-data-height, or fill them first",
                        counted(build.nodes_without_height, "node has", "nodes have"),
                        source.raster.file.filename().string(), build.nodes_without_height == 1 ? "lies" : "lie",
                        no_data_height_m);
  }
  output.finish(text, {{"atlas", folder},
                       {"written", build.tiles_written},
                       {"nodes_without_height", build.nodes_without_height},
                       {"levels", layout.levels()},
                       {"tiles", {layout.tiles_across, layout.tiles_down}},
                       {"spacing_m", layout.spacing_m},
                       {"extent_m", {extent.west_m, extent.south_m, extent.east_m, extent.north_m}}});
}

void add_terrain_command(Command added, const std::shared_ptr<std::string>& folder, Output& output) {
  const auto source = std::make_shared<terrain::TerrainSource>();
  const auto spacing_m = std::make_shared<double>(0.0);
  const auto no_data_height_m = std::make_shared<double>(0.0);
  added.add_option("RASTER", source->raster.file, "elevation in any format that GDAL reads").required();
  added.add_option("--band", source->raster.band, "band of the raster").capture_default_str();
  added.add_option("--crs", source->raster.crs, "instead of the raster's own coordinate system");
  add_word_option(added, "--unit", source->raster.unit, {{"m", "m"}, {"cm", "cm"}, {"ft", "ft"}, {"us-ft", "us-ft"}},
                  "unit of heights, instead of the raster's own");
  added
      .add_option("--spacing", *spacing_m,
                  "metres between heights; the raster's own cell in the atlas' middle if not given")
      .check(number_within(0.01, 1e5));
  added.add_option("--no-data-height", *no_data_height_m, "height in metres where the raster has none")
      .capture_default_str()
      .check(number_within(-12'000.0, 10'000.0));
  added.callback([folder, source, spacing_m, no_data_height_m, &output] {
    if (*spacing_m > 0.0) source->spacing_m = *spacing_m;
    build_terrain(*folder, *source, *no_data_height_m, output);
  });
}

}  // namespace

void add_atlas_command(Command app, Output& output) {
  const auto command = app.add_subcommand("atlas", "Look after an atlas of baked textures");
  command.require_subcommand(1);
  auto folder = std::make_shared<std::string>();
  const auto subcommand = [&](const char* name, const char* description, const char* example) {
    const auto added = command.add_subcommand(name, description);
    added.add_option("FOLDER", *folder, "folder of the atlas").required();
    added.add_flag("--json", output.json, "print as JSON");
    added.footer(fmt::format("Example:\n  sigmascape atlas {}", example));
    return added;
  };
  subcommand("info", "Print axes, patches, which files are there, size, errors, settings and sources",
             "info out/bilbao_atlas")
      .callback([folder, &output] {
        const atlas::Store store = atlas::Store::open(*folder);
        const atlas::AtlasSummary summary = atlas::summary_of(store);
        output.finish(text_of(store, summary), summary_of(store, summary));
      });
  subcommand(
      "verify",
      "Compare every file, the terrain's tiles included, with its recorded SHA-256; ends with 1 when one is missing or "
      "differs",
      "verify out/bilbao_atlas")
      .callback([folder, &output] { verify(*folder, output); });
  subcommand("pyramid",
             "Make what is missing of the levels above the patches, from the patches that are there; ends with 1 if "
             "not all can be",
             "pyramid out/bilbao_atlas")
      .callback([folder, &output] { make_pyramid(*folder, output); });
  add_terrain_command(subcommand("terrain",
                                 "Put terrain of any size beside the atlas, in tiles, for live frames that look beyond "
                                 "the scene; tiles that are there and whole are left",
                                 "terrain out/bilbao_atlas dem.tif --spacing 10"),
                      folder, output);
}

}  // namespace sigmascape::cli
