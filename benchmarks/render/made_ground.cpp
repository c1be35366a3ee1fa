#include "made_ground.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <vector>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/stac_document.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/terrain/terrain_pyramid.h"

namespace sigmascape::bench {
namespace {

/// 0.5 to 1.5, 1 in the mean.
float grain_at(std::size_t column, std::size_t row) {
  return 0.5F + unit_float(hashed(static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)));
}

constexpr atlas::PatchIndex written{0, 0};

void write_patch(const atlas::Store& store) {
  const std::size_t side = store.description().patches.texels_per_side;
  for (atlas::LookIndex look = 0; look < store.description().aspects.look_count(); ++look) {
    const double elevation = store.description().aspects.look(look).aspect.elevation_rad;
    const auto vv = static_cast<float>(gamma_vv * std::sin(elevation));
    Array2D<radar::Channels> texels(side, side);
    for (std::size_t row = 0; row < side; ++row) {
      for (std::size_t column = 0; column < side; ++column) {
        const float here = vv * grain_at(column, row);
        texels(column, row) = {here, 0.5F * here, 0.1F * here, 0.3F * here};
      }
    }
    store.write(written, look, texels, {});
  }
}

/// A house on every sixteenth block of 16 m, trees on three.
void write_obstacles(const atlas::Store& store) {
  const radar::GroundGrid texels = store.description().patches.texels_of(written);
  radar::ObstacleMap map{texels, Array2D<radar::Obstacle>(texels.columns, texels.rows)};
  for (std::size_t row = 0; row < texels.rows; ++row) {
    for (std::size_t column = 0; column < texels.columns; ++column) {
      const auto key = hashed(static_cast<std::int64_t>(column / 8), static_cast<std::int64_t>(row / 8));
      radar::Obstacle& obstacle = map.obstacles(column, row);
      if (key % 16 == 0) obstacle.solid_top_m = 5.0F + static_cast<float>(key / 16 % 8);
      if (key % 16 > 12) obstacle = {.crown_base_m = 2.0F, .crown_top_m = 12.0F, .crown_extinction_per_m = 0.05F};
    }
  }
  atlas::write_obstacles(store, written, map);
}

constexpr std::string_view item_hash = "sigmascape:item_sha256";

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// An item without its name and without its own hash, so that either can be another's.
class ItemWithoutName {
 public:
  ItemWithoutName(const std::filesystem::path& item, std::string_view place) : text_(text_of(item)) {
    constexpr std::size_t digits = 64;
    const std::string before = fmt::format("\"{}\": \"", item_hash);
    text_.erase(text_.find(before) + before.size(), digits);
    place_at_ = text_.find(fmt::format("\"id\": \"{}_", place)) + std::string_view("\"id\": \"").size();
    text_.erase(place_at_, place.size());
  }

  /// The same as of another place.
  [[nodiscard]] std::string of(std::string_view place) const {
    return atlas::sealed(std::string(text_).insert(place_at_, place), item_hash);
  }

 private:
  std::string text_;
  std::size_t place_at_ = 0;
};

/// What stands in the folder of a place, to be shown by other places.
struct ShownFiles {
  std::vector<std::filesystem::path> shared;  ///< that are the same everywhere
  std::vector<std::pair<std::filesystem::path, ItemWithoutName>> items;

  ShownFiles(const std::filesystem::path& folder, std::string_view place) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().filename() == atlas::catalog_name) continue;  // which who reads textures does not
      if (entry.path().extension() == ".json") {
        items.emplace_back(entry.path().filename(), ItemWithoutName(entry.path(), place));
      } else {
        shared.push_back(entry.path());
      }
    }
  }
};

/// What items of a folder call it: "pyramid_2_patch_+000_+000".
std::string item_name_of(const std::filesystem::path& folder) {
  std::string name = folder.generic_string();
  std::ranges::replace(name, '/', '_');
  return name;
}

