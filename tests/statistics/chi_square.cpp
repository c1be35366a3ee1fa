#include "statistics/chi_square.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::statistics_test {
namespace {

/// P(a, x) by its power series, for x < a + 1.
double lower_gamma_series(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (double n = a + 1.0; term > 1e-16 * sum; n += 1.0) sum += term *= x / n;
  return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

/// Q(a, x) by its continued fraction, evaluated from the front [Lentz 1976], for x > a + 1.
double upper_gamma_fraction(double a, double x) {
  constexpr double tiny = 1e-300;
  double b = x + 1.0 - a;
  double c = 1.0 / tiny;
  double d = 1.0 / b;
  double product = d;
  for (int i = 1; i < 100'000; ++i) {
    const double numerator = -i * (i - a);
    b += 2.0;
    d = numerator * d + b;
    d = 1.0 / (std::abs(d) < tiny ? tiny : d);
    c = b + numerator / c;
    if (std::abs(c) < tiny) c = tiny;
    product *= c * d;
    if (std::abs(c * d - 1.0) < 1e-15) break;
  }
  return product * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

Vec3d from_tangent(double tangent, double azimuth) {
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
  return {tangent * cosine * std::cos(azimuth), tangent * cosine * std::sin(azimuth), cosine};
}

/// ∫ pdf over one cell by midpoints; cells that a border crosses, where the density jumps to zero, are looked at more
/// closely.
double cell_probability(const Sampler& sampler, const DirectionChart& chart, int ring, int sector, int rings,
                        int sectors) {
  const auto density = [&](double along, double across) {
    const Vec2d place{(ring + along) / rings, (sector + across) / sectors};
    return sampler.pdf(chart.direction(place).to<float>()) * chart.solid_angle(place);
  };
  int empty_corners = 0;
  for (const double along : {0.001, 0.999}) {
    for (const double across : {0.001, 0.999}) empty_corners += density(along, across) > 0.0 ? 0 : 1;
  }
  const int steps = empty_corners == 0 || empty_corners == 4 ? 6 : 64;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) sum += density((i + 0.5) / steps, (j + 0.5) / steps);
  }
  return sum / (steps * steps * rings * sectors);
}

}  // namespace

double chi_square_tail(double statistic, double degrees_of_freedom) {
  const double a = 0.5 * degrees_of_freedom;
  const double x = 0.5 * statistic;
  if (x <= 0.0) return 1.0;
  return x < a + 1.0 ? 1.0 - lower_gamma_series(a, x) : upper_gamma_fraction(a, x);
}

double sidak_significance(double overall, std::size_t tests) {
  return 1.0 - std::pow(1.0 - overall, 1.0 / static_cast<double>(tests));
}

ChiSquare pearson_test(std::span<const double> observed, std::span<const double> expected) {
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return expected[i]; });
  ChiSquare result;
  double pooled_observed = 0.0, pooled_expected = 0.0;
  int cells = 0;
  const auto close_cell = [&] {
    result.statistic += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
    ++cells;
    pooled_observed = pooled_expected = 0.0;
  };
  for (const std::size_t i : order) {
    if (expected[i] <= 0.0 && observed[i] > 0.0) result.impossible += observed[i];
    pooled_observed += observed[i];
    pooled_expected += expected[i];
    if (pooled_expected >= 5.0) close_cell();
  }
  if (pooled_expected > 0.0) close_cell();
  result.degrees_of_freedom = std::max(1, cells - 1);
  result.probability = chi_square_tail(result.statistic, result.degrees_of_freedom);
  return result;
}

DirectionChart height_chart() {
  return {.place =
              [](Vec3d d) {
                return Vec2d{d.z, wrapped_azimuth(std::atan2(d.y, d.x)) / (2.0 * pi)};
              },
          .direction =
              [](Vec2d place) {
                const double radius = std::sqrt(1.0 - place.x * place.x);
                return Vec3d{radius * std::cos(2.0 * pi * place.y), radius * std::sin(2.0 * pi * place.y), place.x};
              },
          .solid_angle = [](Vec2d) { return 2.0 * pi; }};
}

DirectionChart normal_chart(double width) {
  return {
      .place =
          [width](Vec3d d) {
            const double tangent = std::hypot(d.x, d.y) / d.z;
            return Vec2d{tangent / (width + tangent), wrapped_azimuth(std::atan2(d.y, d.x)) / (2.0 * pi)};
          },
      .direction = [width](Vec2d place) { return from_tangent(width * place.x / (1.0 - place.x), 2.0 * pi * place.y); },
      .solid_angle =
          [width](Vec2d place) {
            const double tangent = width * place.x / (1.0 - place.x);
            return 2.0 * pi * tangent * std::pow(1.0 + tangent * tangent, -1.5) * width / std::pow(1.0 - place.x, 2);
          }};
}

DirectionChart mirror_chart(Vec3d w, double width) {
  const DirectionChart normals = normal_chart(width);
  return {.place = [=](Vec3d d) { return normals.place(normalized(w + d)); },
          .direction =
              [=](Vec2d place) {
                const Vec3d m = normals.direction(place);
                return m * (2.0 * dot(w, m)) - w;
              },
          // A facet that shows its back mirrors nothing.
          .solid_angle =
              [=](Vec2d place) {
                return 4.0 * std::max(0.0, dot(w, normals.direction(place))) * normals.solid_angle(place);
              }};
}

SamplerVerdict tested(const Sampler& sampler, const DirectionChart& chart, std::size_t samples, std::uint64_t seed,
                      int rings, int sectors) {
  const auto cells = static_cast<std::size_t>(rings) * static_cast<std::size_t>(sectors);
  // The last entry counts the samples that give up.
  std::vector<double> expected(cells + 1), observed(cells + 1);
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      expected[static_cast<std::size_t>(ring * sectors + sector)] =
          static_cast<double>(samples) * cell_probability(sampler, chart, ring, sector, rings, sectors);
    }
  }
  SamplerVerdict verdict;
  verdict.total_density = std::accumulate(expected.begin(), expected.end(), 0.0) / static_cast<double>(samples);
  expected[cells] = std::max(0.0, 1.0 - verdict.total_density) * static_cast<double>(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const Vec3f direction = sampler.sample({unit_float(hashed(seed, i, 1)), unit_float(hashed(seed, i, 2))});
    if (direction.z <= 0.0F) {
      observed[cells] += 1.0;
      continue;
    }
    const Vec2d place = chart.place(direction.to<double>());
    const int ring = std::clamp(static_cast<int>(place.x * rings), 0, rings - 1);
    const int sector = std::clamp(static_cast<int>(place.y * sectors), 0, sectors - 1);
    observed[static_cast<std::size_t>(ring * sectors + sector)] += 1.0;
  }
  verdict.test = pearson_test(observed, expected);
  return verdict;
}

}  // namespace sigmascape::statistics_test
