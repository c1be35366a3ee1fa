#include "sigmascape/scatter/cook_torrance.h"

#include <gtest/gtest.h>
#include <numbers>

#include "directions.h"

#include "sigmascape/base/hash.h"

namespace sigmascape::scatter {
namespace {

constexpr CookTorranceParameters concrete{{5.24, 0.0, 0.0462, 0.7822}, 0.3, MicrofacetDistribution::Beckmann};
constexpr double frequency_hz = 10e9;

/// The channels of the fields that return to where the wave came from, in the bases of the radar: h as seen on
/// transmission.
radar::Channels returned(const CookTorrance& surface, Vec3f to_radar, Vec3f normal, PhaseDraw draw = {}) {
  const PolarizationBasis basis(-to_radar);
  const FieldPair out = surface.scatter({{basis.v, {}}, {basis.h, {}}}, to_radar, to_radar, normal, draw);
  return {power_of(out.from_v.along(basis.v)), power_of(out.from_h.along(basis.h)), power_of(out.from_v.along(basis.h)),
          correlation_of(out.from_v.along(basis.v), out.from_h.along(basis.h))};
}

TEST(CookTorrance, BackscatterIsWhatScatterReturns) {
  const CookTorrance surface(concrete, frequency_hz);
  for (const double incidence_deg : {0.0, 5.0, 20.0, 45.0}) {
    const Vec3f to_radar = direction(incidence_deg, 70.0);
    const radar::Channels expected = surface.backscatter(to_radar, up);
    const radar::Channels measured = returned(surface, to_radar, up);
    EXPECT_NEAR(measured.vv, expected.vv, 1e-4F * expected.vv);
    EXPECT_NEAR(measured.hh, expected.hh, 1e-4F * expected.vv);
    EXPECT_NEAR(measured.hv, 0.0F, 1e-6F * expected.vv);
    EXPECT_NEAR(measured.re_vvhh, expected.re_vvhh, 1e-4F * expected.vv);
  }
}

// A facet that answers is seen head-on, so tilt makes no cross-polarization.
TEST(CookTorrance, TiltedSurfaceDoesNotDepolarizeBackscatter) {
  const CookTorrance surface(concrete, frequency_hz);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Vec3f normal = direction(40.0 * unit_float(hashed(i, 1)), 360.0 * unit_float(hashed(i, 2)));
    const radar::Channels back = returned(surface, direction(40.0, 10.0), normal);
    EXPECT_LE(back.hv, 1e-6F * back.vv);
    EXPECT_NEAR(back.hh, back.vv, 1e-4F * back.vv);
  }
}

TEST(CookTorrance, NothingLeavesBelowTheSurface) {
  const CookTorrance surface(concrete, frequency_hz);
  const PolarizationBasis basis(-direction(60.0, 0.0));
  const FieldPair in{{basis.v, {}}, {basis.h, {}}};
  EXPECT_EQ(surface.scatter(in, direction(60.0, 0.0), direction(91.0, 180.0), up, {}).mean_power(), 0.0F);
  EXPECT_EQ(surface.pdf(direction(60.0, 0.0), direction(91.0, 180.0), up), 0.0F);
}

TEST(CookTorrance, SampleReportsItsOwnDensity) {
  for (const bool multiple_scatter : {false, true}) {
    const CookTorrance surface(concrete, frequency_hz, {.multiple_scatter = multiple_scatter});
    for (std::uint64_t i = 0; i < 500; ++i) {
      const DirectionSample drawn =
          surface.sample(direction(50.0, 0.0), up, {unit_float(hashed(i, 1)), unit_float(hashed(i, 2))});
      EXPECT_FLOAT_EQ(drawn.pdf, surface.pdf(direction(50.0, 0.0), drawn.direction, up));
    }
  }
}

TEST(MultipleScatter, IsOffUnlessAskedFor) {
  const CookTorrance plain(concrete, frequency_hz);
  const CookTorrance full(concrete, frequency_hz, {.multiple_scatter = true});
  const Vec3f to_radar = direction(60.0, 0.0);
  EXPECT_EQ(plain.backscatter(to_radar, up).hv, 0.0F);
  EXPECT_GT(full.backscatter(to_radar, up).hv, 0.0F);
}

// ⟨|S|²⟩ over the draw is the sum of the mirrors' and the diffuse power: the two never interfere on average.
TEST(MultipleScatter, AddsInPowerAndDepolarizes) {
  const CookTorrance plain(concrete, frequency_hz);
  const CookTorrance full(concrete, frequency_hz, {.multiple_scatter = true});
  const Vec3f to_radar = direction(50.0, 25.0);
  constexpr int steps = 64;
  radar::Channels mean;
  for (int i = 0; i < steps * steps; ++i) {
    const PhaseDraw draw{(static_cast<float>(i % steps) + 0.5F) / steps,
                         (static_cast<float>(i) / steps + 0.5F) / steps};
    mean += returned(full, to_radar, up, draw) * (1.0F / (steps * steps));
  }
  const radar::Channels expected = full.backscatter(to_radar, up);
  const float added = expected.vv - plain.backscatter(to_radar, up).vv;
  EXPECT_GT(added, 0.0F);
  EXPECT_NEAR(mean.vv, expected.vv, 1e-3F * expected.vv);
  EXPECT_NEAR(mean.hh, expected.hh, 1e-3F * expected.vv);
  EXPECT_NEAR(mean.hv, added, 1e-3F * added);
  EXPECT_NEAR(mean.re_vvhh, expected.re_vvhh, 1e-3F * expected.vv);
}

TEST(MultipleScatter, TableOfAlbedoFollowsTheSurface) {
  const Microfacets smooth(MicrofacetDistribution::Beckmann, 0.05F);
  const Microfacets rough(MicrofacetDistribution::Ggx, 1.0F);
  EXPECT_NEAR(MultipleScatter(smooth, {1.0F, -1e9F}).single_albedo(1.0F), 1.0F, 1e-4F);
  // Closed form for GGX of α = 1 seen from above: 1 − ln 2.
  EXPECT_NEAR(MultipleScatter(rough, {1.0F, -1e9F}).single_albedo(1.0F), 1.0F - std::numbers::ln2_v<float>, 1e-3F);
}

}  // namespace
}  // namespace sigmascape::scatter
