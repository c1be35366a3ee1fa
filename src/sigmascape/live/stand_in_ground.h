#pragma once

#include <bit>
#include <cstddef>
#include <vector>

#include "sigmascape/atlas/tile_block.h"
#include "sigmascape/live/ground_page.h"
#include "sigmascape/live/page_source.h"

namespace sigmascape::live {

/// All ground of an atlas between all looks, so coarsely that it always is in memory: what frames show where no better
/// page is there.
///
/// Pages of the coarsest level's tiles, of which there are four at most (atlas::PyramidTiles), with 16² to 256² texels
/// each. A texel is the mean of the stored ones that it covers: σ0 is power per area, and its area mean keeps power. Of
/// what lies beyond the atlas' extent nothing is shown, and nothing goes into the mean. A tile that cannot be read is
/// made from the four of the next finer level; a page of which a look cannot be had that way either is not there.
/// Nothing changes once it is made, and any number of threads may look.
class StandInGround {
 public:
  /// The fewest texels a side that a page may have.
  static constexpr std::size_t least_side = GroundPage::vector;

  /// The most texels a side, a power of two up to atlas::tile_side, with which all pages together take no more than so
  /// many bytes; `least_side` when they take more even so.
  [[nodiscard]] static std::size_t side_within(const PageSource& source, std::size_t most_bytes);
  /// What all pages take.
  [[nodiscard]] static std::size_t bytes_of(const PageSource& source, std::size_t side);

  /// Reads the coarsest level of every look once, on all threads of the machine.
  StandInGround(const PageSource& source, std::size_t side);

  /// The page that stands in for one of the coarsest level; null when there is none.
  [[nodiscard]] const GroundPage* find(const PageKey& key) const;
  /// Whether a page of the coarsest level, or none, is as good as any that could be read: of as many texels, and it
  /// lacked no terrain when all was opened.
  [[nodiscard]] bool is_as_good_as_read(const GroundPage* page) const {
    return page != nullptr && levels_above() == 0 && !page->lacks_something();
  }
  [[nodiscard]] std::size_t coarsest_level() const { return layout_.tiles.level; }
  /// By how many levels pages are coarser than the coarsest of the store; 0: they are the same.
  [[nodiscard]] std::size_t levels_above() const {
    return static_cast<std::size_t>(std::countr_zero(atlas::tile_side / side_));
  }
  [[nodiscard]] std::size_t side() const { return side_; }

 private:
  /// The tiles of the coarsest level, and the pages that each has: those of aspect cells, then those of bare ground.
  struct Layout {
    explicit Layout(const PageSource& source);
    [[nodiscard]] std::size_t pages_a_tile() const { return azimuths * elevations + ground_pages; }
    [[nodiscard]] std::size_t pages() const { return tiles.size() * pages_a_tile(); }
    [[nodiscard]] PageKey key_of(std::size_t page) const;

    atlas::TileBlock tiles;
    std::size_t azimuths, elevations, ground_pages;
  };

  /// Reads a look for all pages that share it.
  void read_looks(const PageSource& source);
  /// Of all pages of a tile.
  void find_relief(const PageSource& source, std::size_t tile);

  Layout layout_;
  std::size_t side_;
  std::vector<GroundPage> pages_;  // [tile][page]; no blocks where a look cannot be had
};

}  // namespace sigmascape::live
