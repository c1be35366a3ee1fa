#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace sigmascape::scene {

/// Groups of numbered things that only ever grow together. At first each is a group by itself.
class DisjointGroups {
 public:
  explicit DisjointGroups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// The first of the group that `i` is in.
  [[nodiscard]] std::size_t first_of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    const auto [first, second] = std::minmax({first_of(a), first_of(b)});
    parent_[second] = first;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace sigmascape::scene
