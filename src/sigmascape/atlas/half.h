#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace sigmascape::atlas {

/// A 16-bit float (IEEE 754 binary16) as its bits: sign, 5 bits of exponent, 10 of mantissa. Holds up to 65504, with
/// full precision down to 2⁻¹⁴ and in steps of 2⁻²⁴ below that.
using Half = std::uint16_t;

inline constexpr float largest_half = 65504.0F;

/// How a number that lies between two halves becomes one of them.
enum class Rounding { Nearest, TowardsZero };

/// See half_from_float and half_towards_zero.
template <Rounding rounding>
[[nodiscard]] constexpr Half rounded_half(float value, int mantissa_bits) {
  constexpr std::uint32_t infinity = 0x7f800000U;
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint32_t>((bits >> 16U) & 0x8000U);
  const std::uint32_t magnitude = bits & 0x7fffffffU;
  if (magnitude > infinity) return static_cast<Half>(sign | 0x7e00U);

  const int exponent = static_cast<int>(magnitude >> 23U) - 127;
  if (exponent > 15) return static_cast<Half>(sign | 0x7c00U);
  if (exponent < -26) return static_cast<Half>(sign);

  // The value as a 24-bit significand; `dropped` of its bits lie below the last one that is kept.
  const std::uint32_t significand = (magnitude & 0x007fffffU) | 0x00800000U;
  const int below_lowest_step = exponent < -14 ? -1 - exponent : 13;
  const auto dropped = static_cast<std::uint32_t>(std::max(23 - mantissa_bits, below_lowest_step));
  if (dropped > 24U) return static_cast<Half>(sign);
  const std::uint32_t kept = significand >> dropped;
  const std::uint32_t rest = significand & ((1U << dropped) - 1U);
  const std::uint32_t half_way = 1U << (dropped - 1U);
  const bool up = rounding == Rounding::Nearest && (rest > half_way || (rest == half_way && (kept & 1U) != 0));
  const std::uint32_t rounded = (kept + (up ? 1U : 0U)) << (dropped - static_cast<unsigned>(below_lowest_step));

  // The leading bit of a normal number adds one to the exponent field, and so does a carry out of the mantissa.
  const std::uint32_t exponent_field = exponent < -14 ? 0U : static_cast<std::uint32_t>(exponent + 14);
  return static_cast<Half>(sign | ((exponent_field << 10U) + rounded));
}

/// The nearest half; of two equally near the even one. Beyond 65520 infinity; NaN stays NaN.
///
/// With `mantissa_bits` below 10 the nearest half of a significand so wide: noise that is not stored compresses well.
/// Below 2⁻¹⁴ it is as wide as long as steps of 2⁻²⁴ allow. Written in integers because compilers differ in what they
/// do with a half type of their own.
[[nodiscard]] constexpr Half half_from_float(float value, int mantissa_bits = 10) {
  return rounded_half<Rounding::Nearest>(value, mantissa_bits);
}

/// The half of so many mantissa bits that is next to a number below 65536 on the side of zero, or the number itself.
[[nodiscard]] constexpr Half half_towards_zero(float value, int mantissa_bits = 10) {
  return rounded_half<Rounding::TowardsZero>(value, mantissa_bits);
}

/// The same number as a float, exactly. Makes no subnormal floats on the way, so that it holds where they are flushed
/// to zero.
[[nodiscard]] constexpr float float_from_half(Half half) {
  const std::uint32_t sign = (half & 0x8000U) << 16U;
  const std::uint32_t magnitude = half & 0x7fffU;
  const std::uint32_t normal = (magnitude << 13U) + (112U << 23U);
  if (magnitude >= 0x7c00U) return std::bit_cast<float>(sign | (normal + (112U << 23U)));
  if (magnitude >= 0x0400U) return std::bit_cast<float>(sign | normal);
  const float subnormal = static_cast<float>(static_cast<std::int32_t>(magnitude)) * 0x1p-24F;
  return std::bit_cast<float>(sign | std::bit_cast<std::uint32_t>(subnormal));
}

/// The same for halves known to be finite, without a branch, so that compilers turn loops over it into vector code.
[[nodiscard]] constexpr float float_from_finite_half(Half half) {
  const std::uint32_t magnitude = half & 0x7fffU;
  const std::uint32_t normal = (magnitude << 13U) + (112U << 23U);
  const auto subnormal =
      std::bit_cast<std::uint32_t>(static_cast<float>(static_cast<std::int32_t>(magnitude)) * 0x1p-24F);
  const std::uint32_t is_subnormal = static_cast<std::uint32_t>((static_cast<std::int32_t>(magnitude) - 0x0400) >> 31);
  return std::bit_cast<float>(((half & 0x8000U) << 16U) | (subnormal & is_subnormal) | (normal & ~is_subnormal));
}

}  // namespace sigmascape::atlas
