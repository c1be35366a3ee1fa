#include "sigmascape/atlas/tile_reader.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sigmascape/atlas/building_textures.h"
#include "sigmascape/atlas/half_cog.h"

namespace sigmascape::atlas {

std::size_t TileReader::levels() const {
  return description().patches.stored_levels() + pyramid_.levels();
}

namespace {

bool is_black(std::span<const Half> halves) {
  return std::ranges::all_of(halves, [](Half half) { return half == 0; });
}

/// A half times 2^−steps, `factor`.
Half scaled_down(Half half, unsigned steps, float factor) {
  const unsigned magnitude = half & 0x7fffU;
  if ((magnitude >> 10U) > steps) return static_cast<Half>(half - (steps << 10U));
  return magnitude == 0 ? half : half_from_float(float_from_finite_half(half) * factor);
}

/// Adds halves to others, each in units of its own, which are powers of two. Returns the unit of the sums, the greater
/// one: the brightest half of a texture is no more than half of what halves can tell (fitting_scale).
double add(std::span<const Half> added, double unit_of_added, std::span<Half> halves, double unit) {
  const double unit_of_sum = std::max(unit, unit_of_added);
  const auto own = static_cast<float>(unit / unit_of_sum), other = static_cast<float>(unit_of_added / unit_of_sum);
  const auto steps = static_cast<unsigned>(-std::ilogb(own));
  for (std::size_t i = 0; i < halves.size(); ++i) {
    if (added[i] == 0) {
      halves[i] = scaled_down(halves[i], steps, own);
      continue;
    }
    const float sum = float_from_finite_half(halves[i]) * own + float_from_finite_half(added[i]) * other;
    halves[i] = half_from_float(std::clamp(sum, -largest_half, largest_half));
  }
  return unit_of_sum;
}

}  // namespace

TileReader::TileReader(const Store& store, Scrutiny scrutiny)
    : store_(store), pyramid_(store_), files_(store_, scrutiny) {
  if (keeps_building_textures(store.description()))
    buildings_ = std::make_unique<const TileReader>(open_building_textures(store), scrutiny);
}

double TileReader::read(const TileAddress& tile, LookIndex look, std::span<Half, tile_halves> halves) const {
  const double unit = read_own(tile, look, halves);
  if (unit == 0.0 || !buildings_) return unit;
  std::vector<Half> of_buildings(tile_halves);
  const double unit_of_buildings = buildings_->read(tile, look, std::span<Half, tile_halves>(of_buildings));
  if (unit_of_buildings == 0.0) return 0.0;
  if (is_black(of_buildings)) return unit;
  if (is_black(halves)) {
    std::ranges::copy(of_buildings, halves.begin());
    return unit_of_buildings;
  }
  return add(of_buildings, unit_of_buildings, halves, unit);
}

double TileReader::read_own(const TileAddress& tile, LookIndex look, std::span<Half, tile_halves> halves) const {
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
