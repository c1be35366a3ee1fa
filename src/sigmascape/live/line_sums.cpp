#include "sigmascape/live/line_sums.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "sigmascape/base/vector_targets.h"

namespace sigmascape::live {
namespace {

/// Sums that stay in registers while all weights pass.
constexpr std::size_t together = 64;

}  // namespace

SIGMASCAPE_VECTOR_TARGETS void add_weighted(const float* __restrict from, float weight, std::span<float> to) {
  float* __restrict const sums = to.data();
  for (std::size_t i = 0; i < to.size(); ++i) sums[i] += from[i] * weight;
}

SIGMASCAPE_VECTOR_TARGETS void weigh_neighbours(const float* __restrict from, std::span<const float> weights,
                                                std::span<float> to) {
  const float* __restrict const of = weights.data();
  std::size_t first = 0;
  for (; first + together <= to.size(); first += together) {
    std::array<float, together> sums{};
    for (std::size_t k = 0; k < weights.size(); ++k) {
      for (std::size_t i = 0; i < together; ++i) sums[i] += from[first + i + k] * of[k];
    }
    std::ranges::copy(sums, to.data() + first);
  }
  for (; first < to.size(); ++first) {
    float sum = 0.0F;
    for (std::size_t k = 0; k < weights.size(); ++k) sum += from[first + k] * of[k];
    to[first] = sum;
  }
}

}  // namespace sigmascape::live
