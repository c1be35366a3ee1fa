#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sigmascape::trace {

/// A square of the launch lattice of tile_side_cells a side, numbered as cells are.
struct LaunchTile {
  std::int32_t i = 0, j = 0;
};

/// LaunchCell::share, square by square.
class LaunchShares {
 public:
  LaunchShares() = default;
  /// Of tiles that come row by row, of so many squares a side, of which none is launched yet.
  LaunchShares(std::span<const LaunchTile> tiles, std::int32_t squares);

  void set(std::int32_t i, std::int32_t j, float share) {
    const Row& row = rows_[number(j, first_j_)];
    shares_[row.begin + number(i, row.first_i)] = share;
  }
  [[nodiscard]] float at(std::int32_t i, std::int32_t j) const {
    // Of what lies before the first the number is too large as well.
    const std::size_t row_number = number(j, first_j_);
    if (row_number >= rows_.size()) return 0.0F;
    const Row& row = rows_[row_number];
    const std::size_t column = number(i, row.first_i);
    return column < row.count ? shares_[row.begin + column] : 0.0F;
  }

 private:
  /// From its first tile to its last: strips that run askew over the lattice fill little of the rectangle about them.
  struct Row {
    std::int32_t first_i = 0;
    std::size_t begin = 0, count = 0;
  };

  [[nodiscard]] static std::size_t number(std::int32_t i, std::int32_t first) {
    return static_cast<std::uint32_t>(i) - static_cast<std::uint32_t>(first);
  }

  std::int32_t first_j_ = 0;
  std::vector<Row> rows_;
  std::vector<float> shares_;
};

}  // namespace sigmascape::trace
