#pragma once

#include <functional>
#include <vector>

#include "sigmascape/atlas/aspect_cell.h"
#include "sigmascape/atlas/tile_reader.h"
#include "sigmascape/render/ground_page.h"

namespace sigmascape::render {

/// Fills heights of the cells' centres of a grid, [row][column], north up.
using HeightSource = std::function<void(const radar::GroundGrid& cells, std::span<float> height_m)>;

/// Makes pages out of what is stored: tiles of a few looks and the terrain under them.
class PageSource {
 public:
  PageSource(const atlas::Store& store, HeightSource heights, double frequency_hz);

  /// Fills `page` with what `page.key` names; its memory is used again. Looks that are not in the store stay black;
  /// false when none of them is.
  [[nodiscard]] bool fill(GroundPage& page) const;

  /// Number of levels that pages can have.
  [[nodiscard]] std::size_t levels() const { return tiles_.levels(); }
  [[nodiscard]] const atlas::AspectCells& aspects() const { return aspects_; }
  [[nodiscard]] const atlas::AtlasDescription& description() const { return tiles_.description(); }

 private:
  atlas::TileReader tiles_;
  HeightSource heights_;
  atlas::AspectCells aspects_;
};

}  // namespace sigmascape::render
