#include "sigmascape/render/live_ground.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/terrain/height_field_file.h"
#include "sigmascape/terrain/pyramid_builder.h"

namespace sigmascape::render {
namespace {

/// Of the budget, the parts that tiles of terrain, windows of them, and tiles of obstacles may take.
constexpr std::size_t tile_part = 32, window_part = 11, obstacle_part = 8;

ReliefSource relief_of(const LiveTerrain& terrain, const LiveObstacles& obstacles) {
  return [&](const atlas::TileAddress& tile, std::span<terrain::PackedSlope> slope, std::span<float> top_m) {
    const ObstacleSource& source = obstacles.cache().source();
    terrain.fill_slopes(atlas::texels_of(source.description().patches, tile), slope);
    source.fill_tops(tile, top_m);
  };
}

std::unique_ptr<LiveObstacles> obstacles_of(const atlas::Store& store, const CacheOptions& options) {
  if (!atlas::keeps_ground_apart(store)) return nullptr;
  return std::make_unique<LiveObstacles>(store, options.budget_bytes / obstacle_part, options.scrutiny);
}

/// What is left for pages.
std::size_t budget_of_pages(const CacheOptions& options, const LiveObstacles* obstacles) {
  const std::size_t others = options.budget_bytes / tile_part + options.budget_bytes / window_part +
                             (obstacles != nullptr ? obstacles->budget_bytes() : 0);
  return options.budget_bytes - std::min(others, options.budget_bytes);
}

std::shared_ptr<const PageSource> source_of(const atlas::Store& store, const LiveTerrain& terrain,
                                            const LiveObstacles* obstacles, double frequency_hz,
                                            atlas::Scrutiny scrutiny) {
  const HeightSource heights = [&terrain](const radar::GroundGrid& cells, std::span<float> height_m) {
    terrain.fill_heights(cells, height_m);
  };
  if (obstacles == nullptr) {
    return std::make_shared<const PageSource>(store, heights, frequency_hz, std::nullopt, scrutiny);
  }
  const atlas::Store ground = atlas::open_ground_store(store);
  return std::make_shared<const PageSource>(store, heights, frequency_hz,
                                            BareGround{ground, relief_of(terrain, *obstacles)}, scrutiny);
}

std::shared_ptr<terrain::TerrainPyramid> terrain_beside(const atlas::Store& store, const CacheOptions& options) {
  const std::filesystem::path folder = store.folder() / atlas::terrain_pyramid_name;
  if (!terrain::holds_pyramid(folder)) {
    const terrain::HeightField field = terrain::read_height_field(atlas::vouched_terrain(store, options.scrutiny));
    return std::shared_ptr<terrain::TerrainPyramid>(new terrain::TerrainPyramid(terrain::pyramid_in_memory(field)));
  }
  return std::shared_ptr<terrain::TerrainPyramid>(
      new terrain::TerrainPyramid(terrain::open_pyramid(folder, options.budget_bytes / tile_part)));
}

}  // namespace

LiveGround::LiveGround(const atlas::Store& store, std::shared_ptr<terrain::TerrainPyramid> terrain, double frequency_hz,
                       const CacheOptions& options)
    : frequency_hz_(frequency_hz),
      terrain_(std::move(terrain), options.budget_bytes / window_part),
      obstacles_(obstacles_of(store, options)),
      pages_(source_of(store, terrain_, obstacles_.get(), frequency_hz, options.scrutiny),
             budget_of_pages(options, obstacles_.get()), options.loaders) {
  atlas::check_frequency(store.description().aspects, frequency_hz);
  load_coarsest_level();
}

LiveGround::LiveGround(const atlas::Store& store, const terrain::HeightField& terrain, double frequency_hz,
                       const CacheOptions& options)
    : LiveGround(
          store,
          std::shared_ptr<terrain::TerrainPyramid>(new terrain::TerrainPyramid(terrain::pyramid_in_memory(terrain))),
          frequency_hz, options) {}

std::shared_ptr<LiveGround> LiveGround::open(const std::filesystem::path& atlas_folder, double frequency_hz,
                                             const CacheOptions& options) {
  const atlas::Store store = atlas::Store::open(atlas_folder);
  return std::make_shared<LiveGround>(store, terrain_beside(store, options), frequency_hz, options);
}

void LiveGround::wait_until_loaded() {
  pages_.wait_until_loaded();
  terrain_.windows().wait_until_loaded();
  if (obstacles_) obstacles_->cache().wait_until_loaded();
}

void LiveGround::load_coarsest_level() {
  const atlas::PatchGrid& patches = description().patches;
  const std::size_t level = coarsest_level();
  const double tile_m = atlas::texel_side_m(patches, level) * static_cast<double>(atlas::tile_side);
  const radar::Rectangle& extent = description().extent;
  const auto tile_at = [tile_m](double position) { return static_cast<int>(std::floor(position / tile_m)); };
  std::vector<PageKey> all;
  for (int y = tile_at(extent.south_m); y * tile_m < extent.north_m; ++y) {
    for (int x = tile_at(extent.west_m); x * tile_m < extent.east_m; ++x) {
      for (std::uint32_t azimuth = 0; azimuth < aspects().azimuth_cells(); ++azimuth) {
        for (std::uint32_t elevation = 0; elevation < aspects().elevation_cells(); ++elevation) {
          all.push_back({{level, x, y}, {azimuth, elevation}});
        }
      }
      for (std::uint32_t page = 0; page < pages_.source().ground_pages(); ++page) {
        all.push_back(PageKey::bare_ground({level, x, y}, page));
      }
    }
  }
  if (all.size() > pages_.most_pages() / 2) return;
  pages_.load(all);
}

}  // namespace sigmascape::render
