#include "sigmascape/terrain/terrain_pyramid.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <utility>

namespace sigmascape::terrain {

TerrainPyramid::TerrainPyramid(const PyramidLayout& layout, const radar::Rectangle& extent,
                               std::vector<Array2D<TileSummary>> summaries, Reader reader, std::size_t budget_bytes,
                               std::chrono::milliseconds patience)
    : layout_(layout),
      extent_(extent),
      summaries_(std::move(summaries)),
      reader_(std::move(reader)),
      budget_bytes_(std::max(budget_bytes, 2 * HeightTile::bytes)),
      failed_(patience) {
  const TileKey top{layout_.levels() - 1, 0, 0};
  held_[top] = {reader_(top), std::numeric_limits<std::uint64_t>::max()};
}

TileSummary TerrainPyramid::summary_over(const radar::Rectangle& ground, int level) const {
  const double tile_m = layout_.spacing_at(level) * static_cast<double>(HeightTile::cells);
  const auto tile_at = [tile_m](double from_edge_m, std::uint32_t count) {
    const double last = static_cast<double>(count - 1);
    return static_cast<std::uint32_t>(std::clamp(std::floor(from_edge_m / tile_m), 0.0, last));
  };
  const std::uint32_t across = layout_.across(level), down = layout_.down(level);
  const std::uint32_t west = tile_at(ground.west_m - layout_.west_m, across),
                      east = tile_at(ground.east_m - layout_.west_m, across),
                      north = tile_at(layout_.north_m - ground.north_m, down),
                      south = tile_at(layout_.north_m - ground.south_m, down);
  TileSummary all = summary({level, west, north});
  for (std::uint32_t row = north; row <= south; ++row) {
    for (std::uint32_t column = west; column <= east; ++column) {
      const TileSummary& tile = summary({level, column, row});
      all = {std::min(all.lowest_m, tile.lowest_m), std::max(all.highest_m, tile.highest_m),
             std::max(all.error_m, tile.error_m)};
    }
  }
  return all;
}

HeightBounds TerrainPyramid::bounds_over(const radar::Rectangle& ground) const {
  // The finest level of which few tiles cover the ground.
  constexpr double most_tiles_a_side = 6.0;
  const double side_m = std::max(ground.width_m(), ground.height_m());
  int level = 0;
  while (level + 1 < levels() &&
         side_m > most_tiles_a_side * layout_.spacing_at(level) * static_cast<double>(HeightTile::cells)) {
    ++level;
  }
  const TileSummary summary = summary_over(ground, level);
  return {summary.lowest_m, summary.highest_m};
}

std::shared_ptr<const HeightTile> TerrainPyramid::resident(TileKey key) {
  const std::lock_guard lock(guard_);
  const auto found = held_.find(key);
  if (found == held_.end()) return nullptr;
  if (found->second.last_use != std::numeric_limits<std::uint64_t>::max()) found->second.last_use = ++clock_;
  return found->second.tile;
}

std::shared_ptr<const HeightTile> TerrainPyramid::load(TileKey key) {
  if (!layout_.has(key)) return nullptr;
  if (auto tile = resident(key)) return tile;
  {
    const std::lock_guard lock(guard_);
    if (failed_.holds(key)) return nullptr;
  }
  // Read without the lock: others need not wait for this disk. Two threads may read the same tile; the first is kept.
  std::shared_ptr<const HeightTile> tile;
  std::string fault;
  try {
    tile = reader_(key);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {  // the system's own among them, of a disk that is gone or a broken link
    fault = failure.what();
  }
  const std::lock_guard lock(guard_);
  if (!tile) {
    faults_.insert_or_assign(key, fault);
    failed_.add(key);
    return nullptr;
  }
  faults_.erase(key);
  failed_.erase(key);
  const auto [place, added] = held_.try_emplace(key, Held{tile, ++clock_});
  if (added) make_room();
  return added ? tile : place->second.tile;
}

void TerrainPyramid::make_room() {
  while (held_.size() * HeightTile::bytes > budget_bytes_) {
    held_.erase(std::ranges::min_element(held_, {}, [](const auto& held) { return held.second.last_use; }));
  }
}

std::size_t TerrainPyramid::resident_bytes() const {
  const std::lock_guard lock(guard_);
  return held_.size() * HeightTile::bytes;
}

std::vector<TileFault> TerrainPyramid::faults() const {
  const std::lock_guard lock(guard_);
  std::vector<TileFault> result;
  for (const auto& [key, message] : faults_) result.push_back({key, message});
  return result;
}

}  // namespace sigmascape::terrain
