#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/atlas/aspect_cell.h"
#include "sigmascape/atlas/half.h"
#include "sigmascape/atlas/tile_reader.h"
#include "sigmascape/live/shortage.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::live {

/// Which piece of ground, how finely, and between which looks.
///
/// Where the atlas keeps the ground apart (atlas::GroundLayers), the ground has pages of its own. They hold so many
/// elevations of it, one after the other, which stand in `aspects.elevation` as the number of the page.
struct PageKey {
  static constexpr std::uint32_t of_bare_ground = 0xffffffffU;  ///< instead of a cell of azimuth

  atlas::TileAddress tile;
  atlas::AspectCell aspects;

  [[nodiscard]] static constexpr PageKey bare_ground(const atlas::TileAddress& tile, std::uint32_t number) {
    return {tile, {of_bare_ground, number}};
  }
  [[nodiscard]] constexpr bool is_bare_ground() const { return aspects.azimuth == of_bare_ground; }

  friend constexpr bool operator==(const PageKey&, const PageKey&) = default;
  friend constexpr auto operator<=>(const PageKey&, const PageKey&) = default;
};

/// Everything that a frame needs to know of a tile of ground seen from between a few looks, laid out so that a stretch
/// of a row is read in one piece, all looks and channels of it. Pages of the store have 256 × 256 texels; those that
/// stand in for them (StandInGround) fewer, each as the mean of several.
struct GroundPage {
  PageKey key;
  std::size_t side = atlas::tile_side;  ///< texels along a side, a multiple of `vector`
  /// 4 or 8, see atlas::AspectCells::looks_of. Of bare ground [elevation][frequency].
  std::size_t looks = 0;
  std::vector<atlas::Half> blocks;                            ///< [row][block][look][channel][column], north up
  std::array<float, atlas::AspectCells::most_looks> scale{};  ///< σ0 of a stored 1, a look
  std::vector<float> height_m;                                ///< [row][column], of the texel's centre, orthometric
  // Of bare ground alone:
  std::vector<terrain::PackedSlope> slope;  ///< [row][column]
  std::vector<float> top_m;                 ///< [row][column], as of radar::AnsweringTops

  /// The terrain under it could not be had as finely as it should be: heights are those of coarser tiles.
  bool stands_on_coarser_terrain = false;
  std::vector<Shortage> shortages;  ///< of heights, slopes and tops
  mutable AnotherTry another_try;
  mutable std::atomic<std::uint64_t> last_wanted{0};  ///< number of the frame that last read it

  static constexpr std::size_t elevations = 4;  ///< of a page of bare ground
  static constexpr std::size_t channels = radar::Channels::count;
  static constexpr std::size_t vector = 16;                      ///< columns of a block, which a row is reckoned by
  static constexpr std::size_t look_halves = channels * vector;  ///< of a block

  [[nodiscard]] std::size_t level() const { return key.tile.level; }
  /// Whether it is worth making anew when what it lacks can be had.
  [[nodiscard]] bool lacks_something() const { return !shortages.empty(); }
  [[nodiscard]] std::size_t block_halves() const { return looks * look_halves; }
  /// The block that holds a texel.
  [[nodiscard]] const atlas::Half* block_of(std::size_t row, std::size_t column) const {
    return blocks.data() + (row * side + column) / vector * block_halves();
  }
  [[nodiscard]] const float* row_heights(std::size_t row) const { return height_m.data() + row * side; }
  /// Where the texels are.
  [[nodiscard]] radar::GroundGrid texels(const atlas::PatchGrid& patches) const;

  /// Takes memory for so many texels a side between so many looks, as `key` says, and keeps what it has.
  void make_room(std::size_t texels_a_side, std::size_t look_count);
  /// Takes one of the looks, [row][column][channel].
  void put_look(std::size_t look, std::span<const atlas::Half> halves, float sigma0_of_stored_1);
};

}  // namespace sigmascape::live
