#pragma once

#include <chrono>
#include <cstddef>
#include <map>

namespace sigmascape {

/// How long what failed is left alone.
inline constexpr std::chrono::milliseconds before_another_try{5000};

/// What could not be had, and when that was seen last. It is worth asking for again after a while: the system may have
/// run short of open files or of memory for a moment, and a file may have been made or mended meanwhile.
///
/// For one thread at a time.
template <typename Key>
class FailedLately {
  using Clock = std::chrono::steady_clock;

 public:
  explicit FailedLately(std::chrono::milliseconds patience = before_another_try) : patience_(patience) {}

  void add(const Key& key) { seen_[key] = Clock::now(); }
  /// It could be had after all.
  void erase(const Key& key) { seen_.erase(key); }

  /// Whether it failed a moment ago, so that it is too early to ask again.
  [[nodiscard]] bool holds(const Key& key) const {
    const auto found = seen_.find(key);
    return found != seen_.end() && Clock::now() - found->second < patience_;
  }
  [[nodiscard]] std::chrono::milliseconds patience() const { return patience_; }
  /// How many failed when they were last asked for, however long ago.
  [[nodiscard]] std::size_t size() const { return seen_.size(); }

 private:
  std::chrono::milliseconds patience_;
  std::map<Key, Clock::time_point> seen_;
};

}  // namespace sigmascape