/// Lets the places of a level show what stands in the folder of the one that is over the written patch: their files are
/// links, their items say where they stand.
void link_places(const atlas::Store& store, const atlas::PyramidTiles& places, std::size_t level) {
  const std::filesystem::path from = atlas::folder_of(places.tile_over(written, level));
  const ShownFiles shown(store.folder() / from, item_name_of(from));
  for (const atlas::PyramidTile& tile : places.tiles(level)) {
    const std::filesystem::path place = atlas::folder_of(tile), to = store.folder() / place;
    if (!std::filesystem::create_directories(to)) continue;
    for (const auto& file : shown.shared) std::filesystem::create_hard_link(file, to / file.filename());
    for (const auto& [name, item] : shown.items)
      std::ofstream(to / name, std::ios::binary) << item.of(item_name_of(place));
  }
}

/// All other patches, and all levels above, of the one that is written.
void spread(const atlas::Store& store, bool with_obstacles) {
  const atlas::Pyramid pyramid(store);
  const atlas::LayerPyramid obstacles = atlas::obstacle_pyramid(store);
  link_places(store, pyramid, 0);
  for (std::size_t level = 1; level <= pyramid.levels(); ++level) {
    const atlas::PyramidTile first = pyramid.tile_over(written, level);
    for (atlas::LookIndex look = 0; look < store.description().aspects.look_count(); ++look) {
      (void)pyramid.make(first, look);
    }
    if (with_obstacles) (void)obstacles.make(first);
    link_places(store, pyramid, level);
  }
}

using TileOf =
    std::function<std::shared_ptr<const terrain::HeightTile>(const terrain::PyramidLayout&, terrain::TileKey)>;

/// Terrain of any size under an extent, of which every tile of a level is said to be alike.
std::shared_ptr<terrain::TerrainPyramid> terrain_under(
    const radar::Rectangle& extent, const std::function<terrain::TileSummary(double spacing_m)>& summary,
    const TileOf& tile) {
  constexpr double margin_m = 500.0, spacing_m = 10.0;
  const auto layout = terrain::PyramidLayout::covering(
      {extent.west_m - margin_m, extent.south_m - margin_m, extent.east_m + margin_m, extent.north_m + margin_m},
      spacing_m);
  std::vector<Array2D<terrain::TileSummary>> summaries;
  for (int level = 0; level < layout.levels(); ++level)
    summaries.emplace_back(layout.across(level), layout.down(level), summary(layout.spacing_at(level)));
  return std::make_shared<terrain::TerrainPyramid>(
      layout, layout.extent(), std::move(summaries), [layout, tile](terrain::TileKey key) { return tile(layout, key); },
      std::size_t{16} << 20U);
}

/// All tiles are one.
std::shared_ptr<terrain::TerrainPyramid> level_terrain(const radar::Rectangle& extent) {
  const auto flat = std::make_shared<terrain::HeightTile>();
  flat->height_m.assign(terrain::HeightTile::nodes * terrain::HeightTile::nodes, 0.0F);
  return terrain_under(
      extent, [](double) { return terrain::TileSummary{}; }, [flat](const auto&, terrain::TileKey) { return flat; });
}

/// Two waves crosswise, of these lengths.
constexpr double swell_m = 7000.0, hills_m = 3000.0, swell_height_m = 100.0, hills_height_m = 50.0;

double rolling_height_m(double x, double y) {
  constexpr double swell = 2.0 * pi / swell_m, hills = 2.0 * pi / hills_m;
  return swell_height_m * std::sin(swell * x) * std::sin(swell * y) +
         hills_height_m * std::cos(hills * (x + y)) * std::cos(hills * (x - y));
}

/// What bilinear interpolation between nodes of that distance may be wrong by: an eighth of the distance's square times
/// the curvature, along both axes.
terrain::TileSummary rolling_summary(double spacing_m) {
  constexpr double swell = 2.0 * pi / swell_m, hills = 2.0 * std::numbers::sqrt2 * pi / hills_m;
  const double curvature = swell_height_m * swell * swell + 2.0 * hills_height_m * hills * hills;
  const double highest_m = swell_height_m + hills_height_m;
  const double error_m = std::min(2.0 / 8.0 * spacing_m * spacing_m * curvature, 2.0 * highest_m);
  return {static_cast<float>(-highest_m), static_cast<float>(highest_m), static_cast<float>(error_m)};
}

