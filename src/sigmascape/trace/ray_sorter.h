#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/trace/ray.h"

namespace sigmascape::trace {

/// Finds an order in which rays that begin close to one another and go similar ways are neighbours: those of a packet
/// then ask for the same things, and the next packet finds them in the caches.
/// docs/decisions/0098-rays-in-order.md.
class RaySorter {
 public:
  /// Numbers of the rays, to be read until the next call.
  [[nodiscard]] std::span<const std::uint32_t> sorted(std::span<const Ray> rays);

 private:
  struct Entry {
    std::uint32_t key, number;
  };
  std::vector<Entry> entries_, moved_;
  std::vector<std::uint32_t> keys_, numbers_;
};

}  // namespace sigmascape::trace
