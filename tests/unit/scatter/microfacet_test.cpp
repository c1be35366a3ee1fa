#include "sigmascape/scatter/microfacet.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

#include "directions.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::scatter {
namespace {

constexpr double alphas[] = {0.002, 0.01, 0.05, 0.1, 0.3, 0.6, 1.0};

/// ∫ f(m) dω over all facet normals: midpoints in azimuth and in t, where tan θ = α t / (1 − t).
template <typename Function>
double over_facets(double alpha, const Function& f, int rings = 2000, int sectors = 64) {
  double sum = 0.0;
  for (int ring = 0; ring < rings; ++ring) {
    const double t = (ring + 0.5) / rings;
    const double tangent = alpha * t / (1.0 - t);
    const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    // dω = sin θ dθ dφ = tan θ cos³ θ d(tan θ) dφ
    const double ring_weight =
        tangent * std::pow(cosine, 3) * alpha / ((1.0 - t) * (1.0 - t)) / rings * 2.0 * pi / sectors;
    for (int sector = 0; sector < sectors; ++sector) {
      const double phi = 2.0 * pi * (sector + 0.5) / sectors;
      const Vec3d m{tangent * cosine * std::cos(phi), tangent * cosine * std::sin(phi), cosine};
      sum += ring_weight * f(m.to<float>());
    }
  }
  return sum;
}

class EveryDistribution : public testing::TestWithParam<MicrofacetDistribution> {};

TEST_P(EveryDistribution, ProjectedAreaOfFacetsIsOne) {
  for (const double alpha : alphas) {
    const Microfacets facets(GetParam(), static_cast<float>(alpha));
    const double area = over_facets(alpha, [&](Vec3f m) { return static_cast<double>(facets.density(m) * m.z); });
    EXPECT_NEAR(area, 1.0, 1e-4) << "α " << alpha;
  }
}

/// On edge D is 0, or α²/π where it falls off as a power.
TEST_P(EveryDistribution, HasALimitForFacetsOnEdge) {
  for (const float alpha : {0.001F, 0.1F}) {
    const double expected = GetParam() == MicrofacetDistribution::Ggx ? static_cast<double>(alpha * alpha) / pi : 0.0;
    for (const float cosine : {1e-6F, 1e-9F, 1e-12F, 1e-20F, 1e-40F})
      EXPECT_NEAR(Microfacets(GetParam(), alpha).density({1.0F, 0.0F, cosine}), expected, 1e-6)
          << alpha << " " << cosine;
  }
}

TEST_P(EveryDistribution, VisibleFacetsFillTheView) {
  for (const double alpha : alphas) {
    const Microfacets facets(GetParam(), static_cast<float>(alpha));
    for (const double incidence_deg : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0}) {
      const Vec3f w = direction(incidence_deg);
      const double visible = over_facets(
          alpha,
          [&](Vec3f m) {
            return static_cast<double>(facets.visible_part(w.z) * facets.density(m) * std::max(0.0F, dot(w, m)) / w.z);
          },
          1500, 360);
      EXPECT_NEAR(visible, 1.0, 1e-3) << "α " << alpha << " at " << incidence_deg << "°";
    }
  }
}

TEST_P(EveryDistribution, CorrelatedMaskingIsOneWayMaskingInBackscatter) {
  const Microfacets facets(GetParam(), 0.6F);
  for (const double incidence_deg : {0.0, 45.0, 70.0, 85.0}) {
    const Vec3f w = direction(incidence_deg, 33.0);
    EXPECT_FLOAT_EQ(facets.visible_part(w, w), facets.visible_part(w.z));
  }
}

TEST_P(EveryDistribution, MaskingLiesBetweenIndependentAndOneWay) {
  const Microfacets correlated(GetParam(), 0.6F);
  const Microfacets separable(GetParam(), 0.6F, Masking::Separable);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3f a = direction(90.0 * unit_float(hashed(i, 1)), 360.0 * unit_float(hashed(i, 2)));
    const Vec3f b = direction(90.0 * unit_float(hashed(i, 3)), 360.0 * unit_float(hashed(i, 4)));
    EXPECT_LE(correlated.visible_part(a, b),
              std::min(correlated.visible_part(a.z), correlated.visible_part(b.z)) * (1.0F + 1e-6F));
    EXPECT_GE(correlated.visible_part(a, b), separable.visible_part(a, b) * (1.0F - 1e-6F));
    EXPECT_FLOAT_EQ(separable.visible_part(a, b), correlated.visible_part(a.z) * correlated.visible_part(b.z));
  }
}

