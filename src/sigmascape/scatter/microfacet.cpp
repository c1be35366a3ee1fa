#include "sigmascape/scatter/microfacet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sigmascape::scatter {
namespace {

constexpr float pi_f = std::numbers::pi_v<float>;
constexpr float inv_sqrt_pi = std::numbers::inv_sqrtpi_v<float>;

/// The inverse of erf in single precision [Giles, "Approximating the erfinv function", GPU Computing Gems, 2010].
float inverse_erf(float y) {
  float w = -std::log((1.0F - y) * (1.0F + y));
  if (w < 5.0F) {
    w -= 2.5F;
    float p = 2.81022636e-08F;
    for (const float c : {3.43273939e-07F, -3.5233877e-06F, -4.39150654e-06F, 0.00021858087F, -0.00125372503F, -0.00417768164F,
                          0.246640727F, 1.50140941F})
      p = c + p * w;
    return p * y;
  }
  w = std::sqrt(w) - 3.0F;
  float p = -0.000200214257F;
  for (const float c : {0.000100950558F, 0.00134934322F, -0.00367342844F, 0.00573950773F, -0.0076224613F, 0.00943887047F, 1.00167406F,
                        2.83297682F})
    p = c + p * w;
  return p * y;
}

/// The slope, along the direction of view, of a visible facet of a Beckmann surface with α = 1 whose view has cotangent c.
///
/// Slopes x < c are visible with density (c − x) exp(−x²)/√π, up to a factor. In t = erf(x) the distribution function becomes
/// c (1+t)/2 + exp(−x²)/(2√π), with derivative (c − x)/2: smooth and convex enough for Newton's method from the right end.
float beckmann_visible_slope(float c, float u) {
  const float end = std::erf(std::min(c, 3.7F));
  const auto distribution = [c](float t, float x) { return 0.5F * c * (1.0F + t) + 0.5F * inv_sqrt_pi * std::exp(-x * x); };
  const float goal = u * distribution(end, std::min(c, 3.7F));
  float low = -1.0F, high = end;
  float t = low + (high - low) * std::sqrt(u) * 0.999F;
  float x = 0.0F;
  for (int iteration = 0; iteration < 8; ++iteration) {
    x = inverse_erf(std::clamp(t, -0.9999999F, 0.9999999F));
    const float excess = distribution(t, x) - goal;
    (excess > 0.0F ? high : low) = t;
    if (std::abs(excess) < 1e-6F * goal) break;
    const float newton = t - 2.0F * excess / std::max(c - x, 1e-6F);
    t = newton > low && newton < high ? newton : 0.5F * (low + high);
  }
  return x;
}

Vec3f beckmann_visible_normal(Vec3f stretched, Vec2f u) {
  const float horizontal = std::hypot(stretched.x, stretched.y);
  const Vec2f ahead = horizontal > 1e-7F ? Vec2f{stretched.x / horizontal, stretched.y / horizontal} : Vec2f{1.0F, 0.0F};
  const float cotangent = stretched.z / std::max(horizontal, 1e-7F);
  // Density ∝ (c − x): a facet that leans towards the viewer has negative slope along the view.
  const float along = cotangent > 1e6F ? inverse_erf(std::clamp(2.0F * u.x - 1.0F, -0.9999999F, 0.9999999F))
                                       : beckmann_visible_slope(cotangent, u.x);
  const float aside = inverse_erf(std::clamp(2.0F * u.y - 1.0F, -0.9999999F, 0.9999999F));
  const Vec2f slope{along * ahead.x - aside * ahead.y, along * ahead.y + aside * ahead.x};
  return {-slope.x, -slope.y, 1.0F};
}

/// Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023.
Vec3f ggx_visible_normal(Vec3f stretched, Vec2f u) {
  const float phi = 2.0F * pi_f * u.x;
  const float z = (1.0F - u.y) * (1.0F + stretched.z) - stretched.z;
  const float radius = std::sqrt(std::clamp(1.0F - z * z, 0.0F, 1.0F));
  return Vec3f{radius * std::cos(phi), radius * std::sin(phi), z} + stretched;
}

}  // namespace

float Microfacets::density(float cos_tilt) const {
  if (cos_tilt <= 0.0F) return 0.0F;
  const float cos2 = cos_tilt * cos_tilt;
  const float alpha2 = alpha_ * alpha_;
  const float tan2_over_alpha2 = (1.0F - cos2) / (cos2 * alpha2);
  const float scale = 1.0F / (pi_f * alpha2 * cos2 * cos2);
  if (distribution_ == MicrofacetDistribution::Beckmann) return scale * std::exp(-tan2_over_alpha2);
  return scale / ((1.0F + tan2_over_alpha2) * (1.0F + tan2_over_alpha2));
}

float Microfacets::lambda(float cos_angle) const {
  const float cos2 = cos_angle * cos_angle;
  const float tan2 = (1.0F - cos2) / std::max(cos2, 1e-12F);
  if (distribution_ == MicrofacetDistribution::Ggx) return 0.5F * (std::sqrt(1.0F + alpha_ * alpha_ * tan2) - 1.0F);
  if (tan2 <= 0.0F) return 0.0F;
  const float a = 1.0F / (alpha_ * std::sqrt(tan2));
  if (a > 4.0F) return 0.0F;
  return std::max(0.0F, 0.5F * (std::erf(a) - 1.0F) + 0.5F * inv_sqrt_pi * std::exp(-a * a) / a);
}

float Microfacets::visible_part(Vec3f a, Vec3f b) const {
  const float lambda_a = lambda(a.z);
  const float lambda_b = lambda(b.z);
  const float smaller = std::min(lambda_a, lambda_b);
  const float larger = std::max(lambda_a, lambda_b);
  if (smaller <= 0.0F) return 1.0F / (1.0F + larger);
  const float azimuth = std::abs(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y));
  const float independence = 4.41F * azimuth / (4.41F * azimuth + 1.0F);
  return 1.0F / (1.0F + larger + independence * smaller);
}

Vec3f Microfacets::visible_normal(Vec3f w, Vec2f u) const {
  const Vec3f stretched = normalized(Vec3f{alpha_ * w.x, alpha_ * w.y, w.z});
  const Vec3f facet = distribution_ == MicrofacetDistribution::Beckmann ? beckmann_visible_normal(stretched, u)
                                                                        : ggx_visible_normal(stretched, u);
  return normalized(Vec3f{alpha_ * facet.x, alpha_ * facet.y, std::max(facet.z, 1e-7F)});
}

}  // namespace sigmascape::scatter
