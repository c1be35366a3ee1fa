#include "sigmascape/terrain/terrain_pyramid.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sigmascape/base/error.h"

namespace sigmascape::terrain {

TerrainPyramid::TerrainPyramid(const PyramidLayout& layout, std::vector<Array2D<TileSummary>> summaries, Reader reader,
                               std::size_t budget_bytes)
    : layout_(layout),
      summaries_(std::move(summaries)),
      reader_(std::move(reader)),
      budget_bytes_(std::max(budget_bytes, 2 * HeightTile::bytes)) {
  const TileKey top{layout_.levels() - 1, 0, 0};
  held_[top] = {std::make_shared<const HeightTile>(reader_(top)), std::numeric_limits<std::uint64_t>::max()};
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
    if (faults_.contains(key)) return nullptr;
  }
  // Read without the lock: others need not wait for this disk. Two threads may read the same tile; the first is kept.
  std::shared_ptr<const HeightTile> tile;
  std::string fault;
  try {
    tile = std::make_shared<const HeightTile>(reader_(key));
  } catch (const Error& error) {
    fault = error.what();
  }
  const std::lock_guard lock(guard_);
  if (!tile) {
    faults_.emplace(key, fault);
    return nullptr;
  }
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
