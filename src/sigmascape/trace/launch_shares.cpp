#include "sigmascape/trace/launch_shares.h"

#include <algorithm>

namespace sigmascape::trace {

LaunchShares::LaunchShares(std::span<const LaunchTile> tiles, std::int32_t squares) {
  if (tiles.empty()) return;
  first_j_ = tiles.front().j * squares;
  rows_.resize(number((tiles.back().j + 1) * squares, first_j_));
  std::size_t count = 0;
  for (auto first = tiles.begin(); first != tiles.end();) {
    const auto next = std::find_if(first, tiles.end(), [&](const LaunchTile& tile) { return tile.j != first->j; });
    const std::size_t columns = number((std::prev(next)->i + 1) * squares, first->i * squares);
    for (std::int32_t j = first->j * squares; j < (first->j + 1) * squares; ++j) {
      rows_[number(j, first_j_)] = {first->i * squares, count, columns};
      count += columns;
    }
    first = next;
  }
  shares_.resize(count, 0.0F);
}

}  // namespace sigmascape::trace
