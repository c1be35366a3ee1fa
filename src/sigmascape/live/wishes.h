#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "sigmascape/live/newest_list.h"

namespace sigmascape::live {

/// What those who render would like to have, for those who load it.
///
/// Each asker hands over its lists in a place of its own, without waiting for loaders or for other askers, and takes no
/// memory for it; what is locked below is locked by those who load, and when askers come and go.
template <typename Item>
class Wishes {
  /// Of one asker.
  struct Box {
    explicit Box(std::size_t most) : list(most) {}
    [[nodiscard]] std::size_t left() const { return is_put_off ? 0 : list.fetched().size() - taken; }
    [[nodiscard]] std::span<const Item> wishes_left() const { return std::span(list.fetched()).last(left()); }

    NewestList<Item> list;
    std::size_t taken = 0;   // of the list fetched last
    std::uint64_t turn = 0;  // when it was fetched
    bool is_put_off = false;
  };

 public:
  /// One who asks, for one thread at a time. Its wishes go when it goes; it must not outlive those whom it asks.
  class Asker {
   public:
    /// Asks for nothing, of nobody.
    Asker() = default;

    /// In place of what this one wanted before, the dearest first.
    void request(std::span<const Item> wanted) {
      box_->list.put(wanted);
      box_.get_deleter().wishes->ring();
    }

   private:
    friend class Wishes;
    struct Withdrawal {
      Wishes* wishes = nullptr;
      void operator()(Box* box) const { wishes->withdraw(box); }
    };
    Asker(Wishes* wishes, Box* box) : box_(box, Withdrawal{wishes}) {}

    std::unique_ptr<Box, Withdrawal> box_;  // owned by the wishes
  };

  /// Takes the memory for lists of `most` items; longer ones take more as they come.
  [[nodiscard]] Asker asker(std::size_t most) {
    const std::lock_guard lock(guard_);
    return Asker(this, boxes_.emplace_back(std::make_unique<Box>(most)).get());
  }

  // The rest is for those who load.

  /// Takes the next wish, of whoever asked last; false when there is none.
  [[nodiscard]] bool take(Item& wish) {
    const std::lock_guard lock(guard_);
    fetch();
    Box* last = nullptr;
    for (const auto& box : boxes_) {
      if (box->left() > 0 && (last == nullptr || box->turn > last->turn)) last = box.get();
    }
    if (last == nullptr) return false;
    wish = last->list.fetched()[last->taken++];
    taken_from_ = last;
    return true;
  }

  /// How many there are.
  [[nodiscard]] std::size_t size() {
    return count_if([](const Item&) { return true; });
  }
  /// Of how many `holds` is true.
  template <typename Holds>
  [[nodiscard]] std::size_t count_if(Holds holds) {
    const std::lock_guard lock(guard_);
    fetch();
    std::size_t count = 0;
    for (const auto& box : boxes_) count += static_cast<std::size_t>(std::ranges::count_if(box->wishes_left(), holds));
    return count;
  }
  [[nodiscard]] bool empty() { return size() == 0; }

  void clear() {
    const std::lock_guard lock(guard_);
    fetch();
    for (const auto& box : boxes_) box->taken = box->list.fetched().size();
  }

  /// What is left, and whose list was taken from last, counts as not wished for until those who asked ask again, or
  /// renew() is called.
  void put_off() {
    const std::lock_guard lock(guard_);
    fetch();
    for (const auto& box : boxes_) {
      if (box->left() == 0 && box.get() != taken_from_) continue;
      box->is_put_off = true;
      box->taken = 0;
    }
  }
  [[nodiscard]] bool has_put_off() {
    const std::lock_guard lock(guard_);
    fetch();
    return std::ranges::any_of(boxes_, [](const auto& box) { return box->is_put_off; });
  }
  void renew() {
    {
      const std::lock_guard lock(guard_);
      for (const auto& box : boxes_) box->is_put_off = false;
    }
    ring();
  }

  /// A count of the calls so far. Look for wishes after it was taken, and none is slept through by wait_beyond().
  [[nodiscard]] std::uint32_t calls() const { return calls_.load(); }
  /// Returns when there have been more calls than so many.
  void wait_beyond(std::uint32_t calls) const { calls_.wait(calls); }
  /// Wakes all who wait.
  void ring() {
    calls_.fetch_add(1);
    calls_.notify_all();
  }

 private:
  void withdraw(const Box* box) {
    {
      const std::lock_guard lock(guard_);
      std::erase_if(boxes_, [box](const auto& other) { return other.get() == box; });
    }
    ring();
  }

  /// With the guard held.
  void fetch() {
    for (const auto& box : boxes_) {
      if (!box->list.fetch()) continue;
      box->taken = 0;
      box->is_put_off = false;
      box->turn = ++turns_;
    }
  }

  std::mutex guard_;  // of the boxes, but for what their askers write
  std::vector<std::unique_ptr<Box>> boxes_;
  const Box* taken_from_ = nullptr;  // last; it may be gone
  std::uint64_t turns_ = 0;
  // Of the width that the system itself waits on: the library would share its own word, and its sleepers, with others.
  std::atomic<std::uint32_t> calls_{0};
};

}  // namespace sigmascape::live
