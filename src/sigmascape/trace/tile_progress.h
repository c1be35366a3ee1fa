#pragma once

#include <atomic>
#include <cstddef>

#include "sigmascape/base/progress.h"

namespace sigmascape::trace {

/// Turns the tiles that a tracer finishes, on any thread, into reports of progress from one of them.
class TileProgress {
 public:
  /// All `tiles` together are the part from `from` to `to` of `total` units of the task.
  TileProgress(ProgressListener& listener, std::string_view task, std::string_view unit, double from, double to,
               double total, std::size_t tiles)
      : listener_(listener), task_(task), unit_(unit), from_(from), to_(to), total_(total), tiles_(tiles) {}

  /// Call once a tile, with the number of the thread that finished it.
  void tile_done(unsigned worker) {
    const std::size_t done = done_.fetch_add(1, std::memory_order_relaxed) + 1;
    if (worker != 0) return;
    const double part = static_cast<double>(done) / static_cast<double>(tiles_);
    listener_.advanced(task_, from_ + (to_ - from_) * part, total_, unit_);
  }
  /// Call when all threads are through: the last tile need not have been that of the thread that reports.
  void all_done() { listener_.advanced(task_, to_, total_, unit_); }

 private:
  ProgressListener& listener_;
  std::string_view task_, unit_;
  double from_, to_, total_;
  std::size_t tiles_;
  std::atomic<std::size_t> done_{0};
};

}  // namespace sigmascape::trace
