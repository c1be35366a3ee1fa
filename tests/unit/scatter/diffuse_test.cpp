#include "sigmascape/scatter/diffuse.h"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>

#include "sigmascape/base/sobol.h"

namespace sigmascape::scatter {
namespace {

using Complex = std::complex<double>;

constexpr DiffuseAmplitudes surface{0.7F, 0.4F, 0.25F};
constexpr Depolarization partial{0.1, 0.35};

struct Matrix {
  Complex vv, vh, hv, hh;
};

/// Backscatter in the basis of the wave that the antenna sends.
Matrix drawn_matrix(const DiffusePolarization& polarization, PhaseDraw draw) {
  const Vec3f to_radar = normalized(Vec3f{0.3F, -0.5F, 0.6F});
  const PolarizationBasis basis(-to_radar);
  const FieldPair out = polarization.scatter({{basis.v, {}}, {basis.h, {}}}, surface, to_radar, to_radar, draw);
  const auto element = [](const Field& field, Vec3f unit) {
    const Amplitude a = field.along(unit);
    return Complex(a.re, a.im);
  };
  return {element(out.from_v, basis.v), element(out.from_h, basis.v), element(out.from_v, basis.h),
          element(out.from_h, basis.h)};
}

TEST(DiffusePolarization, DrawsKeepAllSecondMoments) {
  const DiffusePolarization polarization(partial);
  constexpr std::uint32_t points = 1U << 16U;
  double vv = 0.0, hh = 0.0, hv = 0.0;
  Complex vv_hh, vv_hv, hh_hv;
  for (std::uint32_t i = 0; i < points; ++i) {
    const Vec2f u = SobolPoint(5, i).pair(0);
    const Matrix s = drawn_matrix(polarization, {u.x, u.y});
    vv += std::norm(s.vv) / points;
    hh += std::norm(s.hh) / points;
    hv += std::norm(s.hv) / points;
    vv_hh += s.vv * std::conj(s.hh) / static_cast<double>(points);
    vv_hv += s.vv * std::conj(s.hv) / static_cast<double>(points);
    hh_hv += s.hh * std::conj(s.hv) / static_cast<double>(points);
  }
  EXPECT_NEAR(vv, 0.49, 1e-6);
  EXPECT_NEAR(hh, 0.16, 1e-6);
  EXPECT_NEAR(hv, 0.0625, 1e-6);
  EXPECT_NEAR(vv_hh.real(), 0.35 * 0.7 * 0.4, 1e-6);
  EXPECT_NEAR(vv_hh.imag(), 0.0, 1e-5);
  EXPECT_NEAR(std::abs(vv_hv), 0.0, 1e-5);
  EXPECT_NEAR(std::abs(hh_hv), 0.0, 1e-5);
}

TEST(DiffusePolarization, EveryDrawHasTheSamePowersAndIsReciprocal) {
  const DiffusePolarization polarization(partial);
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Vec2f u = SobolPoint(6, i).pair(0);
    const Matrix s = drawn_matrix(polarization, {u.x, u.y});
    EXPECT_NEAR(std::abs(s.vv), 0.7, 1e-6);
    EXPECT_NEAR(std::abs(s.hh), 0.4, 1e-6);
    EXPECT_NEAR(std::abs(s.hv), 0.25, 1e-6);
    EXPECT_NEAR(std::abs(s.hv - s.vh), 0.0, 1e-6);
  }
}

TEST(DiffusePolarization, BackscatterIsTheExpectationOfTheDraws) {
  const radar::Channels channels = DiffusePolarization(partial).backscatter(surface);
  EXPECT_NEAR(channels.vv, 0.49F, 1e-6F);
  EXPECT_NEAR(channels.hh, 0.16F, 1e-6F);
  EXPECT_NEAR(channels.hv, 0.0625F, 1e-6F);
  EXPECT_NEAR(channels.re_vvhh, 0.35F * 0.28F, 1e-6F);
}

// An odd number of bounces: a fully correlated surface answers a radar with VV and HH in phase.
TEST(DiffusePolarization, FullyCorrelatedSurfaceLooksLikeASphere) {
  const Matrix s = drawn_matrix(DiffusePolarization({0.0, 1.0}), {0.2F, 0.7F});
  EXPECT_NEAR(std::arg(s.vv * std::conj(s.hh)), 0.0, 1e-6);
}

TEST(DiffusePolarization, CrossRatioSplitsOneBrdf) {
  const DiffuseAmplitudes a = DiffusePolarization({0.04, 1.0}).amplitudes(0.25F);
  EXPECT_NEAR(a.vv, 0.5F, 1e-7F);
  EXPECT_NEAR(a.hh, 0.5F, 1e-7F);
  EXPECT_NEAR(a.hv, 0.1F, 1e-7F);
}

}  // namespace
}  // namespace sigmascape::scatter
