#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace sigmascape::live {

/// Hands lists from one thread to another, of which the newest alone counts. Neither ever waits for the other.
///
/// There are three: one is written, one is read, and one lies between. To put a list there, or to fetch it, is to
/// exchange one's own for that which lies there, in one step; a list that nobody has fetched is written over.
template <typename Item>
class NewestList {
 public:
  /// Takes the memory for lists of so many items; longer ones take more as they come.
  explicit NewestList(std::size_t most) {
    for (std::vector<Item>& list : lists_) list.reserve(most);
  }

  /// For the one who writes.
  void put(std::span<const Item> items) {
    lists_[written_].assign(items.begin(), items.end());
    written_ = between_.exchange(written_ | is_new) & ~is_new;
  }

  /// For the one who reads: whether there is a list newer than the one fetched last, which it then takes the place of.
  bool fetch() {
    if ((between_.load() & is_new) == 0) return false;
    read_ = between_.exchange(read_) & ~is_new;
    return true;
  }
  /// The list fetched last; empty before the first.
  [[nodiscard]] const std::vector<Item>& fetched() const { return lists_[read_]; }

 private:
  static constexpr std::size_t is_new = 4;  // beside the number of a list
  static_assert(std::atomic<std::size_t>::is_always_lock_free);

  std::array<std::vector<Item>, 3> lists_;
  std::size_t written_ = 0;
  std::atomic<std::size_t> between_{1};
  std::size_t read_ = 2;
};

}  // namespace sigmascape::live
