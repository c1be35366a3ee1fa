#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "sigmascape/atlas/aspect_cell.h"
#include "sigmascape/atlas/half.h"
#include "sigmascape/atlas/tile_reader.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::render {

/// Which piece of ground, how finely, and between which looks.
struct PageKey {
  atlas::TileAddress tile;
  atlas::AspectCell aspects;

  friend constexpr bool operator==(const PageKey&, const PageKey&) = default;
  friend constexpr auto operator<=>(const PageKey&, const PageKey&) = default;
};

/// Everything that a frame needs to know of 256 × 256 texels of ground seen from between a few looks, laid out so that
/// a row of texels is read from one end to the other.
struct GroundPage {
  PageKey key;
  std::size_t looks = 0;                                      ///< 4 or 8, see atlas::AspectCells::looks_of
  std::vector<atlas::Half> planes;                            ///< [row][look][channel][column], north up
  std::array<float, atlas::AspectCells::most_looks> scale{};  ///< σ0 of a stored 1, a look
  std::vector<float> height_m;                                ///< [row][column], of the texel's centre, orthometric
  mutable std::atomic<std::uint64_t> last_wanted{0};          ///< number of the frame that last read it

  static constexpr std::size_t channels = radar::Channels::count;

  [[nodiscard]] const atlas::Half* row_planes(std::size_t row) const {
    return planes.data() + row * looks * channels * atlas::tile_side;
  }
  [[nodiscard]] const float* row_heights(std::size_t row) const { return height_m.data() + row * atlas::tile_side; }
  [[nodiscard]] std::size_t bytes() const {
    return planes.capacity() * sizeof(atlas::Half) + height_m.capacity() * sizeof(float) + sizeof(*this);
  }
};

}  // namespace sigmascape::render