TEST_P(EveryDistribution, SampledFacetsFaceTheViewer) {
  for (const double alpha : alphas) {
    const Microfacets facets(GetParam(), static_cast<float>(alpha));
    for (const double incidence_deg : {0.0, 45.0, 85.0, 89.9}) {
      const Vec3f w = direction(incidence_deg, 120.0);
      for (std::uint64_t i = 0; i < 2000; ++i) {
        const Vec3f m = facets.visible_normal(w, {unit_float(hashed(i, 1)), unit_float(hashed(i, 2))});
        EXPECT_NEAR(length(m), 1.0F, 1e-5F);
        EXPECT_GE(dot(w, m), -1e-6F) << "α " << alpha << " at " << incidence_deg << "°";
      }
    }
  }
}

TEST_P(EveryDistribution, SamplingSurvivesTheEndsOfTheUnitSquare) {
  const float ends[] = {0.0F, 0x1p-24F, 0.5F, 1.0F - 0x1p-24F};
  for (const double alpha : alphas) {
    const Microfacets facets(GetParam(), static_cast<float>(alpha));
    for (const double incidence_deg : {0.0, 1e-4, 60.0, 89.99}) {
      for (const float x : ends) {
        for (const float y : ends)
          EXPECT_NEAR(length(facets.visible_normal(direction(incidence_deg), {x, y})), 1.0F, 1e-5F);
      }
    }
  }
}

/// The part of the facets whose tilt has a tangent up to α, as a wave along the normal sees them.
double part_within_alpha(MicrofacetDistribution distribution) {
  return distribution == MicrofacetDistribution::Beckmann ? 1.0 - std::exp(-1.0) : 0.5;
}

// Of a wave that meets a tilted face head-on, the part across the normal is nothing but rounding. From a thousandth of
// a degree to a tenth the facets that are seen are still those of a wave along the normal.
TEST_P(EveryDistribution, FacetsSeenHeadOnLeanAllWaysAlike) {
  constexpr int tilts = 40, draws = 1000;
  for (const double off_deg : {0.0, 1e-5, 1e-4, 1e-3, 1e-2, 0.1}) {
    for (const double alpha : {0.05, 1.0}) {
      const Microfacets facets(GetParam(), static_cast<float>(alpha));
      int within = 0, with_view = 0, along = 0;
      for (std::uint64_t tilt = 0; tilt < tilts; ++tilt) {
        const Vec3f normal = direction(85.0 * unit_float(hashed(tilt, 1)), 360.0 * unit_float(hashed(tilt, 2)));
        const Basis basis(normal);
        const Vec3f w = normalized(basis.world_from_local(direction(off_deg, 360.0 * unit_float(hashed(tilt, 3)))));
        for (std::uint64_t i = 0; i < draws; ++i) {
          const std::uint64_t draw = hashed(tilt, i);
          const Vec3f m = basis.local_from_world(
              facets.visible_normal(w, normal, {unit_float(hashed(draw, 4)), unit_float(hashed(draw, 5))}));
          within += std::hypot(m.x, m.y) <= alpha * m.z ? 1 : 0;
          with_view += m.x > 0.0F ? 1 : 0;
          along += std::abs(m.x) > std::abs(m.y) ? 1 : 0;
        }
      }
      constexpr double all = tilts * draws;
      EXPECT_NEAR(within / all, part_within_alpha(GetParam()), 0.01) << "α " << alpha << ", " << off_deg << "° off";
      EXPECT_NEAR(with_view / all, 0.5, 0.01) << "α " << alpha << ", " << off_deg << "° off";
      EXPECT_NEAR(along / all, 0.5, 0.01) << "α " << alpha << ", " << off_deg << "° off";
    }
  }
}

