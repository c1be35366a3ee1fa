#include "sigmascape/scatter/microfacet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sigmascape::scatter {
namespace {

constexpr float pi_f = std::numbers::pi_v<float>;
constexpr float inv_sqrt_pi = std::numbers::inv_sqrtpi_v<float>;

/// The x with erf(x) = `area` − 1, for 0 < area < 2: twice the area under e^(−x²)/√π left of x. Polynomials of the
/// inverse of erf in single precision [Giles, "Approximating the erfinv function", GPU Computing Gems, 2010]; the area
/// keeps the digits that erf loses near −1.
float gaussian_slope(float area) {
  area = std::clamp(area, 0x1p-25F, 2.0F - 0x1p-23F);
  const float y = area - 1.0F;
  float w = -std::log(area * (2.0F - area));
  if (w < 5.0F) {
    w -= 2.5F;
    float p = 2.81022636e-08F;
    for (const float c : {3.43273939e-07F, -3.5233877e-06F, -4.39150654e-06F, 0.00021858087F, -0.00125372503F,
                          -0.00417768164F, 0.246640727F, 1.50140941F})
      p = c + p * w;
    return p * y;
  }
  w = std::sqrt(w) - 3.0F;
  float p = -0.000200214257F;
  for (const float c : {0.000100950558F, 0.00134934322F, -0.00367342844F, 0.00573950773F, -0.0076224613F,
                        0.00943887047F, 1.00167406F, 2.83297682F})
    p = c + p * w;
  return p * y;
}

/// The slope, along the direction of view, of a visible facet of a Beckmann surface with α = 1 whose view has cotangent
/// c.
///
/// Slopes x < c are visible with density (c − x) exp(−x²)/√π, up to a factor. In the Gaussian area A = 1 + erf(x) the
/// distribution function becomes c A/2 + exp(−x²)/(2√π), with derivative (c − x)/2: increasing, concave and close to
/// straight, so that Newton's method converges from a fair guess in two to four steps. docs/physics/cook_torrance.md,
/// Eq. (9).
float beckmann_visible_slope(float c, float u) {
  const float last = std::min(c, 3.7F);
  const float end = 1.0F + std::erf(last);
  const float total = 0.5F * c * end + 0.5F * inv_sqrt_pi * std::exp(-last * last);
  const float goal = u * total;
  const float near = std::max(1e-3F * std::min(goal, total - goal), 1e-6F * goal);
  // Seen from above all slopes are alike and A is uniform; seen at grazing A ≈ end (1 − √(1 − u)). Between the two by
  // fit.
  float area = end * (1.0F - std::pow(1.0F - u, 1.0F - 0.53F / (1.0F + 1.3F * c)));
  float low = 0.0F, high = end;
  float x = 0.0F;
  for (int iteration = 0; iteration < 10; ++iteration) {
    x = gaussian_slope(area);
    const float gauss = inv_sqrt_pi * std::exp(-x * x);
    const float ahead = std::max(c - x, 1e-6F);
    const float excess = 0.5F * (c * area + gauss) - goal;
    // This near, the last step may be taken in x itself, which saves finding x for a new area.
    if (std::abs(excess) < near) return x - excess / (ahead * gauss);
    (excess > 0.0F ? high : low) = area;
    const float newton = area - 2.0F * excess / ahead;
    area = newton > low && newton < high ? newton : 0.5F * (low + high);
  }
  return x;
}

Vec3f beckmann_visible_normal(Vec3f stretched, Vec2f u) {
  const float horizontal = std::hypot(stretched.x, stretched.y);
  const Vec2f ahead =
      horizontal > 1e-7F ? Vec2f{stretched.x / horizontal, stretched.y / horizontal} : Vec2f{1.0F, 0.0F};
  const float cotangent = stretched.z / std::max(horizontal, 1e-7F);
  // Density ∝ (c − x): a facet that leans towards the viewer has negative slope along the view.
  const float along = cotangent > 1e6F ? gaussian_slope(2.0F * u.x) : beckmann_visible_slope(cotangent, u.x);
  const float aside = gaussian_slope(2.0F * u.y);
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

float Microfacets::density(Vec3f facet) const {
  if (facet.z <= 0.0F) return 0.0F;
  const float cos2 = facet.z * facet.z;
  const float alpha2 = alpha_ * alpha_;
  // Not 1 − cos², which for the narrow lobes of smooth surfaces is nothing but rounding.
  const float tan2_over_alpha2 = (facet.x * facet.x + facet.y * facet.y) / (cos2 * alpha2);
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
  if (masking_ == Masking::HeightCorrelated) return 1.0F / (1.0F + lambda_a + lambda_b);
  if (masking_ == Masking::Separable) return 1.0F / ((1.0F + lambda_a) * (1.0F + lambda_b));
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
