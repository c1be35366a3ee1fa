#pragma once

#include <algorithm>
#include <cmath>

#include "sigmascape/base/vec.h"

namespace sigmascape::scatter {

/// A complex amplitude. Written out instead of std::complex, whose product checks for infinities that cannot occur
/// here.
struct Amplitude {
  float re = 0.0F;
  float im = 0.0F;

  friend constexpr Amplitude operator+(Amplitude a, Amplitude b) { return {a.re + b.re, a.im + b.im}; }
  friend constexpr Amplitude operator-(Amplitude a, Amplitude b) { return {a.re - b.re, a.im - b.im}; }
  friend constexpr Amplitude operator*(Amplitude a, Amplitude b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend constexpr Amplitude operator*(Amplitude a, float s) { return {a.re * s, a.im * s}; }
};

[[nodiscard]] constexpr float power_of(Amplitude a) {
  return a.re * a.re + a.im * a.im;
}
/// Re(a · b*).
[[nodiscard]] constexpr float correlation_of(Amplitude a, Amplitude b) {
  return a.re * b.re + a.im * b.im;
}
[[nodiscard]] inline Amplitude unit_phasor(float phase_rad) {
  return {std::cos(phase_rad), std::sin(phase_rad)};
}

/// The electric field of a wave: a complex vector across its direction of travel.
struct Field {
  Vec3f re;
  Vec3f im;

  friend constexpr Field operator+(Field a, Field b) { return {a.re + b.re, a.im + b.im}; }
  friend constexpr Field operator*(Field a, float s) { return {a.re * s, a.im * s}; }
  [[nodiscard]] constexpr Amplitude along(Vec3f unit) const { return {dot(re, unit), dot(im, unit)}; }
  [[nodiscard]] constexpr float power() const { return dot(re, re) + dot(im, im); }
  [[nodiscard]] constexpr Field turned(Amplitude phasor) const {
    return {re * phasor.re - im * phasor.im, re * phasor.im + im * phasor.re};
  }
};

[[nodiscard]] constexpr Field field_along(Vec3f unit, Amplitude a) {
  return {unit * a.re, unit * a.im};
}

/// The two waves that a path carries at once: what began vertically and what began horizontally polarized.
struct FieldPair {
  Field from_v;
  Field from_h;

  friend constexpr FieldPair operator*(FieldPair a, float s) { return {a.from_v * s, a.from_h * s}; }
  friend constexpr FieldPair operator+(FieldPair a, FieldPair b) { return {a.from_v + b.from_v, a.from_h + b.from_h}; }
  /// Both waves with the phase of `phasor` added.
  [[nodiscard]] constexpr FieldPair turned(Amplitude phasor) const {
    return {from_v.turned(phasor), from_h.turned(phasor)};
  }
  /// Mean over both transmit polarizations of the power they carry.
  [[nodiscard]] constexpr float mean_power() const { return 0.5F * (from_v.power() + from_h.power()); }
};

/// The vertical and horizontal unit vectors across a direction of travel k: h = ẑ × k / |ẑ × k|, v = h × k. For a wave
/// that travels straight down, where these are not defined, h is taken as north, and straight up as south: everywhere h
/// reverses with the direction of travel and v does not. docs/physics/reciprocity.md, Eq. (1).
struct PolarizationBasis {
  Vec3f v, h;

  explicit PolarizationBasis(Vec3f travel) {
    // Without a branch, so that loops over many waves become vector code.
    const float horizontal = std::sqrt(travel.x * travel.x + travel.y * travel.y);
    const bool is_oblique = horizontal > 1e-6F;
    const float inverse = 1.0F / std::max(horizontal, 1e-6F);
    h = {is_oblique ? -travel.y * inverse : 0.0F,
         is_oblique        ? travel.x * inverse
         : travel.z < 0.0F ? 1.0F
                           : -1.0F,
         0.0F};
    v = cross(h, travel);
  }
};

}  // namespace sigmascape::scatter
