#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <limits>

namespace sigmascape::live {

/// Something that could not be had when a page was made, so that something coarser stands in for it in the page.
/// To call it is to ask whether any of it can be had by now, which may read files. Empty where nothing was lacking.
using Shortage = std::function<bool()>;

/// When a page that lacks something is worth looking after again. Any number of threads, without a lock.
class AnotherTry {
  using Clock = std::chrono::steady_clock;

 public:
  void never() { at_.store(no_time, std::memory_order_relaxed); }
  void after(std::chrono::milliseconds patience) {
    at_.store((Clock::now() + patience).time_since_epoch().count(), std::memory_order_relaxed);
  }
  [[nodiscard]] bool is_due() const {
    const Clock::rep at = at_.load(std::memory_order_relaxed);
    return at != no_time && Clock::now().time_since_epoch().count() >= at;
  }

 private:
  static constexpr Clock::rep no_time = std::numeric_limits<Clock::rep>::max();
  std::atomic<Clock::rep> at_{no_time};
};

}  // namespace sigmascape::live
