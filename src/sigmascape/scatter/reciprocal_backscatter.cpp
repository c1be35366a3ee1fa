#include "sigmascape/scatter/reciprocal_backscatter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sigmascape::scatter {
namespace {

/// Where the table for steep views ends and the one for shallow views begins.
constexpr float table_border = 0.5F;
constexpr float table_length = std::numbers::sqrt2_v<float> / 2.0F;  // √table_border, in both tables' coordinate
constexpr float least_cosine = 1e-6F;

DiffuseAmplitudes quartic_of(const Sigma0& sigma0, double cos_incidence) {
  const auto root = [&](double value) { return static_cast<float>(std::pow(value / cos_incidence, 0.25)); };
  return {root(sigma0.vv), root(sigma0.hh), root(sigma0.hv)};
}

DiffuseAmplitudes between(const DiffuseAmplitudes& a, const DiffuseAmplitudes& b, float t) {
  return {a.vv + t * (b.vv - a.vv), a.hh + t * (b.hh - a.hh), a.hv + t * (b.hv - a.hv)};
}

DiffuseAmplitudes scaled_product(const DiffuseAmplitudes& a, const DiffuseAmplitudes& b, float s) {
  return {a.vv * b.vv * s, a.hh * b.hh * s, a.hv * b.hv * s};
}

float geometry(float cos_source, float cos_sink) {
  return 1.0F / std::sqrt(2.0F * std::numbers::pi_v<float> * (cos_source + cos_sink));
}

}  // namespace

ReciprocalBackscatter::ReciprocalBackscatter(const Law& law, const Depolarization& depolarization)
    : polarization_(depolarization) {
  for (int i = 0; i <= intervals; ++i) {
    const double coordinate = static_cast<double>(table_length) * i / intervals;
    const double steep = 1.0 - coordinate * coordinate;
    high_[static_cast<std::size_t>(i)] = quartic_of(law(steep), steep);
    if (i == 0) continue;
    const double shallow = coordinate * coordinate;
    low_[static_cast<std::size_t>(i)] = quartic_of(law(shallow), shallow);
  }
  low_[0] = low_[1];
}

DiffuseAmplitudes ReciprocalBackscatter::quartic(float cos_angle) const {
  const bool steep = cos_angle > table_border;
  const float coordinate = std::sqrt(std::clamp(steep ? 1.0F - cos_angle : cos_angle, 0.0F, table_border));
  const float cells = coordinate * (static_cast<float>(intervals) / table_length);
  const int cell = std::min(static_cast<int>(cells), intervals - 1);
  const auto& table = steep ? high_ : low_;
  const auto index = static_cast<std::size_t>(cell);
  return between(table[index], table[index + 1], cells - static_cast<float>(cell));
}

radar::Channels ReciprocalBackscatter::backscatter(Vec3f to_radar, Vec3f normal) const {
  const float cos_angle = std::max(least_cosine, dot(to_radar, normal));
  const Quartic root = quartic(cos_angle);
  return polarization_.backscatter(scaled_product(root, root, geometry(cos_angle, cos_angle)));
}

DirectionSample ReciprocalBackscatter::sample(Vec3f, Vec3f normal, Vec2f u) const {
  return cosine_direction(normal, u);
}

float ReciprocalBackscatter::pdf(Vec3f, Vec3f to_sink, Vec3f normal) const {
  return cosine_pdf(to_sink, normal);
}

FieldPair ReciprocalBackscatter::scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                                         PhaseDraw draw) const {
  const float cos_source = std::max(least_cosine, dot(to_source, normal));
  const float cos_sink = std::max(least_cosine, dot(to_sink, normal));
  const auto amplitudes = scaled_product(quartic(cos_source), quartic(cos_sink), geometry(cos_source, cos_sink));
  return polarization_.scatter(in, amplitudes, to_source, to_sink, draw);
}

double ReciprocalBackscatter::albedo(double cos_incidence) const {
  const Quartic from = quartic(static_cast<float>(cos_incidence));
  double v = 0.0;
  double h = 0.0;
  // Each table's coordinate t has |d cos θ| = 2 t dt; the values are even enough over it for the trapezoidal rule.
  const auto add = [&](const Quartic& to, double cosine, double weight) {
    const auto exchanged = [](float a, float b) {
      const double root = static_cast<double>(a) * static_cast<double>(b);
      return root * root;
    };
    const double share = weight * cosine / (cosine + cos_incidence);
    const double cross = exchanged(from.hv, to.hv);
    v += (exchanged(from.vv, to.vv) + cross) * share;
    h += (exchanged(from.hh, to.hh) + cross) * share;
  };
  const double step = static_cast<double>(table_length) / intervals;
  for (int i = 0; i <= intervals; ++i) {
    const double t = step * i;
    const double weight = 2.0 * t * step * (i == intervals ? 0.5 : 1.0);
    add(high_[static_cast<std::size_t>(i)], 1.0 - t * t, weight);
    add(low_[static_cast<std::size_t>(i)], t * t, weight);
  }
  return std::max(v, h);
}

double ReciprocalBackscatter::greatest_albedo() const {
  const double least = std::cos(89.0 * std::numbers::pi / 180.0);
  double greatest = 0.0;
  for (int i = 0; i <= intervals; ++i) {
    const double square = std::pow(static_cast<double>(table_length) * i / intervals, 2.0);
    greatest = std::max(greatest, albedo(1.0 - square));
    if (square >= least) greatest = std::max(greatest, albedo(square));
  }
  return greatest;
}

}  // namespace sigmascape::scatter
