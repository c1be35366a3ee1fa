#include "sigmascape/scene/land_cover_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <variant>

#include "sigmascape/base/machine_memory.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/scene/partner_key.h"
#include "sigmascape/scene/vector_section.h"

namespace sigmascape::scene {
namespace {

/// A class of ESA WorldCover as the radar sees it: with everything that stands there, and as the bare ground beneath.
struct WorldCoverClass {
  std::int32_t code;
  const char* aggregate;
  const char* ground;
  enum class Holds { Nothing, Trees, Buildings } holds;
};

using Holds = WorldCoverClass::Holds;
constexpr WorldCoverClass world_cover[] = {
    {10, "forest", "forest_floor", Holds::Trees}, {20, "shrubs", "shrubs", Holds::Nothing},
    {30, "grass", "grass", Holds::Nothing},       {40, "crops", "crops", Holds::Nothing},
    {50, "urban", "asphalt", Holds::Buildings},   {60, "bare_soil", "bare_soil", Holds::Nothing},
    {70, "snow", "snow", Holds::Nothing},         {80, "water", "water", Holds::Nothing},
    {90, "grass", "grass", Holds::Nothing},   // herbaceous wetland
    {95, "forest", "water", Holds::Trees},    // mangroves
    {100, "grass", "grass", Holds::Nothing},  // moss and lichen
};

const char* material_name(const WorldCoverClass& entry, const std::string& scatter_as, ExplicitObjects objects) {
  if (scatter_as == "ground") return entry.ground;
  if (scatter_as == "aggregate") return entry.aggregate;
  const bool stands_there_itself =
      (entry.holds == Holds::Trees && objects.trees) || (entry.holds == Holds::Buildings && objects.buildings);
  return stands_there_itself ? entry.ground : entry.aggregate;
}

std::int32_t class_code(const TomlSection& classes, const std::string& key) {
  std::int32_t code = 0;
  const auto [end, fault] = std::from_chars(key.data(), key.data() + key.size(), code);
  if (fault != std::errc() || end != key.data() + key.size()) {
    throw classes.fault(key, "is not a class code", "use the whole numbers that the raster holds as keys");
  }
  return code;
}

constexpr std::int32_t world_cover_water = 80;

/// By its name, its model of a sea, or its mirrors of water.
bool is_water_itself(const scatter::Material& material) {
  const auto* mirrors = std::get_if<scatter::CookTorranceParameters>(&material.model);
  return material.name == "water" || std::holds_alternative<scatter::NrlSeaParameters>(material.model) ||
         std::holds_alternative<scatter::GitSeaParameters>(material.model) ||
         (mirrors != nullptr && std::holds_alternative<scatter::WaterPermittivity>(mirrors->permittivity.law()));
}

/// Whether trees stand in it and roads are laid on it as little as on the sea: as it is, or as what it starts from.
bool is_water(const scatter::Material& material, const MaterialTable& materials) {
  const auto base = materials.base_of(material.name);
  return is_water_itself(material) || (base && is_water_itself(scatter::library_material(*base)));
}

constexpr double most_cells = 1e9;
constexpr double bytes_a_cell = sizeof(std::int32_t) + sizeof(MaterialIndex) + sizeof(std::uint8_t);

radar::GroundGrid material_grid(const radar::Rectangle& extent, double cell_m, const std::string& name) {
  const double columns = std::ceil(extent.width_m() / cell_m - 1e-6),
               rows = std::ceil(extent.height_m() / cell_m - 1e-6);
  const double cells = columns * rows, fit = std::min(most_cells, machine_memory_bytes() / bytes_a_cell);
  if (!(cells <= fit)) {
    throw Error(name, fmt::format("would make {:.2g} cells of {:g} m", cells, cell_m),
                fmt::format("choose a cell_m of {:.3g} or more in [land_cover], for cells that memory holds",
                            cell_m * std::sqrt(cells / fit) * 1.01));
  }
  return {extent.west_m, extent.north_m, cell_m, static_cast<std::size_t>(columns), static_cast<std::size_t>(rows)};
}

/// Codes of classes, [column, row] of the scene's material map.
using ClassMap = Array2D<std::int32_t>;
using CellsOfClass = std::map<std::int32_t, std::size_t>;

ClassMap classes_on(const radar::GroundGrid& grid, const geo::Raster& raster, const geo::LocalFrame& frame) {
  const Vec2d first = grid.centre_of(0, 0);
  return raster.classes_on({first.x, first.y, grid.cell_m, grid.columns, grid.rows}, frame);
}

CellsOfClass counted(const ClassMap& classes, const std::string& name) {
  CellsOfClass cells;
  for (const std::int32_t code : classes.values()) ++cells[code];
  if (cells[geo::no_class] == classes.size()) {
    throw Error(name, "holds no class anywhere in the scene's extent",
                "give a land cover raster that overlaps the terrain");
  }
  return cells;
}

/// What the classes that occur are made of; those without a material are tallied and left out.
std::map<std::int32_t, MaterialIndex> materials_of(const CellsOfClass& cells, const LandCoverSource& source,
                                                   Scene& scene, FlawTally& tally) {
  std::map<std::int32_t, MaterialIndex> materials;
  for (const auto& [code, count] : cells) {
    const auto listed = source.materials.find(code);
    if (listed != source.materials.end()) {
      materials[code] = scene.material_index(listed->second);
      if (source.built_in.contains(code)) {
        tally.note("cells of classes that [land_cover.classes] does not list, given the materials of ESA WorldCover",
                   fmt::format("class {}, {}", code, listed->second.name), count);
      }
    } else if (code == geo::no_class) {
      tally.note("cells of land cover without data, given the nodata material", source.nodata.name, count);
    } else {
      tally.flaw("cells of a class without a material, given the nodata material", fmt::format("class {}", code),
                 count);
    }
  }
  return materials;
}

/// More of the scene than this without land cover is no strip along its edge any more.
constexpr double notable_share_beyond = 0.03;

/// The share of cells whose middles lie outside the box about a raster.
double share_beyond(const radar::GroundGrid& grid, const geo::Extent& raster) {
  std::size_t columns = 0, rows = 0;
  for (std::size_t column = 0; column < grid.columns; ++column) {
    const double x = grid.centre_of(column, 0).x;
    columns += x >= raster.west_m && x <= raster.east_m ? 1 : 0;
  }
  for (std::size_t row = 0; row < grid.rows; ++row) {
    const double y = grid.centre_of(0, row).y;
    rows += y >= raster.south_m && y <= raster.north_m ? 1 : 0;
  }
  return 1.0 - static_cast<double>(columns * rows) / static_cast<double>(grid.columns * grid.rows);
}

/// The stated size of cells, or one of the data's own that the scene has room for.
double fitting_cell_m(const LandCoverSource& source, double own_cell_m, const radar::Rectangle& extent) {
  const double shorter_m = std::min(extent.width_m(), extent.height_m());
  if (!source.cell_m) return std::min(own_cell_m, shorter_m);
  if (*source.cell_m <= shorter_m) return *source.cell_m;
  throw Error(
      source.where + ".cell_m",
      fmt::format("is {:g} m in a scene of {:.0f} × {:.0f} m", *source.cell_m, extent.width_m(), extent.height_m()),
      "choose cells that the scene has room for");
}

void lay(const ClassMap& classes, const std::map<std::int32_t, MaterialIndex>& materials,
         Array2D<MaterialIndex>& ground) {
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const auto found = materials.find(classes.values()[i]);
    if (found != materials.end()) ground.values()[i] = found->second;
  }
}

WaterMask water_in(const ClassMap& classes, const std::vector<std::int32_t>& water_classes) {
  const std::set<std::int32_t> codes(water_classes.begin(), water_classes.end());
  WaterMask water(classes.columns(), classes.rows(), 0);
  std::ranges::transform(classes.values(), water.values().begin(),
                         [&](std::int32_t code) -> std::uint8_t { return codes.contains(code) ? 1 : 0; });
  return water;
}

}  // namespace

