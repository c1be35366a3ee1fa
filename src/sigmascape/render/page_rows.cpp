#include "sigmascape/render/page_rows.h"

#include <algorithm>

namespace sigmascape::render {

PageRows::PageRows(std::size_t coarsest_level) : coarsest_level_(coarsest_level) {
  wanted_.reserve(most_wanted);
}

void PageRows::begin_frame(const PageCache::View& view) {
  view_ = view;
  wanted_.clear();
  last_page_ = nullptr;  // of an older view: its memory may hold another page by now
}

PageRow PageRows::row_of(const PageKey& key, std::size_t row, std::size_t column) {
  if (last_page_ != nullptr && last_page_->key == key) return {last_page_, row, column, 0};
  if (const GroundPage* page = view_.find(key)) {
    last_page_ = page;
    return {page, row, column, 0};
  }
  PageRow found;
  PageKey above = key;
  for (std::size_t up = 1; above.tile.level < coarsest_level_ && found.page == nullptr; ++up) {
    // Which quarter of its parent the tile is: rows count from the north, tiles from the south.
    const bool east = (above.tile.x & 1) != 0, south = (above.tile.y & 1) == 0;
    column += east ? atlas::tile_side << (up - 1) : 0;
    row += south ? atlas::tile_side << (up - 1) : 0;
    above.tile = above.tile.parent();
    found = {view_.find(above), row >> up, column, up};
  }
  // A coarse page covers much ground: where there is nothing yet it comes first.
  if (found.page == nullptr) miss(above);
  miss(key);
  return found;
}

void PageRows::miss(const PageKey& key) {
  if (!wanted_.empty() && wanted_.back() == key) return;
  const auto same = [&key](const PageKey& other) { return other == key; };
  if (wanted_.size() < wanted_.capacity() && std::ranges::none_of(wanted_, same)) wanted_.push_back(key);
}

const atlas::Half* PageRows::planes_of(const PageRow& source, std::size_t count) {
  const atlas::Half* const planes = source.page->row_planes(source.row);
  if (source.levels_up == 0) return planes + source.first_column;
  for (std::size_t plane = 0; plane < source.page->looks * GroundPage::channels; ++plane) {
    for (std::size_t i = 0; i < count; ++i) {
      drawn_out_[plane * atlas::tile_side + i] = planes[plane * atlas::tile_side + source.column_of(i)];
    }
  }
  return drawn_out_.data();
}

}  // namespace sigmascape::render