// ∫ b cos θ dω of ideal mirrors, by samples from a tilted face and by quadrature over the facets of a level one.
TEST_P(EveryDistribution, TiltedFacesMetHeadOnReturnWhatLevelOnesDo) {
  const Microfacets facets(GetParam(), 1.0F);
  const Vec3f up{0.0F, 0.0F, 1.0F};
  const double expected = over_facets(
      1.0,
      [&](Vec3f m) {
        const Vec3f out = m * (2.0F * m.z) - up;
        return out.z > 0.0F ? static_cast<double>(facets.density(m) * facets.visible_part(up, out) * m.z) : 0.0;
      },
      2000, 4);
  const Vec3f normal = normalized(Vec3f{0.2F, -0.3F, 0.9F});
  double returned = 0.0;
  constexpr int draws = 40'000;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const Vec3f m = facets.visible_normal(normal, normal, {unit_float(hashed(i, 1)), unit_float(hashed(i, 2))});
    const Vec3f out = m * (2.0F * dot(normal, m)) - normal;
    if (dot(out, normal) > 0.0F) returned += static_cast<double>(facets.visible_part(dot(out, normal))) / draws;
  }
  EXPECT_NEAR(returned, expected, 0.01 * expected);
}

std::string distribution_name(const testing::TestParamInfo<MicrofacetDistribution>& info) {
  return info.param == MicrofacetDistribution::Beckmann ? "Beckmann" : "Ggx";
}

INSTANTIATE_TEST_SUITE_P(Microfacets, EveryDistribution,
                         testing::Values(MicrofacetDistribution::Beckmann, MicrofacetDistribution::Ggx),
                         distribution_name);

// The slopes of visible Beckmann facets along the view have the distribution c (1 + erf x)/2 + exp(−x²)/(2√π) up to x =
// c = cot θ/α, which sampling must invert to nearly single precision from above to grazing, into both tails.
TEST(Microfacets, BeckmannSlopesInvertTheirDistribution) {
  const auto distribution = [](double c, double x) {
    return 0.5 * c * std::erfc(-x) + 0.5 * std::numbers::inv_sqrtpi * std::exp(-x * x);
  };
  for (const double alpha : {0.05, 0.3, 1.0}) {
    const Microfacets facets(MicrofacetDistribution::Beckmann, static_cast<float>(alpha));
    for (const double incidence_deg : {1.0, 30.0, 60.0, 85.0, 89.0, 89.9}) {
      const Vec3f w = direction(incidence_deg);
      const double c = w.z / (alpha * w.x);
      const double last = std::min(c, 6.0);
      for (const float u : {1e-4F, 0.001F, 0.02F, 0.1F, 0.3F, 0.5F, 0.7F, 0.9F, 0.98F, 0.999F}) {
        const Vec3f m = facets.visible_normal(w, {u, 0.5F});
        const double slope = -m.x / (m.z * alpha);
        EXPECT_NEAR(distribution(c, slope) / distribution(c, last), u, 2e-6 + 2e-6 * u)
            << "α " << alpha << " at " << incidence_deg << "°";
      }
    }
  }
}

// GGX of α = 1 at 45° has Λ = (√2 − 1)/2 in closed form, from which Heitz's Eq. (101) follows for any azimuth between
// two directions.
TEST(Microfacets, AzimuthDecorrelatesMasking) {
  const Microfacets facets(MicrofacetDistribution::Ggx, 1.0F);
  const double hidden = 0.5 * (std::sqrt(2.0) - 1.0);
  for (const double azimuth_deg : {0.0, 5.0, 30.0, 90.0, 180.0, 270.0}) {
    const double between = radians_from_deg(std::min(azimuth_deg, 360.0 - azimuth_deg));
    const double independence = 4.41 * between / (4.41 * between + 1.0);
    EXPECT_NEAR(facets.visible_part(direction(45.0, 10.0), direction(45.0, 10.0 + azimuth_deg)),
                1.0 / (1.0 + hidden * (1.0 + independence)), 2e-6)
        << azimuth_deg << "°";
  }
}

// The mean square slope tells α from the rms slope: α² = 2 s² per axis.
TEST(Microfacets, BeckmannAlphaIsRootTwoTimesTheSlopeOfOneAxis) {
  for (const double alpha : {0.05, 0.3, 1.0}) {
    const Microfacets facets(MicrofacetDistribution::Beckmann, static_cast<float>(alpha));
    const double mean_square = over_facets(alpha, [&](Vec3f m) {
      const double slope = m.x / m.z;
      return slope * slope * static_cast<double>(facets.density(m) * m.z);
    });
    EXPECT_NEAR(mean_square, alpha * alpha / 2.0, 1e-3 * alpha * alpha);
  }
}

}  // namespace
}  // namespace sigmascape::scatter
