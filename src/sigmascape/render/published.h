#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace sigmascape::render {

/// What one thread replaces while others take it as it stands. Taking is copying a pointer, and the lock is held for no
/// longer. The std::atomic<std::shared_ptr> of gcc 12 means the same, but lets go of its own lock in a memory order
/// that leaves readers and writers unordered, which is a race and reported as one.
template <typename Value>
class Published {
 public:
  explicit Published(std::shared_ptr<const Value> value) : value_(std::move(value)) {}

  [[nodiscard]] std::shared_ptr<const Value> load() const {
    const std::lock_guard lock(guard_);
    return value_;
  }

  void store(std::shared_ptr<const Value> value) {
    const std::lock_guard lock(guard_);
    value_.swap(value);  // the former one goes after the lock
  }

 private:
  mutable std::mutex guard_;
  std::shared_ptr<const Value> value_;
};

}  // namespace sigmascape::render
