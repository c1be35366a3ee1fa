#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace sigmascape::radar {

/// The real and the imaginary part of a number, apart: loops over such pairs become vector code.
struct ComplexPair {
  float re = 0.0F;
  float im = 0.0F;
};

/// A bijection of 32-bit words whose output bits depend on all input bits: multiplications and shifts alone, so that
/// vector units of any age can do it. The multipliers are those that C. Wellons' hash prospector found least biased.
[[nodiscard]] constexpr std::uint32_t mixed_word(std::uint32_t x) {
  x = (x ^ (x >> 16U)) * 0x21f0aaadU;
  x = (x ^ (x >> 15U)) * 0x735a2d97U;
  return x ^ (x >> 15U);
}

/// Two words that answer a question about a cell; each comes from both indices by a way of its own, so that neither
/// rows nor columns of cells repeat one another.
struct HashedWords {
  std::uint32_t first, second;
};

[[nodiscard]] constexpr HashedWords hashed_cell(std::uint64_t key, std::int32_t column, std::int32_t row) {
  const auto x = static_cast<std::uint32_t>(column), y = static_cast<std::uint32_t>(row);
  const auto low = static_cast<std::uint32_t>(key), high = static_cast<std::uint32_t>(key >> 32U);
  return {mixed_word(mixed_word(y + low) ^ (x * 0x9e3779b1U)), mixed_word(mixed_word(x + high) ^ (y * 0x85ebca77U))};
}

/// −ln of a number in (0, 1], by exponent and the series of the inverse hyperbolic tangent; relative error below 2e-7.
[[nodiscard]] inline float negative_log(float u) {
  // The mantissa is taken into [√½, √2), where its logarithm is small and the series short.
  constexpr std::uint32_t root_half_bits = 0x3f3504f3U;
  const std::uint32_t offset = std::bit_cast<std::uint32_t>(u) - root_half_bits;
  const auto exponent = static_cast<std::int32_t>(offset) >> 23;
  const float mantissa = std::bit_cast<float>((offset & 0x007fffffU) + root_half_bits);
  const float s = (mantissa - 1.0F) / (mantissa + 1.0F), s2 = s * s;
  const float series = 2.0F * s * (1.0F + s2 * (1.0F / 3.0F + s2 * (1.0F / 5.0F + s2 * (1.0F / 7.0F + s2 / 9.0F))));
  return -(static_cast<float>(exponent) * 0.69314718056F + series);
}

/// The unit phasor of a phase given in 2⁻³² of a turn; error below 5e-7.
[[nodiscard]] inline ComplexPair unit_phasor(std::uint32_t turns) {
  const std::uint32_t quarter = (turns + 0x20000000U) >> 30U;
  const float x = static_cast<float>(static_cast<std::int32_t>(turns - (quarter << 30U))) * 1.46291807927e-9F;
  const float x2 = x * x;
  const float sine = x * (1.0F - x2 / 6.0F * (1.0F - x2 / 20.0F * (1.0F - x2 / 42.0F)));
  const float cosine = 1.0F - x2 / 2.0F * (1.0F - x2 / 12.0F * (1.0F - x2 / 30.0F * (1.0F - x2 / 56.0F)));
  // An odd number of quarter turns swaps the two; the signs follow the quadrant.
  const std::uint32_t swap = 0U - (quarter & 1U);
  const auto s = std::bit_cast<std::uint32_t>(sine), c = std::bit_cast<std::uint32_t>(cosine);
  const std::uint32_t re = (s & swap) | (c & ~swap), im = (c & swap) | (s & ~swap);
  const std::uint32_t re_sign = ((quarter + 1U) & 2U) << 30U, im_sign = (quarter & 2U) << 30U;
  return {std::bit_cast<float>(re ^ re_sign), std::bit_cast<float>(im ^ im_sign)};
}

/// A circular complex Gaussian number ξ with E|ξ|² = 1, from 64 hashed bits: −ln u is its power and the second word its
/// phase [Box and Muller 1958].
[[nodiscard]] inline ComplexPair complex_gaussian(HashedWords words) {
  const float u = (static_cast<float>(words.first >> 9U) + 0.5F) * 0x1p-23F;
  const float amplitude = std::sqrt(negative_log(u));
  const ComplexPair phasor = unit_phasor(words.second);
  return {amplitude * phasor.re, amplitude * phasor.im};
}

}  // namespace sigmascape::radar
