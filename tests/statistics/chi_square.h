#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sigmascape/base/vec.h"

namespace sigmascape::statistics_test {

/// The probability that a χ² variable of so many degrees of freedom exceeds `statistic`: Q(k/2, χ²/2), the regularised
/// upper incomplete gamma function.
[[nodiscard]] double chi_square_tail(double statistic, double degrees_of_freedom);

/// The significance at which each of n tests must be run so that all n pass with probability 1 − `overall` when all are
/// true [Šidák 1967].
[[nodiscard]] double sidak_significance(double overall, std::size_t tests);

/// What Pearson's test says about counts.
struct ChiSquare {
  double statistic = 0.0;
  double degrees_of_freedom = 0.0;
  double probability = 0.0;  ///< of a statistic at least as large when the density is the right one
  double impossible = 0.0;   ///< samples that fell into cells where the density is zero throughout
};

/// Compares counts with what is expected. Cells where fewer than five are expected are pooled, the rarest first.
[[nodiscard]] ChiSquare pearson_test(std::span<const double> observed, std::span<const double> expected);

/// The sphere of directions laid out on the unit square, in such a way that a density worth testing spreads over many
/// cells.
struct DirectionChart {
  std::function<Vec2d(Vec3d)> place;         ///< where on [0,1)² a direction lies
  std::function<Vec3d(Vec2d)> direction;     ///< the inverse
  std::function<double(Vec2d)> solid_angle;  ///< steradians per unit area of the square
};

/// Height over the horizon and azimuth: for lobes as wide as the hemisphere.
[[nodiscard]] DirectionChart height_chart();
/// The facet normal that mirrors `w` into the direction, by tan θ = width t / (1 − t) and azimuth: for mirror lobes of
/// that width.
[[nodiscard]] DirectionChart mirror_chart(Vec3d w, double width);
/// The direction itself by tan θ = width t / (1 − t) and azimuth: for densities of facet normals.
[[nodiscard]] DirectionChart normal_chart(double width);

/// A sampler next to the density it claims, in a frame whose z axis is the surface normal.
struct Sampler {
  /// A direction from two numbers in [0, 1)², or one with z ≤ 0 where the sampler gives up.
  std::function<Vec3f(Vec2f)> sample;
  std::function<double(Vec3f)> pdf;
};

struct SamplerVerdict {
  ChiSquare test;
  double total_density = 0.0;  ///< ∫ pdf dω
};

/// Draws `samples` directions and tests how they fall on a grid of rings × sectors against the integral of the density
/// over each cell; what the density lacks of 1 must be the part of samples that give up.
[[nodiscard]] SamplerVerdict tested(const Sampler& sampler, const DirectionChart& chart, std::size_t samples,
                                    std::uint64_t seed, int rings = 40, int sectors = 72);

}  // namespace sigmascape::statistics_test
