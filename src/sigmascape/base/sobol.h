#pragma once

#include <bit>
#include <cstdint>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/vec.h"

namespace sigmascape {

/// Owen-scrambled Sobol points, padded in pairs.
///
/// Each pair of dimensions is the (0,2)-sequence of the first two Sobol dimensions, both coordinates scrambled by
/// hash-based nested uniform scrambling, and of all pairs but the first the order of the indices as well (Burley,
/// "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; the hash is Vegdahl's 2021 improvement of Laine and
/// Karras). Different pairs are independent of one another; within a pair any 2^k consecutive indices from a multiple
/// of 2^k are perfectly stratified.
class SobolPoint {
 public:
  /// The point number `index` of the sequence named `key` (a pixel, say).
  constexpr SobolPoint(std::uint64_t key, std::uint32_t index) : key_(key), stem_(hashed(key, index)), index_(index) {}

  /// Two numbers in [0, 1)² of the pair of dimensions number `pair`.
  [[nodiscard]] constexpr Vec2f pair(std::uint32_t pair) const {
    const std::uint64_t seeds = hashed(key_, pair);
    const std::uint64_t more = mixed(seeds);
    // One pair may keep its order, from which the others part: so its neighbours are known by their indices.
    const std::uint32_t shuffled = pair == 0 ? index_ : owen_scrambled(index_, static_cast<std::uint32_t>(seeds));
    const std::uint32_t x = owen_scrambled(reversed_bits(shuffled), static_cast<std::uint32_t>(seeds >> 32U));
    const std::uint32_t y = owen_scrambled(second_sobol_dimension(shuffled), static_cast<std::uint32_t>(more));
    return {as_unit(x), as_unit(y)};
  }

  /// Of the 2^k points (k > 0) of the run that `index` is in, from a multiple of 2^k, the index of the one beside it in
  /// the first pair of dimensions: the two that share a box of 2^-a by 2^-b, a + b = k - 1, a = b or a = b + 1.
  ///
  /// Scrambling keeps boxes together and indices add without carry, so that the indices of all neighbours differ by the
  /// same bits. Read as a polynomial over GF(2), these are divisible by x^a, for the first digits of the one coordinate
  /// are the index's own from the lowest on, and by (x + 1)^b, for those of the other are parities by Pascal's
  /// triangle, which are the index's Hasse derivatives at 1. Of degree k - 1 only x^a (x + 1)^b is.
  [[nodiscard]] static constexpr std::uint32_t neighbour(std::uint32_t index, unsigned k) {
    const unsigned b = (k - 1) / 2, a = k - 1 - b;
    std::uint32_t difference = 1;
    for (unsigned i = 0; i < b; ++i) difference ^= difference << 1U;
    return index ^ (difference << a);
  }

  /// A number in [0, 1) that depends on this point and `dimension` but is not stratified: for choices where order does
  /// not matter.
  [[nodiscard]] constexpr float independent(std::uint32_t dimension) const { return independent(stem_, dimension); }
  /// The same by the point's stem.
  [[nodiscard]] static constexpr float independent(std::uint64_t stem, std::uint32_t dimension) {
    return unit_float(mixed(stem ^ (0x1d0000000ULL + dimension)));
  }

  [[nodiscard]] constexpr std::uint64_t key() const { return key_; }
  [[nodiscard]] constexpr std::uint32_t index() const { return index_; }
  /// What all its independent numbers are hashed from.
  [[nodiscard]] constexpr std::uint64_t stem() const { return stem_; }

 private:
  [[nodiscard]] static constexpr float as_unit(std::uint32_t bits) { return static_cast<float>(bits >> 8U) * 0x1p-24F; }

  [[nodiscard]] static constexpr std::uint32_t reversed_bits(std::uint32_t x) {
    x = ((x >> 1U) & 0x55555555U) | ((x & 0x55555555U) << 1U);
    x = ((x >> 2U) & 0x33333333U) | ((x & 0x33333333U) << 2U);
    x = ((x >> 4U) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4U);
    x = ((x >> 8U) & 0x00ff00ffU) | ((x & 0x00ff00ffU) << 8U);
    return std::rotl(x, 16);
  }

  /// The second Sobol dimension: its generator matrix is Pascal's triangle modulo 2. By Lucas' theorem the binomial of
  /// (k, j) is odd when the binary digits of k contain those of j, so that bit j of the point is the parity of all
  /// index bits k above j in that sense: a sum that halves itself five times.
  [[nodiscard]] static constexpr std::uint32_t second_sobol_dimension(std::uint32_t index) {
    index ^= (index >> 1U) & 0x55555555U;
    index ^= (index >> 2U) & 0x33333333U;
    index ^= (index >> 4U) & 0x0f0f0f0fU;
    index ^= (index >> 8U) & 0x00ff00ffU;
    index ^= index >> 16U;
    return reversed_bits(index);
  }

  [[nodiscard]] static constexpr std::uint32_t owen_scrambled(std::uint32_t x, std::uint32_t seed) {
    x = reversed_bits(x);
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16U) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return reversed_bits(x);
  }

  std::uint64_t key_;
  std::uint64_t stem_;
  std::uint32_t index_;
};

}  // namespace sigmascape
