#pragma once

#include <cmath>
#include <optional>

#include "sigmascape/base/sobol.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/cook_torrance.h"

namespace sigmascape::physics_test {

/// A mean and how far it may be off.
struct Estimate {
  double mean = 0.0;
  double standard_error = 0.0;
};

/// A wall of 10 m × 10 m that faces south on ground that reaches 60 m before it, seen `azimuth_off_rad` off its normal.
struct WallGroundView {
  double incidence_rad = 0.0;
  double azimuth_off_rad = 0.0;
};

/// Cross-section in m² of radar → wall → ground → radar, powers of all receive polarizations, of ideal conductors:
///
///     σ₁ = 4π ∬ b_w b_g cos θ_w,i cos θ_w,o cos θ_g,i cos θ_g,o / d² dA_w dA_g
///
/// by Sobol points over the wall and the directions from it. No path tracer has a part in this.
inline Estimate two_surface_integral(const scatter::CookTorrance& wall, const scatter::CookTorrance& ground,
                                     const WallGroundView& view, std::uint32_t points_per_batch = 1U << 17U) {
  constexpr double side_m = 10.0;
  constexpr int batches = 8;
  const Vec3f wall_normal{0.0F, -1.0F, 0.0F}, ground_normal{0.0F, 0.0F, 1.0F};
  const Vec3f to_radar =
      Vec3d{std::sin(view.incidence_rad) * std::sin(view.azimuth_off_rad),
            -std::sin(view.incidence_rad) * std::cos(view.azimuth_off_rad), std::cos(view.incidence_rad)}
          .to<float>();
  const scatter::FieldPair in{{scatter::PolarizationBasis(-to_radar).v, {}},
                              {scatter::PolarizationBasis(-to_radar).h, {}}};
  double sum = 0.0, squares = 0.0;
  for (int batch = 0; batch < batches; ++batch) {
    double mean = 0.0;
    for (std::uint32_t i = 0; i < points_per_batch; ++i) {
      const SobolPoint point(static_cast<std::uint64_t>(batch) + 101, i);
      const Vec2f place = point.pair(0);
      const scatter::DirectionSample drawn = wall.sample(to_radar, wall_normal, point.pair(1));
      const Vec3f d = drawn.direction;
      if (drawn.pdf <= 0.0F || d.z >= 0.0F || -d.y <= 0.0F) continue;
      const float flight_m = static_cast<float>(side_m) * place.y / -d.z;
      const float x = static_cast<float>(side_m) * (place.x - 0.5F) + d.x * flight_m;
      if (-d.y * flight_m > 60.0F || std::abs(x) > 65.0F) continue;
      const scatter::FieldPair at_ground = wall.scatter(in, to_radar, d, wall_normal, {}) * std::sqrt(-d.y / drawn.pdf);
      const scatter::FieldPair back = ground.scatter(at_ground, -d, to_radar, ground_normal, {});
      mean += static_cast<double>(back.mean_power() * to_radar.z * -to_radar.y) / points_per_batch;
    }
    const double sigma = 4.0 * pi * side_m * side_m * mean;
    sum += sigma / batches;
    squares += sigma * sigma / batches;
  }
  return {sum, std::sqrt(std::max(0.0, squares - sum * sum) / (batches - 1))};
}

}  // namespace sigmascape::physics_test
