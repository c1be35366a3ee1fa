#include "sigmascape/atlas/pyramid.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>
#include <utility>

#include "sigmascape/atlas/mip_chain.h"
#include "sigmascape/atlas/stac.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"

namespace sigmascape::atlas {
namespace {

constexpr int pyramid_bits = 10;
/// 2³⁰ patches a side are more than any lattice number.
constexpr std::size_t highest_level = 30;

/// The largest multiple of 2ˡᵉᵛᵉˡ that is not above. Shifts of negative numbers round down in C++20.
int aligned(int number, std::size_t level) {
  return (number >> level) << level;
}

/// Whether coarser levels would still have fewer columns (or rows): not once there is one, or the two that meet at the
/// origin.
bool can_shrink(int first, int last, std::size_t level) {
  const int begin = first >> level, end = last >> level;
  return begin != end && !(begin == -1 && end == 0);
}

/// Copies a tile into a quarter of a texture of twice the side.
void place(const Array2D<radar::Channels>& tile, std::size_t column, std::size_t row, Array2D<radar::Channels>& whole) {
  for (std::size_t y = 0; y < tile.rows(); ++y) {
    std::ranges::copy(tile.row(y), whole.row(row + y).begin() + static_cast<std::ptrdiff_t>(column));
  }
}

}  // namespace

Pyramid::Pyramid(const Store& store) : store_(store) {
  const AtlasDescription& description = store.description();
  const auto patches = description.patches.covering(description.extent);
  first_ = {patches.front().x, patches.back().y};
  last_ = {patches.back().x, patches.front().y};
  while (levels_ < highest_level && (can_shrink(first_.x, last_.x, levels_) || can_shrink(first_.y, last_.y, levels_)))
    ++levels_;
}

std::vector<PyramidTile> Pyramid::tiles(std::size_t level) const {
  std::vector<PyramidTile> tiles;
  const int step = 1 << level;
  for (int y = aligned(last_.y, level); y >= aligned(first_.y, level); y -= step) {
    for (int x = aligned(first_.x, level); x <= last_.x; x += step) tiles.push_back({level, {x, y}});
  }
  return tiles;
}

PyramidTile Pyramid::tile_over(PatchIndex patch, std::size_t level) const {
  return {level, {aligned(patch.x, level), aligned(patch.y, level)}};
}

radar::GroundGrid Pyramid::texels_of(const PyramidTile& tile) const {
  const PatchGrid& patches = store_.description().patches;
  const int span = 1 << tile.level;
  const double texel_m = patches.side_m() * span / static_cast<double>(tile_side);
  return {tile.south_west.x * patches.side_m(), (tile.south_west.y + span) * patches.side_m(), texel_m, tile_side,
          tile_side};
}

std::filesystem::path Pyramid::texture_path(const PyramidTile& tile, LookIndex look) const {
  return std::filesystem::path(fmt::format("pyramid_{}", tile.level)) / store_.texture_path(tile.south_west, look);
}

bool Pyramid::has(const PyramidTile& tile) const {
  const int span = 1 << tile.level;
  return tile.south_west.x <= last_.x && tile.south_west.x + span > first_.x && tile.south_west.y <= last_.y &&
         tile.south_west.y + span > first_.y;
}

Pyramid::Sources Pyramid::sources_of(const PyramidTile& tile, LookIndex look) const {
  const PatchGrid& patches = store_.description().patches;
  const std::size_t below = tile.level - 1;
  const int half = 1 << below;
  Sources sources;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const PyramidTile part{below,
                           {tile.south_west.x + (i % 2 == 1 ? half : 0), tile.south_west.y + (i < 2 ? half : 0)}};
    if (!has(part)) continue;
    sources[i] = below > 0 ? Source{texture_path(part, look)}
                           : Source{store_.texture_path(part.south_west, look), patches.texels_per_side,
                                    patches.stored_levels()};
  }
  return sources;
}

