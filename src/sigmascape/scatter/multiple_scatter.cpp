#include "sigmascape/scatter/multiple_scatter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sigmascape/base/sobol.h"
#include "sigmascape/scatter/fresnel.h"

namespace sigmascape::scatter {
namespace {

constexpr float pi_f = std::numbers::pi_v<float>;

/// E(μ) as the mean of G2/G1 over visible facets: the integrand is bounded and as smooth for narrow lobes as for wide
/// ones.
float mirror_albedo(const Microfacets& facets, float cos_angle) {
  constexpr std::uint32_t points = 4096;
  const Vec3f w{std::sqrt(1.0F - cos_angle * cos_angle), 0.0F, cos_angle};
  const float seen = facets.visible_part(cos_angle);
  double sum = 0.0;
  for (std::uint32_t i = 0; i < points; ++i) {
    const Vec3f facet = facets.visible_normal(w, SobolPoint(0, i).pair(0));
    const Vec3f out = facet * (2.0F * dot(w, facet)) - w;
    if (out.z > 0.0F) sum += static_cast<double>(facets.visible_part(w, out) / seen);
  }
  return static_cast<float>(sum / points);
}

}  // namespace

MultipleScatter::MultipleScatter(const Microfacets& facets, std::complex<float> permittivity)
    : mean_reflectivity_(mean_reflectivity(permittivity)) {
  for (int i = 0; i <= intervals; ++i) {
    // Λ has no limit at μ = 0; one hundredth of an interval stands for it.
    const float root = std::max(static_cast<float>(i), 0.1F) / intervals;
    lost_[static_cast<std::size_t>(i)] = std::max(0.0F, 1.0F - mirror_albedo(facets, root * root));
  }
  // Over the interpolant, not the true E, so that what is given back is what was lost to the last digit. Between nodes
  // it is linear in r = √μ, and 2 ∫ (1 − E) μ dμ = 4 ∫ (1 − E) r³ dr is exact by Simpson's rule up to r⁴ terms of each
  // interval.
  for (int i = 0; i < intervals; ++i) {
    const float left = static_cast<float>(i) / intervals;
    const float right = static_cast<float>(i + 1) / intervals;
    const float middle = 0.5F * (left + right);
    const float lost_left = lost_[static_cast<std::size_t>(i)];
    const float lost_right = lost_[static_cast<std::size_t>(i) + 1];
    const float lost_middle = 0.5F * (lost_left + lost_right);
    const auto cubed = [](float r) { return r * r * r; };
    lost_average_ += 4.0F / (6.0F * intervals) *
                     (lost_left * cubed(left) + 4.0F * lost_middle * cubed(middle) + lost_right * cubed(right));
  }
  colour_ =
      mean_reflectivity_ * mean_reflectivity_ * (1.0F - lost_average_) / (1.0F - mean_reflectivity_ * lost_average_);
}

float MultipleScatter::single_albedo(float cos_angle) const {
  const float position = std::sqrt(std::clamp(cos_angle, 0.0F, 1.0F)) * intervals;
  const int node = std::min(static_cast<int>(position), intervals - 1);
  const float part = position - static_cast<float>(node);
  const auto index = static_cast<std::size_t>(node);
  return 1.0F - (lost_[index] + part * (lost_[index + 1] - lost_[index]));
}

float MultipleScatter::albedo(float cos_angle) const {
  return colour_ * (1.0F - single_albedo(cos_angle));
}

float MultipleScatter::sampling_share(float cos_source) const {
  const float single = mean_reflectivity_ * single_albedo(cos_source);
  const float multiple = albedo(cos_source);
  return multiple > 0.0F ? multiple / (single + multiple) : 0.0F;
}

float MultipleScatter::brdf(float cos_source, float cos_sink) const {
  if (lost_average_ <= 0.0F) return 0.0F;
  return colour_ * ((1.0F - single_albedo(cos_source)) * (1.0F - single_albedo(cos_sink))) / (pi_f * lost_average_);
}

radar::Channels MultipleScatter::backscatter(float cos_angle) const {
  const float half = 0.5F * brdf(cos_angle, cos_angle);
  return {half, half, half, 0.0F};
}

FieldPair MultipleScatter::scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                                   PhaseDraw draw) const {
  const PolarizationBasis before(-to_source);
  const PolarizationBasis after(to_sink);
  const float amplitude = std::sqrt(0.5F * brdf(dot(to_source, normal), dot(to_sink, normal)));
  // One uniform phase serves both co-polarized elements. Whatever sign a diffuse part draws in either half of `a`, the
  // elements are uncorrelated with one another and with that part: in each half VV goes once round, HH twice, and the
  // diffuse part three times (CookTorrance::pass_on).
  const Amplitude vv = unit_phasor(4.0F * pi_f * draw.a) * amplitude;
  const Amplitude hh = unit_phasor(8.0F * pi_f * draw.a) * amplitude;
  const Amplitude cross = unit_phasor(2.0F * pi_f * draw.b) * amplitude;
  const auto pass = [&](const Field& e) {
    const Amplitude v_in = e.along(before.v);
    const Amplitude h_in = e.along(before.h);
    // h turns over with the direction of travel; see docs/physics/reciprocity.md, Eq. (3).
    return field_along(after.v, vv * v_in + cross * h_in) + field_along(after.h, (cross * v_in + hh * h_in) * -1.0F);
  };
  return {pass(in.from_v), pass(in.from_h)};
}

}  // namespace sigmascape::scatter
