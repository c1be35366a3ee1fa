#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sigmascape/live/page_cache.h"
#include "sigmascape/live/stand_in_ground.h"

namespace sigmascape::live {

/// A row of the best page there is for a place: the page itself or, until that is there, one of its ancestors or what
/// stands in for the coarsest of them.
struct PageRow {
  const GroundPage* page = nullptr;
  std::size_t row = 0, first_column = 0;  ///< within the page; of the ancestor's texels the first is cut in halves
  std::size_t levels_up = 0;              ///< by which the page's texels are coarser

  /// Column in the page of texel `i` of the stretch.
  [[nodiscard]] std::size_t column_of(std::size_t i) const { return (first_column + i) >> levels_up; }
  /// Of the row further south, the first texel's block; null where the page ends or is an ancestor.
  [[nodiscard]] const atlas::Half* next_blocks() const {
    return levels_up == 0 && row + 1 < atlas::tile_side ? page->block_of(row + 1, first_column) : nullptr;
  }
};

/// Blocks of a page that hold a stretch of texels.
struct TexelBlocks {
  const atlas::Half* blocks = nullptr;  ///< [block][look][channel][column]
  std::size_t lane = 0;                 ///< of the first texel, its column in the first block
};

/// Finds rows of pages for one task of a frame, and remembers which pages were missing or lack something.
class PageRows {
 public:
  /// Missing pages that one task remembers; the next frame will see the rest.
  static constexpr std::size_t most_wanted = 4096;

  explicit PageRows(const StandInGround& stand_in);

  void begin_frame(const PageCache::View& view);
  void end_frame() { view_ = {}; }
  [[nodiscard]] std::span<const PageKey> wanted() const { return wanted_; }

  /// From `column` of `row` of the tile on.
  PageRow row_of(const PageKey& key, std::size_t row, std::size_t column);
  /// Of `count` texels; those of an ancestor are drawn out, each of its texels over those that it stands for, and are
  /// good until the next call.
  TexelBlocks blocks_of(const PageRow& source, std::size_t count);

 private:
  /// One that was read, if it is there.
  [[nodiscard]] const GroundPage* read_page(const PageKey& key);
  void miss(const PageKey& key);

  const StandInGround& stand_in_;
  PageCache::View view_;
  std::vector<PageKey> wanted_;
  const GroundPage* last_page_ = nullptr;
  alignas(
      64) std::array<atlas::Half, atlas::AspectCells::most_looks * GroundPage::channels * atlas::tile_side> drawn_out_;
};

}  // namespace sigmascape::live
