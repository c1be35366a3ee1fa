#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sigmascape/base/elementary.h"
#include "sigmascape/base/vec.h"

namespace sigmascape::scatter {

/// How the facets of a surface of width one that a view sees are tilted. Frame: x towards the viewer, z the mean
/// normal.

/// The x with erf(x) = `area` − 1, for 0 < area < 2: twice the area under e^(−x²)/√π left of x. Polynomials of the
/// inverse of erf in single precision [Giles, "Approximating the erfinv function", GPU Computing Gems, 2010]; the area
/// keeps the digits that erf loses near −1.
[[nodiscard]] inline float gaussian_slope(float area) {
  const float a = std::max(0x1p-25F, std::min(area, 2.0F - 0x1p-23F));
  const float w = -fast_log(a * (2.0F - a));
  const float middle = w - 2.5F;
  float p = 2.81022636e-08F;
  p = p * middle + 3.43273939e-07F;
  p = p * middle - 3.5233877e-06F;
  p = p * middle - 4.39150654e-06F;
  p = p * middle + 0.00021858087F;
  p = p * middle - 0.00125372503F;
  p = p * middle - 0.00417768164F;
  p = p * middle + 0.246640727F;
  p = p * middle + 1.50140941F;
  const float tail = std::sqrt(std::max(w, 0.0F)) - 3.0F;
  float q = -0.000200214257F;
  q = q * tail + 0.000100950558F;
  q = q * tail + 0.00134934322F;
  q = q * tail - 0.00367342844F;
  q = q * tail + 0.00573950773F;
  q = q * tail - 0.0076224613F;
  q = q * tail + 0.00943887047F;
  q = q * tail + 1.00167406F;
  q = q * tail + 2.83297682F;
  return (w < 5.0F ? p : q) * (a - 1.0F);
}

/// The slope, along the direction of view, of a visible facet of a Beckmann surface with α = 1 whose view has cotangent
/// c.
///
/// Slopes x < c are visible with density (c − x) exp(−x²)/√π, up to a factor. In the Gaussian area A = 1 + erf(x) the
/// distribution function becomes F = c A/2 + exp(−x²)/(2√π), with F′ = (c − x)/2 and F″ = −√π exp(x²)/4: increasing,
/// concave and close to straight, so that Halley's method converges from a fair guess within two steps and Newton's in
/// x itself does the rest. docs/physics/cook_torrance.md, Eq. (9).
[[nodiscard]] inline float beckmann_visible_slope(float cotangent, float u) {
  constexpr float inv_sqrt_pi = std::numbers::inv_sqrtpi_v<float>;
  const float c = std::min(cotangent, 1e6F);
  const float last = std::min(c, 3.7F);
  const float gauss_at_end = fast_exp(-last * last);
  const float end = 2.0F - fast_erfcx(last) * gauss_at_end;
  const float goal = u * 0.5F * (c * end + inv_sqrt_pi * gauss_at_end);
  // Seen from above all slopes are alike and A is uniform; seen at grazing A ≈ end (1 − √(1 − u)). Between the two by
  // fit.
  float area = end * (1.0F - fast_exp((1.0F - 0.53F / (1.0F + 1.3F * c)) * fast_log(1.0F - u)));
  float x = 0.0F, gauss = 0.0F, excess = 0.0F, room = 0.0F;
  const auto look = [&] {
    x = gaussian_slope(area);
    gauss = inv_sqrt_pi * fast_exp(-x * x);
    excess = 0.5F * (c * area + gauss) - goal;
    room = std::max(c - x, 1e-6F);
  };
  const auto step = [&] {
    look();
    const float newton = 2.0F * excess / room;
    // No more than twice as far as Newton's would go, for far from the root the curve says little.
    const float halley = area - newton / std::max(1.0F + 0.25F * newton / (gauss * room), 0.5F);
    area = std::min(halley > 0.0F ? halley : 0.5F * area, end);
  };
  step();
  step();
  look();
  return x - excess / (room * gauss);
}

/// A visible facet of a Beckmann surface, of any length: two slopes, the one aside being like that of all facets.
[[nodiscard]] inline Vec3f beckmann_visible_facet(float cotangent, Vec2f u) {
  // Density ∝ (c − x): a facet that leans towards the viewer has negative slope along the view.
  return {-beckmann_visible_slope(cotangent, u.x), -gaussian_slope(2.0F * u.y), 1.0F};
}

/// A visible facet of a GGX surface, of any length; `sine` and `cosine` are those of the view after the surface was
/// stretched to width one, up to a common factor. [Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical
/// Caps", 2023.]
[[nodiscard]] inline Vec3f ggx_visible_facet(float sine, float cosine, Vec2f u) {
  const Vec3f view = normalized(Vec3f{sine, 0.0F, cosine});
  const Vec2f phasor = fast_phasor(u.x);
  const float z = (1.0F - u.y) * (1.0F + view.z) - view.z;
  const float radius = std::sqrt(std::clamp(1.0F - z * z, 0.0F, 1.0F));
  return Vec3f{radius * phasor.x, radius * phasor.y, z} + view;
}

}  // namespace sigmascape::scatter
