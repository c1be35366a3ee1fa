#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sigmascape/base/vec.h"

namespace sigmascape {

/// Elementary functions in single precision without a branch or a table, so that loops over them become vector code.
/// They give the same bits on every machine. Polynomials of the Cephes library [Moshier, Methods and Programs for
/// Mathematical Functions, 1989] unless said otherwise; errors of one or two units in the last place.

/// eˣ; below −87 nothing, above 87 that of 87.
[[nodiscard]] inline float fast_exp(float exponent_of_e) {
  const float x = std::max(-87.0F, std::min(exponent_of_e, 87.0F));
  // Adding and taking away 1.5 · 2²³ rounds to the nearest integer, which then stands in the last bits.
  constexpr float rounder = 12582912.0F;
  const float shifted = x * 1.44269504F + rounder;
  const float exponent = shifted - rounder;
  const float r = x - exponent * 0.693359375F + exponent * 2.12194440e-4F;
  float p = 1.9875691500e-4F;
  p = p * r + 1.3981999507e-3F;
  p = p * r + 8.3334519073e-3F;
  p = p * r + 4.1665795894e-2F;
  p = p * r + 1.6666665459e-1F;
  p = p * r + 5.0000001201e-1F;
  p = p * (r * r) + r + 1.0F;
  const std::uint32_t power = std::bit_cast<std::uint32_t>(shifted) << 23U;
  const float value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(p) + power);
  return exponent_of_e < -87.0F ? 0.0F : value;
}

/// ln x for normal x > 0.
[[nodiscard]] inline float fast_log(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  // So that the mantissa m lies in [√½, √2).
  const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;
  const float m = std::bit_cast<float>(bits - exponent * 0x800000) - 1.0F;
  const auto e = static_cast<float>(exponent);
  float p = 7.0376836292e-2F;
  p = p * m - 1.1514610310e-1F;
  p = p * m + 1.1676998740e-1F;
  p = p * m - 1.2420140846e-1F;
  p = p * m + 1.4249322787e-1F;
  p = p * m - 1.6668057665e-1F;
  p = p * m + 2.0000714765e-1F;
  p = p * m - 2.4999993993e-1F;
  p = p * m + 3.3333331174e-1F;
  const float m2 = m * m;
  return p * m2 * m - 2.12194440e-4F * e - 0.5F * m2 + m + 0.693359375F * e;
}

/// Cosine and sine of 2π `turns`, 0 ≤ turns < 2²⁰.
[[nodiscard]] inline Vec2f fast_phasor(float turns) {
  constexpr float rounder = 12582912.0F;
  const float shifted = turns * 4.0F + rounder;
  const auto quarter = std::bit_cast<std::uint32_t>(shifted);
  const float r = (turns - (shifted - rounder) * 0.25F) * 6.28318530718F;
  const float r2 = r * r;
  const float sine = ((-1.9515295891e-4F * r2 + 8.3321608736e-3F) * r2 - 1.6666654611e-1F) * r2 * r + r;
  const float cosine =
      ((2.443315711809948e-5F * r2 - 1.388731625493765e-3F) * r2 + 4.166664568298827e-2F) * r2 * r2 - 0.5F * r2 + 1.0F;
  const bool is_odd = (quarter & 1U) != 0U;
  const float along = is_odd ? sine : cosine, across = is_odd ? cosine : sine;
  return {((quarter + 1U) & 2U) != 0U ? -along : along, (quarter & 2U) != 0U ? -across : across};
}

/// The angle between 0 and π whose cosine and sine are as `x` and `y` ≥ 0, which are not both zero.
[[nodiscard]] inline float fast_angle(float x, float y) {
  const float width = std::abs(x);
  const float greater = std::max(width, y), lesser = std::min(width, y);
  // Halved once around 45°, so that the polynomial need not go farther than 22.5°.
  const bool is_wide = lesser > 0.414213562F * greater;
  const float t = (is_wide ? lesser - greater : lesser) / (is_wide ? lesser + greater : greater);
  const float t2 = t * t;
  float angle =
      (((8.05374449538e-2F * t2 - 1.38776856032e-1F) * t2 + 1.99777106478e-1F) * t2 - 3.33329491539e-1F) * t2 * t + t;
  angle = is_wide ? angle + 0.785398163F : angle;
  angle = y > width ? 1.57079633F - angle : angle;
  return x < 0.0F ? 3.14159265F - angle : angle;
}

/// e^(x²) (1 − erf x) for 0 ≤ x ≤ 4.2, to 2e-7 of itself: a Chebyshev fit of its own in (x − 2)/(x + 2).
[[nodiscard]] inline float fast_erfcx(float x) {
  const float q = (x - 2.0F) / (x + 2.0F);
  float p = -2.05836841e-4F;
  p = p * q - 1.11426355e-3F;
  p = p * q - 8.3638099e-4F;
  p = p * q + 7.0308852e-3F;
  p = p * q + 3.73885361e-3F;
  p = p * q - 7.89807662e-2F;
  p = p * q + 2.41657734e-1F;
  p = p * q - 4.27185804e-1F;
  return p * q + 2.55395681e-1F;
}

}  // namespace sigmascape
