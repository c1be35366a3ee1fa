#pragma once

#include <cstdint>

namespace sigmascape::product {

/// An sRGB colour of 8 bits a channel; alpha 0 is transparent.
struct Rgba {
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;

  friend constexpr bool operator==(const Rgba&, const Rgba&) = default;
};

/// How numbers become colours.
enum class ColourScale {
  Grey,       ///< black to white
  Scope,      ///< black over green to pale, as on a cathode ray tube
  Diverging,  ///< blue over near-white to red, for differences: the middle is zero
};

/// The colour at `position` in [0, 1] of a scale, 0 its low end; positions outside are taken to the nearer end.
///
/// Grey is linear in the sRGB code value: level = round(255 · position). Scope and Diverging run linearly in lightness
/// (Diverging from the middle to either end) along arcs of Oklab (B. Ottosson, "A perceptual color space for image
/// processing", 2020), so that equal steps look equal.
[[nodiscard]] Rgba colour_at(ColourScale scale, double position);

/// Where the radar did not look: a dark blue that no scale contains.
inline constexpr Rgba unseen_colour{14, 22, 58, 255};

}  // namespace sigmascape::product
