#include "sigmascape/atlas/tile_reader.h"

#include "sigmascape/atlas/half_cog.h"

namespace sigmascape::atlas {

std::size_t TileReader::levels() const {
  return description().patches.stored_levels() + pyramid_.levels();
}

double TileReader::read(const TileAddress& tile, LookIndex look, std::span<Half, tile_halves> halves) const {
  if (tile.level >= levels()) return 0.0;
  const TilePlace place = place_of(description().patches, tile);
  if (!pyramid_.has(place.file)) return 0.0;
  const std::filesystem::path texture = pyramid_.texture_path(place.file, look);
  const auto record = files_.record_of(texture);
  if (!record) return 0.0;
  const bool decodes = read_half_tile(store_.folder() / texture, place.level, place.index, halves);
  files_.tell(texture, place.level, decodes);
  return decodes ? record->scale : 0.0;
}

}  // namespace sigmascape::atlas
