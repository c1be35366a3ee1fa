#pragma once

#include <cmath>

#include "physics/directions.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scatter/cook_torrance.h"

namespace sigmascape::physics_test {

using scatter::CookTorrance;
using scatter::CookTorranceOptions;
using scatter::Masking;
using scatter::MicrofacetDistribution;
using scatter::Microfacets;

inline CookTorrance conducting(MicrofacetDistribution distribution, double alpha,
                               const CookTorranceOptions& options = {}) {
  return {{{1.0, 0.0, 1e13, 0.0}, alpha, distribution}, 10e9, options};
}

/// σ0 = 4π b cos² θ.
inline double sigma0(const CookTorrance& surface, double incidence_rad) {
  return 4.0 * pi * static_cast<double>(surface.backscatter(direction_at(incidence_rad), up).vv) *
         std::pow(std::cos(incidence_rad), 2);
}

inline double unmasked_sigma0(MicrofacetDistribution distribution, double alpha, double incidence_rad) {
  return pi *
         static_cast<double>(Microfacets(distribution, static_cast<float>(alpha)).density(direction_at(incidence_rad)));
}

/// ∫ b cos θo dωo over both receive polarizations for an incoming wave of `v` polarization: midpoints over facet
/// normals m, with dωo = 4 (w·m) dm, and tan θm = α t / (1 − t).
inline double directional_albedo(const CookTorrance& surface, double alpha, double incidence_rad, int rings = 1000,
                                 int sectors = 360) {
  const Vec3f w = direction_at(incidence_rad);
  const scatter::PolarizationBasis basis(-w);
  double sum = 0.0;
  for (int ring = 0; ring < rings; ++ring) {
    const double t = (ring + 0.5) / rings;
    const double tangent = alpha * t / (1.0 - t);
    const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    const double solid_angle =
        tangent * std::pow(cosine, 3) * alpha / ((1.0 - t) * (1.0 - t)) / rings * 2.0 * pi / sectors;
    for (int sector = 0; sector < sectors; ++sector) {
      const double phi = 2.0 * pi * (sector + 0.5) / sectors;
      const Vec3f m = Vec3d{tangent * cosine * std::cos(phi), tangent * cosine * std::sin(phi), cosine}.to<float>();
      const float facing = dot(w, m);
      const Vec3f out = m * (2.0F * facing) - w;
      if (facing <= 0.0F || out.z <= 0.0F) continue;
      const scatter::FieldPair fields =
          surface.scatter({{basis.v, {}}, {basis.h, {}}}, w, normalized(out), up, {0.3F, 0.6F});
      sum += static_cast<double>(fields.mean_power() * out.z * 4.0F * facing) * solid_angle;
    }
  }
  return sum;
}

/// σ / (π a²) of a sphere = 2 ∫ σ0(θ) sin θ dθ.
template <typename Sigma0>
double sphere_over_disk(const Sigma0& sigma0_at) {
  constexpr int steps = 200'000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double theta = (i + 0.5) / steps * pi / 2.0;
    sum += 2.0 * sigma0_at(theta) * std::sin(theta) * (pi / 2.0) / steps;
  }
  return sum;
}

}  // namespace sigmascape::physics_test
