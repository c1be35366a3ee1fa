#pragma once

#include <cstdint>

namespace sigmascape {

/// Integer hashes from which all randomness is made: a pure function of its inputs, so that the same question always
/// has the same answer, whichever thread asks.

/// A bijection of 64-bit words whose output bits each depend on all input bits (the finaliser of SplitMix64, Steele et
/// al. 2014).
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

/// One key from several words, sensitive to their order.
template <typename... Words>
[[nodiscard]] constexpr std::uint64_t hashed(Words... words) {
  std::uint64_t key = 0;
  ((key = mixed(key ^ static_cast<std::uint64_t>(words))), ...);
  return key;
}

/// The top 24 bits as a float in [0, 1).
[[nodiscard]] constexpr float unit_float(std::uint64_t bits) {
  return static_cast<float>(bits >> 40U) * 0x1p-24F;
}

}  // namespace sigmascape
