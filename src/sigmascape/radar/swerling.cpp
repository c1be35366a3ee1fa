#include "sigmascape/radar/swerling.h"

#include <cmath>

#include "sigmascape/base/hash.h"

namespace sigmascape::radar {
namespace {

/// An exponential number of mean one.
double exponential(std::uint64_t key) {
  return -std::log((static_cast<double>(mixed(key) >> 11U) + 0.5) * 0x1p-53);
}

}  // namespace

double fluctuation(Swerling swerling, std::uint64_t target_seed, std::uint64_t dwell, std::uint64_t pulse) {
  const std::uint64_t slow = hashed(target_seed, dwell, 1), fast = hashed(target_seed, dwell, 2, pulse);
  switch (swerling) {
    case Swerling::Case0:
      return 1.0;
    case Swerling::Case1:
      return exponential(slow);
    case Swerling::Case2:
      return exponential(fast);
    case Swerling::Case3:
      return 0.5 * (exponential(slow) + exponential(hashed(slow, 3)));
    case Swerling::Case4:
      return 0.5 * (exponential(fast) + exponential(hashed(fast, 3)));
  }
  return 1.0;
}

}  // namespace sigmascape::radar