LandCoverSource read_land_cover_source(const TomlSection& section, const MaterialTable& materials,
                                       ExplicitObjects objects, const FlawLimit& limit) {
  LandCoverSource source;
  source.where = section.where();
  if (const auto file = section.optional_file("file")) {
    source.raster = geo::RasterBand{*file, static_cast<int>(section.whole_number_or("band", {1, 10000, ""}, 1)),
                                    section.text_or("crs", "")};
  }
  for (const char* key : {"band", "crs"}) refuse_without(section, key, "file", source.raster.has_value());
  if (source.raster && !source.raster->crs.empty())
    geo::require_known_reference(source.raster->crs, section.where("crs"));
  source.cell_m = section.optional_number("cell_m", {0.05, 10000.0, "m"});
  source.nodata = materials.named_by(section, "nodata_material", "grass");
  source.limit = read_flaw_limit(section, limit);

  const std::string scatter_as = section.choice_or("scatter_as", {"auto", "ground", "aggregate"}, "auto");
  for (const WorldCoverClass& entry : world_cover) {
    source.materials[entry.code] =
        materials.material(material_name(entry, scatter_as, objects), "the built-in class table");
  }
  if (const auto classes = section.section("classes")) {
    for (const WorldCoverClass& entry : world_cover) source.built_in.insert(entry.code);
    for (const std::string& key : classes->keys()) {
      const std::int32_t code = class_code(*classes, key);
      source.materials[code] = materials.material(classes->text(key), classes->where(key));
      source.built_in.erase(code);
      if (is_water(source.materials[code], materials)) source.water_classes.push_back(code);
    }
  }
  if (section.has("water_classes")) {
    source.water_classes.clear();
    for (const double code : section.numbers("water_classes", {-1e9, 1e9, ""})) {
      if (code != std::floor(code))
        throw section.fault("water_classes", fmt::format("holds {:g}", code), "give the whole numbers of classes");
      source.water_classes.push_back(static_cast<std::int32_t>(code));
    }
  } else if (is_water(source.materials[world_cover_water], materials)) {
    source.water_classes.push_back(world_cover_water);
  }
  section.refuse_unknown_keys();
  return source;
}

