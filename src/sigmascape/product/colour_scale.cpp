#include "sigmascape/product/colour_scale.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::product {
namespace {

/// A colour in Oklab, polar: lightness 0 to 1, chroma, hue.
struct Oklch {
  double lightness, chroma, hue_rad;
};

std::uint8_t code_value(double unit) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(unit, 0.0, 1.0)));
}

/// The sRGB transfer curve, IEC 61966-2-1.
double srgb_from_light(double light) {
  const double seen = std::clamp(light, 0.0, 1.0);
  return seen <= 0.0031308 ? 12.92 * seen : 1.055 * std::pow(seen, 1.0 / 2.4) - 0.055;
}

/// Ottosson 2020: Oklab to cone responses (cubed) to linear sRGB.
Rgba rgba_from(const Oklch& colour) {
  const double a = colour.chroma * std::cos(colour.hue_rad);
  const double b = colour.chroma * std::sin(colour.hue_rad);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(colour.lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(colour.lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(colour.lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {code_value(srgb_from_light(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)),
          code_value(srgb_from_light(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s)),
          code_value(srgb_from_light(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)), 255};
}

Rgba scope_colour(double position) {
  // Near black sRGB's green reaches a third of the lightness in chroma; from there it fades towards the pale end
  // without a kink, which would show as a band.
  const double chroma = position * (0.30 * (1.0 - position * position * position) + 0.02);
  return rgba_from({0.97 * position, chroma, radians_from_deg(144.0)});
}

Rgba diverging_colour(double position) {
  const double away = std::abs(2.0 * position - 1.0);
  const double hue_deg = position < 0.5 ? 255.0 : 30.0;
  return rgba_from({0.97 - 0.5 * away, 0.16 * away, radians_from_deg(hue_deg)});
}

}  // namespace

Rgba colour_at(ColourScale scale, double position) {
  const double inside = std::clamp(position, 0.0, 1.0);
  switch (scale) {
    case ColourScale::Grey: {
      const std::uint8_t level = code_value(inside);
      return {level, level, level, 255};
    }
    case ColourScale::Scope:
      return scope_colour(inside);
    case ColourScale::Diverging:
      return diverging_colour(inside);
  }
  return unseen_colour;
}

}  // namespace sigmascape::product
