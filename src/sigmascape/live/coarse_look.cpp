#include "sigmascape/live/coarse_look.h"

#include <algorithm>
#include <array>
#include <span>

#include "sigmascape/live/extent_cells.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::live {
namespace {

using atlas::Half;
using atlas::tile_side;
constexpr std::size_t channels = radar::Channels::count;

/// How much of each column and row of a tile lies within the extent.
struct PartsWithin {
  std::array<float, tile_side> of_column, of_row;

  PartsWithin(const atlas::AtlasDescription& atlas, const atlas::TileAddress& tile) {
    const ExtentCells cells(atlas.extent, atlas::texel_side_m(atlas.patches, tile.level));
    constexpr auto side = static_cast<double>(tile_side);
    for (std::size_t i = 0; i < tile_side; ++i) {
      const auto along = static_cast<double>(i);
      of_column[i] = static_cast<float>(cells.columns.part_of(tile.x * side + along));
      of_row[i] = static_cast<float>(cells.rows.part_of((tile.y + 1) * side - 1.0 - along));
    }
  }
};

/// Means over what squares have of the extent, from [row][column][channel] to the same of fewer; black beyond. What is
/// black around a scene would make its border too dark, for no more of that is shown than lies within.
std::vector<Half> means_of(std::span<const Half> tile, const PartsWithin& within, std::size_t side) {
  const std::size_t each = tile_side / side;
  std::vector<float> widths(side);
  for (std::size_t column = 0; column < tile_side; ++column) widths[column / each] += within.of_column[column];
  std::vector<Half> means;
  means.reserve(side * side * channels);
  std::vector<float> sums(side * channels);
  float height = 0.0F;
  for (std::size_t row = 0; row < tile_side; ++row) {
    const Half* const from = tile.data() + row * tile_side * channels;
    height += within.of_row[row];
    for (std::size_t column = 0; column < tile_side; ++column) {
      float* const to = sums.data() + column / each * channels;
      const float part = within.of_column[column] * within.of_row[row];
      for (std::size_t channel = 0; channel < channels; ++channel) {
        to[channel] += part * atlas::float_from_finite_half(from[column * channels + channel]);
      }
    }
    if ((row + 1) % each != 0) continue;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const float area = widths[i / channels] * height;
      means.push_back(atlas::half_from_float(area > 0.0F ? sums[i] / area : 0.0F));
      sums[i] = 0.0F;
    }
    height = 0.0F;
  }
  return means;
}

/// As stored; nothing of the next finer level is looked for.
CoarseLook look_of_tile(const atlas::TileReader& tiles, const atlas::TileAddress& tile, atlas::LookIndex look,
                        std::size_t side) {
  CoarseLook read{std::vector<Half>(atlas::TileReader::tile_halves)};
  read.scale = tiles.read(tile, look, std::span<Half, atlas::TileReader::tile_halves>(read.halves));
  if (read.scale != 0.0 && side < tile_side)
    read.halves = means_of(read.halves, PartsWithin(tiles.description(), tile), side);
  return read;
}

bool is_beyond(const atlas::AtlasDescription& atlas, const atlas::TileAddress& tile) {
  const radar::Rectangle shared = radar::common_part(atlas.extent, atlas::texels_of(atlas.patches, tile).extent());
  return shared.width_m() <= 0.0 || shared.height_m() <= 0.0;
}

CoarseLook look_of_finer_tiles(const atlas::TileReader& tiles, const atlas::TileAddress& tile, atlas::LookIndex look,
                               std::size_t side) {
  CoarseLook whole{std::vector<Half>(side * side * channels)};
  const std::size_t half = side / 2;
  std::array<CoarseLook, 4> quarters;  // [north or south][west or east]
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    const int east = static_cast<int>(quarter % 2), south = static_cast<int>(quarter / 2);
    const atlas::TileAddress finer{tile.level - 1, 2 * tile.x + east, 2 * tile.y + 1 - south};
    quarters[quarter] = look_of_tile(tiles, finer, look, half);
    if (quarters[quarter].scale == 0.0 && !is_beyond(tiles.description(), finer)) return {};
    whole.scale = std::max(whole.scale, quarters[quarter].scale);
  }
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    if (quarters[quarter].scale == 0.0) continue;
    const auto factor = static_cast<float>(quarters[quarter].scale / whole.scale);
    const std::size_t first_row = quarter / 2 * half, first_column = quarter % 2 * half;
    for (std::size_t row = 0; row < half; ++row) {
      std::ranges::transform(
          std::span(quarters[quarter].halves).subspan(row * half * channels, half * channels),
          whole.halves.data() + ((first_row + row) * side + first_column) * channels,
          [factor](Half value) { return atlas::half_from_float(atlas::float_from_finite_half(value) * factor); });
    }
  }
  return whole;
}

}  // namespace

CoarseLook coarse_look(const atlas::TileReader& tiles, const atlas::TileAddress& tile, atlas::LookIndex look,
                       std::size_t side) {
  CoarseLook of_tile = look_of_tile(tiles, tile, look, side);
  if (of_tile.scale != 0.0 || tile.level == 0) return of_tile;
  return look_of_finer_tiles(tiles, tile, look, side);
}

}  // namespace sigmascape::live