std::optional<std::string> Pyramid::made_from(const Sources& sources) const {
  Sha256 sha;
  for (const auto& source : sources) {
    if (!source) {
      sha.add("black");
      continue;
    }
    const auto record = texture_record(store_.folder(), source->texture);
    if (!record) return std::nullopt;
    sha.add(record->sha256);
  }
  return sha.hex_digest();
}

std::optional<StoreFault> Pyramid::fault_of(const PyramidTile& tile, LookIndex look, Scrutiny scrutiny) const {
  const std::filesystem::path texture = texture_path(tile, look);
  if (auto fault = texture_fault(store_.folder(), texture, scrutiny)) return fault;
  const auto record = texture_record(store_.folder(), texture);
  if (record && record->made_from == made_from(sources_of(tile, look))) return std::nullopt;
  return StoreFault{texture, "was made from other files than now are one level below"};
}

bool Pyramid::is_done(const PyramidTile& tile, LookIndex look, Scrutiny scrutiny) const {
  return !fault_of(tile, look, scrutiny);
}

bool Pyramid::make(const PyramidTile& tile, LookIndex look) const {
  const Sources sources = sources_of(tile, look);
  const auto is_whole = [&](const auto& source) {
    return !source || !texture_fault(store_.folder(), source->texture, Scrutiny::Content);
  };
  const auto origin = made_from(sources);
  if (!origin || !std::ranges::all_of(sources, is_whole)) return false;

  Array2D<radar::Channels> finer(2 * tile_side, 2 * tile_side);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!sources[i]) continue;
    const auto& [texture, side, levels] = *sources[i];
    HalfTexture halves = read_texture(store_.folder(), texture, side, levels, "bake again, which mends it");
    const MipChain coarsest = decoded({tile_side, halves.scale, {std::move(halves.levels.back())}});
    place(coarsest.front(), i % 2 * tile_side, i / 2 * tile_side, finer);
  }
  const Array2D<radar::Channels> texels = area_mean(finer);
  const radar::GroundGrid grid = texels_of(tile);
  const std::filesystem::path file = texture_path(tile, look);
  write_texture(store_.folder(), file, encoded({texels}, fitting_scale(texels), pyramid_bits), grid,
                store_.description(), [&](TextureRecord record) {
                  record.made_from = *origin;
                  return pyramid_item_text(store_.description(), tile, grid, look, file, record);
                });
  return true;
}

std::size_t Pyramid::make_above(const std::vector<Unit>& units, Scrutiny scrutiny) const {
  std::size_t written = 0;
  for (std::size_t level = 1; level <= levels_; ++level) {
    // Tiles in the order of their place, each look once.
    std::vector<std::pair<PatchIndex, LookIndex>> wanted;
    for (const Unit& unit : units) wanted.emplace_back(tile_over(unit.patch, level).south_west, unit.look);
    const auto order = [](const auto& a, const auto& b) {
      return std::tuple(a.first.y, a.first.x, a.second) < std::tuple(b.first.y, b.first.x, b.second);
    };
    std::ranges::sort(wanted, order);
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    for (const auto& [south_west, look] : wanted) {
      const PyramidTile tile{level, south_west};
      if (!is_done(tile, look, scrutiny) && make(tile, look)) ++written;
    }
  }
  return written;
}

HalfTexture Pyramid::read_halves(const PyramidTile& tile, LookIndex look) const {
  return read_texture(store_.folder(), texture_path(tile, look), tile_side, 1,
                      "finish the bake, or make the pyramid with 'sigmascape atlas pyramid'");
}

std::vector<StoreFault> Pyramid::verify(Scrutiny scrutiny) const {
  std::vector<StoreFault> faults;
  for (std::size_t level = 1; level <= levels_; ++level) {
    for (const PyramidTile& tile : tiles(level)) {
      for (LookIndex look = 0; look < store_.description().aspects.look_count(); ++look) {
        auto fault = fault_of(tile, look, scrutiny);
        if (fault && made_from(sources_of(tile, look))) faults.push_back(std::move(*fault));
      }
    }
  }
  return faults;
}

}  // namespace sigmascape::atlas
