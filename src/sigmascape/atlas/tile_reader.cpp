#include "sigmascape/atlas/tile_reader.h"

#include <algorithm>
#include <optional>

#include "sigmascape/atlas/half_cog.h"
#include "sigmascape/atlas/texture_file.h"

namespace sigmascape::atlas {
namespace {

/// The quotient rounded downwards, for numbers on both sides of the origin.
int floored(int value, int divisor) {
  return value >= 0 ? value / divisor : -((-value + divisor - 1) / divisor);
}

}  // namespace

radar::GroundGrid texels_of(const PatchGrid& patches, const TileAddress& tile) {
  const double side_m = texel_side_m(patches, tile.level);
  const double tile_m = side_m * static_cast<double>(tile_side);
  return {tile.x * tile_m, (tile.y + 1) * tile_m, side_m, tile_side, tile_side};
}

std::size_t TileReader::levels() const {
  return description().patches.stored_levels() + pyramid_.levels();
}

double TileReader::read(const TileAddress& tile, LookIndex look, std::span<Half, tile_halves> halves) const {
  if (tile.level >= levels()) return 0.0;
  const Place place = place_of(tile, look);
  const double scale = scale_of(place.texture);
  if (scale == 0.0) return 0.0;
  return read_half_tile(store_.folder() / place.texture, place.level, place.index, halves) ? scale : 0.0;
}

TileReader::Place TileReader::place_of(const TileAddress& tile, LookIndex look) const {
  const PatchGrid& patches = description().patches;
  const std::size_t coarsest_of_patch = patches.stored_levels() - 1;
  if (tile.level > coarsest_of_patch) {
    const std::size_t above = tile.level - coarsest_of_patch;
    const int side = 1 << above;
    return {pyramid_.texture_path({above, {tile.x * side, tile.y * side}}, look), 0, 0};
  }
  const int tiles_a_side = static_cast<int>((patches.texels_per_side >> tile.level) / tile_side);
  const PatchIndex patch{floored(tile.x, tiles_a_side), floored(tile.y, tiles_a_side)};
  const int column = tile.x - patch.x * tiles_a_side;
  const int row = tiles_a_side - 1 - (tile.y - patch.y * tiles_a_side);
  return {store_.texture_path(patch, look), tile.level, static_cast<std::size_t>(row * tiles_a_side + column)};
}

double TileReader::scale_of(const std::filesystem::path& texture) const {
  {
    const std::lock_guard lock(guard_);
    if (const auto known = scales_.find(texture); known != scales_.end()) return known->second;
  }
  const std::optional<TextureRecord> record = texture_record(store_.folder(), texture);
  if (!record) return 0.0;
  const double scale = is_as_recorded(store_.folder(), texture, *record, scrutiny_) ? record->scale : 0.0;
  const std::lock_guard lock(guard_);
  return scales_.emplace(texture, scale).first->second;
}

std::size_t TileReader::damaged() const {
  const std::lock_guard lock(guard_);
  return static_cast<std::size_t>(std::ranges::count(scales_, 0.0, [](const auto& known) { return known.second; }));
}

}  // namespace sigmascape::atlas
