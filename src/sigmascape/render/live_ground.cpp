#include "sigmascape/render/live_ground.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/terrain/height_field_file.h"

namespace sigmascape::render {
namespace {

HeightSource heights_of(const terrain::HeightField& terrain) {
  return [&terrain](const radar::GroundGrid& cells, std::span<float> height_m) {
    for (std::size_t row = 0; row < cells.rows; ++row) {
      for (std::size_t column = 0; column < cells.columns; ++column) {
        height_m[row * cells.columns + column] = static_cast<float>(terrain.height_at(cells.centre_of(column, row)));
      }
    }
  };
}

ReliefSource relief_of(const terrain::HeightField& terrain, const ObstacleLevels& obstacles) {
  return [&](const radar::GroundGrid& cells, std::span<terrain::PackedSlope> slope, std::span<float> top_m) {
    const ObstacleLevel& level = obstacles.level_for(cells.cell_m);
    const auto packed = [](double rise) {
      const double steps = rise * static_cast<double>(terrain::PackedSlope::steps_per_unit);
      return static_cast<std::int16_t>(std::lround(std::clamp(steps, -32767.0, 32767.0)));
    };
    for (std::size_t row = 0; row < cells.rows; ++row) {
      for (std::size_t column = 0; column < cells.columns; ++column) {
        const Vec2d point = cells.centre_of(column, row);
        const Vec3d normal = terrain.normal_at(point);
        slope[row * cells.columns + column] = {packed(-normal.x / normal.z), packed(-normal.y / normal.z)};
        top_m[row * cells.columns + column] = level.at(point).unpacked().top_m();
      }
    }
  };
}

ObstacleLevels obstacles_of(const atlas::Store& store, const CacheOptions& options) {
  return atlas::keeps_ground_apart(store) ? ObstacleLevels(store, options.budget_bytes / 8) : ObstacleLevels();
}

CacheOptions less(CacheOptions options, std::size_t bytes) {
  options.budget_bytes -= std::min(bytes, options.budget_bytes);
  return options;
}

std::shared_ptr<const PageSource> source_of(const atlas::Store& store, const terrain::HeightField& terrain,
                                            const ObstacleLevels& obstacles, double frequency_hz) {
  if (obstacles.empty()) return std::make_shared<const PageSource>(store, heights_of(terrain), frequency_hz);
  const atlas::Store ground = atlas::open_ground_store(store);
  return std::make_shared<const PageSource>(store, heights_of(terrain), frequency_hz,
                                            BareGround{ground, relief_of(terrain, obstacles)});
}

}  // namespace

LiveGround::LiveGround(const atlas::Store& store, terrain::HeightField terrain, double frequency_hz,
                       const CacheOptions& options)
    : frequency_hz_(frequency_hz),
      terrain_(std::move(terrain)),
      lowest_m_(terrain_.lowest_m()),
      highest_m_(terrain_.highest_m()),
      obstacles_(obstacles_of(store, options)),
      pages_(source_of(store, terrain_, obstacles_, frequency_hz), less(options, obstacles_.bytes())) {
  atlas::check_frequency(store.description().aspects, frequency_hz);
  load_coarsest_level();
}

std::shared_ptr<LiveGround> LiveGround::open(const std::filesystem::path& atlas_folder, double frequency_hz,
                                             const CacheOptions& options) {
  const atlas::Store store = atlas::Store::open(atlas_folder);
  return std::make_shared<LiveGround>(store, terrain::read_height_field(atlas_folder / atlas::terrain_name),
                                      frequency_hz, options);
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
  pages_.request(all);
  pages_.wait_until_loaded();
}

}  // namespace sigmascape::render