LandCoverSource default_land_cover(const MaterialTable& materials) {
  LandCoverSource source;
  source.nodata = materials.material("grass", "the ground without [land_cover]");
  return source;
}

WaterMask add_land_cover(Scene& scene, const LandCoverSource& source) {
  const std::string name = source.raster ? source.raster->file.string() : "[land_cover]";
  std::optional<geo::Raster> raster;
  if (source.raster) raster.emplace(*source.raster);
  const double own_cell_m = raster ? raster->cell_m(scene.frame, scene.extent.centre()) : scene.terrain.spacing_m;
  const radar::GroundGrid grid = material_grid(scene.extent, fitting_cell_m(source, own_cell_m, scene.extent), name);
  scene.ground.grid = grid;
  scene.ground.material = Array2D<MaterialIndex>(grid.columns, grid.rows, scene.material_index(source.nodata));
  if (!raster) return {grid.columns, grid.rows, 0};

  const ClassMap classes = classes_on(grid, *raster, scene.frame);
  const CellsOfClass cells = counted(classes, name);
  FlawTally tally;
  lay(classes, materials_of(cells, source, scene, tally), scene.ground.material);
  const double beyond = share_beyond(grid, raster->outline_in(scene.frame).extent_around());
  if (beyond > notable_share_beyond) {
    tally.mistake(
        fmt::format("land cover that does not reach over {:.2g} % of the scene, which has the nodata material",
                    100.0 * beyond),
        source.nodata.name);
  }
  tally.settle(name, classes.size(), source.limit, scene.remarks);
  return water_in(classes, source.water_classes);
}

bool in_water(const radar::GroundGrid& grid, const WaterMask& water, Vec2d point) {
  if (water.empty() || !grid.extent().contains(point)) return false;
  const Vec2d cells = grid.cells_from(point);
  return water(std::min(static_cast<std::size_t>(cells.x), grid.columns - 1),
               std::min(static_cast<std::size_t>(cells.y), grid.rows - 1)) != 0;
}

}  // namespace sigmascape::scene
