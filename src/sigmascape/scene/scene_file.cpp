#include "sigmascape/scene/scene_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <vector>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/scene/building_reader.h"
#include "sigmascape/scene/land_cover_reader.h"
#include "sigmascape/scene/material_reader.h"
#include "sigmascape/scene/mesh_reader.h"
#include "sigmascape/scene/paper_scene.h"
#include "sigmascape/scene/partner_key.h"
#include "sigmascape/scene/point_target_reader.h"
#include "sigmascape/scene/road_reader.h"
#include "sigmascape/scene/scene_extent.h"
#include "sigmascape/scene/tree_reader.h"
#include "sigmascape/scene/vector_section.h"
#include "sigmascape/scene/water_level.h"
#include "sigmascape/terrain/terrain_reader.h"

namespace sigmascape::scene {
namespace {

/// Where the water of the land cover is to be laid flat.
struct WaterLevel {
  double level_m = 0.0;
  double within_m = 10.0;
};

struct TerrainSection {
  terrain::TerrainSource source;
  std::optional<WaterLevel> water;
  FlawLimit limit;
};

/// All that a scene file says, before any of the data that it names are read.
struct SceneDescription {
  std::string name;
  std::string attribution;
  ScenePlace place;
  MaterialTable materials;
  TerrainSection terrain;
  LandCoverSource land_cover;
  std::vector<BuildingSource> buildings;
  std::vector<TreeSource> trees;
  std::vector<RoadSource> roads;
  std::vector<MeshSource> meshes;
  std::vector<PointTargetSource> point_targets;
};

TerrainSection read_terrain_section(const TomlSection& section, const FlawLimit& limit) {
  TerrainSection terrain;
  terrain::TerrainSource& source = terrain.source;
  source.raster = {section.file("file"), static_cast<int>(section.whole_number_or("band", {1, 10000, ""}, 1)),
                   section.text_or("crs", "")};
  if (!source.raster.crs.empty()) geo::require_known_reference(source.raster.crs, section.where("crs"));
  if (section.has("unit")) source.raster.unit = section.choice_or("unit", {"m", "cm", "ft", "us-ft"}, "m");
  source.where = section.where();
  source.spacing_m = section.optional_number("spacing_m", {0.1, 10000.0, "m"});
  source.smooth_within_m = section.number_or("smooth_within_m", {0.0, 100.0, "m"}, 0.0);
  constexpr Interval heights{-12000.0, 9000.0, "m"};
  source.plausible.lowest_m = section.number_or("lowest_plausible_m", heights, source.plausible.lowest_m);
  source.plausible.highest_m = section.number_or("highest_plausible_m", heights, source.plausible.highest_m);
  if (source.plausible.lowest_m >= source.plausible.highest_m) {
    throw section.fault("lowest_plausible_m", "is not below highest_plausible_m", "exchange the two, or leave one out");
  }
  const auto level_m = section.optional_number("water_level_m", {-500.0, 9000.0, "m"});
  const auto within_m = section.optional_number("water_within_m", {0.0, 1000.0, "m"});
  if (level_m) terrain.water = WaterLevel{*level_m, within_m.value_or(WaterLevel{}.within_m)};
  terrain.limit = read_flaw_limit(section, limit);
  source.largest_hole_share = terrain.limit.max_share;
  section.refuse_unknown_keys();
  refuse_without(section, "water_within_m", "water_level_m", level_m.has_value());
  return terrain;
}

template <typename Read>
auto read_each(const TomlSection& root, std::string_view key, const Read& read) {
  std::vector<decltype(read(root))> sources;
  for (const TomlSection& section : root.sections(key)) sources.push_back(read(section));
  return sources;
}

/// Under which maps and atlases go, on one line each.
std::string read_name(const TomlSection& section, const std::string& name_of_file) {
  const std::string name = section.text_or("name", name_of_file);
  if (name.empty()) throw section.fault("name", "is empty", "give a name, or leave the key out");
  const auto is_control = [](char c) { return (c >= '\0' && c < ' ') || c == '\x7f'; };
  if (std::ranges::any_of(name, is_control))
    throw section.fault("name", "holds a line break or another control character", "write the name on one line");
  return name;
}

SceneDescription read_description(const std::filesystem::path& toml) {
  const TomlSection root = TomlSection::read_file(toml);
  SceneDescription described;
  FlawLimit limit;
  described.name = toml.stem().string();
  if (const auto section = root.section("scene")) {
    described.name = read_name(*section, described.name);
    described.attribution = section->text_or("attribution", "");
    described.place = read_scene_place(*section);
    limit.strict = section->flag_or("strict", false);
    limit.max_share = section->number_or("max_flawed_share", {0.0, 1.0, ""}, limit.max_share);
    section->refuse_unknown_keys();
  }
  const MaterialTable& materials = described.materials = MaterialTable(root);
  described.buildings = read_each(
      root, "buildings", [&](const TomlSection& section) { return read_building_source(section, materials, limit); });
  described.trees =
      read_each(root, "trees", [&](const TomlSection& section) { return read_tree_source(section, materials, limit); });
  described.roads =
      read_each(root, "roads", [&](const TomlSection& section) { return read_road_source(section, materials, limit); });
  described.meshes = read_each(root, "meshes",
                               [&](const TomlSection& section) { return read_mesh_source(section, materials, limit); });
  described.point_targets = read_each(root, "point_targets", read_point_target_source);
  const ExplicitObjects objects{!described.trees.empty(), !described.buildings.empty()};
  const auto land_cover = root.section("land_cover");
  described.land_cover =
      land_cover ? read_land_cover_source(*land_cover, materials, objects, limit) : default_land_cover(materials);
  const auto terrain = root.section("terrain");
  root.refuse_unknown_keys();
  if (!terrain)
    throw Error(toml.string() + ": terrain", "is missing", "add [terrain] with file = the path of an elevation raster");
  described.terrain = read_terrain_section(*terrain, limit);
  if (described.terrain.water && !described.land_cover.raster) {
    throw terrain->fault("water_level_m", "levels nothing without land_cover.file, which says where water is",
                         "add [land_cover] with its file, or leave it out");
  }
  return described;
}

/// A scene that is made up, not read: [paper] stands for the paper's example landscape and leaves no room for data.
std::optional<PaperSceneOptions> read_paper_options(const TomlSection& root) {
  const auto section = root.section("paper");
  if (!section) return std::nullopt;
  PaperSceneOptions options;
  options.scale = section->number_or("scale", {0.1, 5.0, ""}, options.scale);
  options.seed = static_cast<std::uint64_t>(section->whole_number_or("seed", {0, 1e15, ""}, 1));
  options.materials =
      section->choice_or("materials", {"paper", "itu"}, "paper") == "itu" ? PaperMaterials::Itu : PaperMaterials::Paper;
  section->refuse_unknown_keys();
  root.refuse_unknown_keys();
  return options;
}

/// More of the raster of heights than this is no strip along its edges any more.
constexpr double notable_share_left_out = 0.03;

/// Returns where the terrain had no heights and was filled.
terrain::NodeMask add_terrain(Scene& scene, const SceneDescription& described) {
  const auto& [source, water, limit] = described.terrain;
  scene.frame = frame_of(described.place, source.raster);
  terrain::ReadTerrain read = terrain::read_terrain(source, scene.frame, extent_in(described.place, scene.frame));
  const std::string which = fmt::format("band {}", source.raster.band);
  FlawTally tally;
  if (read.unit_is_guess) {
    tally.mistake(
        "terrain without a unit of heights on a map in feet, taken to be in metres "
        "([terrain] unit = \"ft\" or \"us-ft\" says otherwise)",
        which);
  }
  if (read.left_out_share > notable_share_left_out) {
    tally.note(fmt::format("raster of heights that lies aslant, of which the scene, without an extent the largest "
                           "upright rectangle within, leaves out {:.2g} %",
                           100.0 * read.left_out_share),
               which);
  }
  tally.flaw("terrain nodes without data or with implausible heights, interpolated", which, read.filled_nodes);
  tally.settle(source.raster.file.string(), read.field.height_m.size(), limit, scene.remarks);
  scene.terrain = std::move(read.field);
  scene.extent = scene.terrain.extent();
  return std::move(read.filled);
}

/// More of the terrain than this is no hole or two any more.
constexpr double notable_share_of_holes = 0.03;

/// Slopes and shadows of ground that nobody measured are made up: told where the extent is hardly meant to reach
/// beyond the raster, and where holes are large. Water that was laid flat needs no heights.
void note_made_up_ground(Scene& scene, const SceneDescription& described, const terrain::NodeMask& filled) {
  const auto& heights_m = scene.terrain.height_m.values();
  std::size_t beyond = 0, within = 0;
  for (std::size_t node = 0; node < filled.size(); ++node) {
    const bool is_water =
        described.terrain.water && heights_m[node] == static_cast<float>(described.terrain.water->level_m);
    if (is_water) continue;
    if (filled.values()[node] == terrain::in_a_hole) ++within;
    if (filled.values()[node] == terrain::beyond_the_raster) ++beyond;
  }
  const auto share = [&](std::size_t nodes) { return static_cast<double>(nodes) / static_cast<double>(filled.size()); };
  FlawTally tally;
  const std::string which = fmt::format("band {}", described.terrain.source.raster.band);
  if (beyond > 0) {
    tally.mistake(fmt::format("extent that reaches beyond the raster of heights, whose edge {:.2g} % of the terrain is "
                              "made up from",
                              100.0 * share(beyond)),
                  which);
  }
  if (share(within) > notable_share_of_holes) {
    tally.mistake(fmt::format("raster of heights with holes, whose edges {:.2g} % of the terrain is made up from",
                              100.0 * share(within)),
                  which);
  }
  tally.settle(described.terrain.source.raster.file.string(), filled.size(), described.terrain.limit, scene.remarks);
}

void note_level_without_water(Scene& scene, const SceneDescription& described, const WaterLevel& level) {
  FlawTally tally;
  tally.mistake(fmt::format("water level that levels nothing: no water of the land cover lies within {:g} m of it",
                            level.within_m),
                fmt::format("{:g} m", level.level_m));
  tally.settle(described.terrain.source.raster.file.string(), 1, described.terrain.limit, scene.remarks);
}

void note_unused_materials(Scene& scene, const MaterialTable& materials, const std::filesystem::path& toml) {
  FlawTally tally;
  for (const std::string& name : materials.unasked())
    tally.mistake("materials of the file that nothing is made of", fmt::format("[materials.{}]", name));
  tally.settle(toml.string(), 1, {}, scene.remarks);
}

}  // namespace

Scene read_scene(const std::filesystem::path& toml) {
  if (const auto options = read_paper_options(TomlSection::read_file(toml))) return paper_scene(*options);
  const SceneDescription described = read_description(toml);
  Scene scene;
  scene.name = described.name;
  scene.attribution = described.attribution;
  const terrain::NodeMask filled = add_terrain(scene, described);
  const WaterMask water = add_land_cover(scene, described.land_cover);
  if (const auto& level = described.terrain.water) {
    const std::size_t levelled =
        level_water(scene.terrain, filled, scene.ground.grid, water, level->level_m, level->within_m);
    if (levelled == 0) note_level_without_water(scene, described, *level);
  }
  note_made_up_ground(scene, described, filled);
  // Objects stand on the terrain, so they come after it is finished; roads paint the ground before anything needs to
  // know it.
  for (const RoadSource& roads : described.roads) add_roads(scene, roads, water);
  add_buildings(scene, described.buildings);
  for (const TreeSource& trees : described.trees) add_trees(scene, trees, water);
  for (const MeshSource& mesh : described.meshes) add_mesh(scene, mesh, described.materials);
  for (const PointTargetSource& target : described.point_targets) add_point_target(scene, target);
  note_unused_materials(scene, described.materials, toml);
  return scene;
}

}  // namespace sigmascape::scene
