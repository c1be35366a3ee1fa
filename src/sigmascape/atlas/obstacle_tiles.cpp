#include "sigmascape/atlas/obstacle_tiles.h"

#include <algorithm>
#include <vector>

#include "sigmascape/atlas/half_cog.h"
#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/error.h"

namespace sigmascape::atlas {
namespace {

/// The items of a place and, where there is none, those below it.
float tallest_under(const Store& atlas, const PyramidTiles& places, const PyramidTile& tile) {
  const std::filesystem::path file = obstacles_path(tile);
  if (const auto record = texture_record(atlas, file)) {
    if (record->tallest_m) return *record->tallest_m;
    throw Error((atlas.folder() / file).string(), obstacles_of_a_former_kind, bake_again);
  }
  float tallest_m = 0.0F;
  if (tile.level == 0) return tallest_m;
  for (const auto& part : places.parts_of(tile)) {
    if (part) tallest_m = std::max(tallest_m, tallest_under(atlas, places, *part));
  }
  return tallest_m;
}

}  // namespace

ObstacleTiles::ObstacleTiles(const Store& atlas, Scrutiny scrutiny)
    : store_(atlas), places_(store_.description().patches, store_.description().extent), files_(store_, scrutiny) {
  for (const PyramidTile& tile : places_.tiles(places_.levels())) {
    tallest_m_ = std::max(tallest_m_, tallest_under(store_, places_, tile));
  }
}

std::size_t ObstacleTiles::levels() const {
  return description().patches.stored_levels() + places_.levels();
}

bool ObstacleTiles::read(const TileAddress& tile, std::span<radar::Obstacle> obstacles) const {
  if (tile.level >= levels() || obstacles.size() != tile_texels) return false;
  const TilePlace place = place_of(description().patches, tile);
  if (!places_.has(place.file)) {
    std::ranges::fill(obstacles, radar::Obstacle{});
    return true;
  }
  const std::filesystem::path file = obstacles_path(place.file);
  if (!files_.record_of(file)) return false;
  std::vector<Half> halves(tile_texels * texel_halves);
  const bool decodes = read_half_tile(store_.folder() / file, place.level, place.index, halves);
  files_.tell(file, place.level, decodes);
  if (!decodes) return false;
  for (std::size_t i = 0; i < obstacles.size(); ++i) obstacles[i] = obstacle_from(&halves[i * texel_halves]);
  return true;
}

}  // namespace sigmascape::atlas
