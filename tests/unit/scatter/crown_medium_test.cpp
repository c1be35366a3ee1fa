#include "sigmascape/scatter/crown_medium.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "sigmascape/base/sobol.h"
#include "sigmascape/scatter/fresnel.h"

namespace sigmascape::scatter {
namespace {

constexpr Vec3f no_normal{};
constexpr double four_pi = 4.0 * std::numbers::pi;

CrownMedium isotropic() {
  return {{.albedo = 0.7, .depolarization = {0.2, 0.4}}, 10e9};
}
CrownMedium mirrors() {
  return {{.leaf = Permittivity::constant(16.0, 4.0)}, 10e9};
}

Vec3f even_direction(std::uint32_t i, std::uint32_t pair) {
  return isotropic().sample({}, {}, SobolPoint(5, i).pair(pair)).direction;
}

/// The scattering matrix in the bases of antennas at both ends: [sent][received].
std::array<std::array<Amplitude, 2>, 2> matrix(const CrownMedium& medium, Vec3f to_source, Vec3f to_sink,
                                               PhaseDraw draw) {
  const PolarizationBasis sent(-to_source), received(-to_sink);
  const FieldPair out = medium.scatter({{sent.v, {}}, {sent.h, {}}}, to_source, to_sink, no_normal, draw);
  return {{{out.from_v.along(received.v), out.from_v.along(received.h)},
           {out.from_h.along(received.v), out.from_h.along(received.h)}}};
}

TEST(CrownMedium, IsReciprocal) {
  for (const CrownMedium& medium : {isotropic(), mirrors()}) {
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const Vec3f a = even_direction(i, 0), b = even_direction(i, 1);
      const Vec2f u = SobolPoint(5, i).pair(2);
      const auto there = matrix(medium, a, b, {u.x, u.y}), back = matrix(medium, b, a, {u.x, u.y});
      for (std::size_t p = 0; p < 2; ++p) {
        for (std::size_t q = 0; q < 2; ++q) {
          const Amplitude difference = there[p][q] - back[q][p];
          ASSERT_LT(power_of(difference), 1e-10F) << i << ": " << p << q;
        }
      }
    }
  }
}

TEST(CrownMedium, ScattersItsAlbedo) {
  for (const CrownMedium& medium : {isotropic(), mirrors()}) {
    double power = 0.0;
    constexpr std::uint32_t points = 1U << 16U;
    const Vec3f to_source{0.6F, 0.0F, 0.8F};
    const PolarizationBasis sent(-to_source);
    for (std::uint32_t i = 0; i < points; ++i) {
      const Vec2f u = SobolPoint(5, i).pair(2);
      const FieldPair out =
          medium.scatter({{sent.v, {}}, {sent.h, {}}}, to_source, even_direction(i, 0), no_normal, {u.x, u.y});
      power += static_cast<double>(out.mean_power()) * four_pi / points;
    }
    EXPECT_NEAR(power / static_cast<double>(medium.albedo()), 1.0, 0.003);
  }
}

TEST(CrownMedium, MirrorsReturnNormalReflectionEvenly) {
  const CrownMedium medium = mirrors();
  const std::complex<float> permittivity(Permittivity::constant(16.0, 4.0).relative_at(10e9));
  const double reflectivity = power_of(fresnel(permittivity, 1.0F).s);
  const radar::Channels brdf = medium.backscatter({0.0F, 0.6F, 0.8F}, no_normal);
  EXPECT_NEAR(static_cast<double>(brdf.vv) * four_pi, reflectivity, 1e-5);
  EXPECT_EQ(brdf.vv, brdf.hh);
  EXPECT_EQ(brdf.hv, 0.0F);
  EXPECT_EQ(brdf.re_vvhh, brdf.vv);
  EXPECT_NEAR(static_cast<double>(medium.albedo()), static_cast<double>(mean_reflectivity(permittivity)), 1e-6);
}

TEST(CrownMedium, BackscatterIsTheMeanOfItsDraws) {
  for (const CrownMedium& medium : {isotropic(), mirrors()}) {
    const Vec3f to_radar{0.6F, 0.0F, 0.8F};
    radar::Channels mean;
    constexpr std::uint32_t points = 4096;
    for (std::uint32_t i = 0; i < points; ++i) {
      const Vec2f u = SobolPoint(5, i).pair(2);
      const auto s = matrix(medium, to_radar, to_radar, {u.x, u.y});
      mean +=
          radar::Channels{power_of(s[0][0]), power_of(s[1][1]), power_of(s[0][1]), correlation_of(s[0][0], s[1][1])} *
          (1.0F / points);
    }
    const radar::Channels stated = medium.backscatter(to_radar, no_normal);
    EXPECT_NEAR(mean.vv / stated.vv, 1.0F, 1e-3F);
    EXPECT_NEAR(mean.hh / stated.hh, 1.0F, 1e-3F);
    EXPECT_NEAR(mean.hv, stated.hv, 1e-3F * stated.vv);
    EXPECT_NEAR(mean.re_vvhh / stated.re_vvhh, 1.0F, 1e-3F);
  }
}

}  // namespace
}  // namespace sigmascape::scatter