std::shared_ptr<const terrain::HeightTile> rolling_tile(const terrain::PyramidLayout& layout, terrain::TileKey key) {
  auto tile = std::make_shared<terrain::HeightTile>();
  const double spacing_m = layout.spacing_at(key.level);
  const radar::Rectangle extent = layout.extent_of(key);
  tile->summary = rolling_summary(spacing_m);
  for (std::size_t row = 0; row < terrain::HeightTile::nodes; ++row) {
    for (std::size_t column = 0; column < terrain::HeightTile::nodes; ++column) {
      tile->height_m.push_back(
          static_cast<float>(rolling_height_m(extent.west_m + spacing_m * static_cast<double>(column),
                                              extent.north_m - spacing_m * static_cast<double>(row))));
    }
  }
  return tile;
}

std::shared_ptr<live::LiveGround> ground_over(const atlas::Store& store,
                                              std::shared_ptr<terrain::TerrainPyramid> terrain,
                                              std::size_t budget_bytes) {
  return std::make_shared<live::LiveGround>(store, std::move(terrain), frequency_hz,
                                            live::CacheOptions{.budget_bytes = budget_bytes});
}

}  // namespace

ScratchStore::ScratchStore()
    : folder_(std::filesystem::temp_directory_path() / fmt::format("sigmascape-bench-render-{}", getpid())) {
  std::filesystem::create_directories(folder_);
}

ScratchStore::~ScratchStore() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

namespace {

/// Makes a store of what is described.
atlas::Store filled_store(const std::filesystem::path& folder, atlas::AtlasDescription description, GroundOf kind) {
  description.name = "made for measuring";
  description.scene_hash = "none";
  const bool apart = kind == GroundOf::Layers;
  if (apart) description.settings[atlas::shadows_setting] = atlas::shadows_at_run_time;
  atlas::Store store = atlas::Store::create(folder, description);
  write_patch(store);
  if (apart) {
    write_obstacles(store);
    const atlas::Store ground = atlas::create_ground_store(store, description.aspects.elevations_rad);
    write_patch(ground);
    spread(ground, false);
  }
  spread(store, apart);
  return store;
}

}  // namespace

atlas::Store made_store(const std::filesystem::path& folder, int patches_a_side, GroundOf kind) {
  atlas::AtlasDescription description;
  description.patches = {texel_m, 1024};
  const double side_m = description.patches.side_m() * patches_a_side;
  description.extent = {0.0, 0.0, side_m, side_m};
  description.aspects.azimuths_rad = {0.0, pi};
  description.aspects.elevations_rad = {radians_from_deg(5.0), radians_from_deg(40.0)};
  description.aspects.frequencies_hz = {9e9, 11e9};
  return filled_store(folder, description, kind);
}

atlas::Store made_store_of_many_looks(const std::filesystem::path& folder, GroundOf kind) {
  atlas::AtlasDescription description;
  description.patches = {texel_m, 256};
  const double half_m = description.patches.side_m() * 32;
  description.extent = {-half_m, -half_m, half_m, half_m};
  for (int azimuth = 0; azimuth < 8; ++azimuth) description.aspects.azimuths_rad.push_back(azimuth * pi / 4.0);
  for (const double elevation_deg : {5.0, 13.0, 21.0, 29.0, 37.0}) {
    description.aspects.elevations_rad.push_back(radians_from_deg(elevation_deg));
  }
  description.aspects.frequencies_hz = {frequency_hz};
  return filled_store(folder, description, kind);
}

std::shared_ptr<live::LiveGround> made_ground(const atlas::Store& store, std::size_t budget_bytes) {
  return ground_over(store, level_terrain(store.description().extent), budget_bytes);
}

std::shared_ptr<live::LiveGround> rolling_ground(const atlas::Store& store, std::size_t budget_bytes) {
  return ground_over(store, terrain_under(store.description().extent, rolling_summary, rolling_tile), budget_bytes);
}

}  // namespace sigmascape::bench
