#include "sigmascape/live/page_rows.h"

#include <algorithm>

namespace sigmascape::live {

PageRows::PageRows(const StandInGround& stand_in) : stand_in_(stand_in) {
  wanted_.reserve(most_wanted);
}

void PageRows::begin_frame(const PageCache::View& view) {
  view_ = view;
  wanted_.clear();
  last_page_ = nullptr;  // of an older view: its memory may hold another page by now
}

PageRow PageRows::row_of(const PageKey& key, std::size_t row, std::size_t column) {
  if (last_page_ != nullptr && last_page_->key == key) return {last_page_, row, column, 0};
  if (const GroundPage* page = read_page(key)) {
    last_page_ = page;
    return {page, row, column, 0};
  }
  PageRow found;
  PageKey above = key;
  std::size_t up = 1;
  for (; above.tile.level < stand_in_.coarsest_level() && found.page == nullptr; ++up) {
    // Which quarter of its parent the tile is: rows count from the north, tiles from the south.
    const bool east = (above.tile.x & 1) != 0, south = (above.tile.y & 1) == 0;
    column += east ? atlas::tile_side << (up - 1) : 0;
    row += south ? atlas::tile_side << (up - 1) : 0;
    above.tile = above.tile.parent();
    found = {read_page(above), row >> up, column, up};
  }
  if (found.page == nullptr) {
    const std::size_t levels_up = up - 1 + stand_in_.levels_above();
    found = {stand_in_.find(above), row >> levels_up, column, levels_up};
    // A page of the coarsest level covers much ground: where there is none, and it would be finer, it comes first.
    if (!stand_in_.is_as_good_as_read(found.page)) miss(above);
    if (levels_up == 0 && found.page != nullptr) {
      last_page_ = found.page;
      return found;
    }
  }
  miss(key);
  return found;
}

const GroundPage* PageRows::read_page(const PageKey& key) {
  const GroundPage* const page = view_.find(key);
  if (page != nullptr && page->another_try.is_due()) miss(key);
  return page;
}

void PageRows::miss(const PageKey& key) {
  if (!wanted_.empty() && wanted_.back() == key) return;
  const auto same = [&key](const PageKey& other) { return other == key; };
  if (wanted_.size() < wanted_.capacity() && std::ranges::none_of(wanted_, same)) wanted_.push_back(key);
}

TexelBlocks PageRows::blocks_of(const PageRow& source, std::size_t count) {
  constexpr std::size_t vector = GroundPage::vector;
  const GroundPage& page = *source.page;
  if (source.levels_up == 0) return {page.block_of(source.row, source.first_column), source.first_column % vector};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t column = source.column_of(i);
    const atlas::Half* const from = page.block_of(source.row, column) + column % vector;
    atlas::Half* const to = drawn_out_.data() + i / vector * page.block_halves() + i % vector;
    for (std::size_t k = 0; k < page.block_halves(); k += vector) to[k] = from[k];
  }
  return {drawn_out_.data(), 0};
}

}  // namespace sigmascape::live
