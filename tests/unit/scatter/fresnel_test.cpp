#include "sigmascape/scatter/fresnel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::scatter {
namespace {

using Complex = std::complex<double>;

constexpr std::array<Complex, 8> permittivities{Complex{1.05, 0.0},   {2.0, -0.01},   {5.24, -0.503}, {16.6, -7.4},
                                                Complex{60.8, -32.7}, {50.0, -179.8}, {1e5, -1.8e5},  {1.0, -1.8e9}};

struct Exact {
  Complex s, p;
};

/// The textbook formulas in double precision.
Exact exact_fresnel(Complex permittivity, double cos_incidence) {
  const Complex q = std::sqrt(permittivity - (1.0 - cos_incidence * cos_incidence));
  return {(cos_incidence - q) / (cos_incidence + q),
          (permittivity * cos_incidence - q) / (permittivity * cos_incidence + q)};
}

Complex exact(Amplitude a) {
  return {a.re, a.im};
}

std::complex<float> single(Complex z) {
  return {static_cast<float>(z.real()), static_cast<float>(z.imag())};
}

Vec3f any_direction(std::uint64_t key) {
  const float z = 2.0F * unit_float(hashed(key, 1)) - 1.0F;
  const float azimuth = 2.0F * static_cast<float>(pi) * unit_float(hashed(key, 2));
  const float radius = std::sqrt(1.0F - z * z);
  return normalized(Vec3f{radius * std::cos(azimuth), radius * std::sin(azimuth), z});
}

Complex along(const std::array<Complex, 3>& e, Vec3d unit) {
  return e[0] * unit.x + e[1] * unit.y + e[2] * unit.z;
}

/// r_s (E·s) s + r_p (E·p_i) p_o in double precision.
std::array<Complex, 3> exact_reflection(const Field& in, Complex permittivity, Vec3d travel_in, Vec3d travel_out,
                                        Vec3d facet) {
  const Exact r = exact_fresnel(permittivity, -dot(travel_in, facet));
  const Vec3d s = normalized(cross(travel_in, facet));
  const Vec3d p_in = cross(s, travel_in);
  const Vec3d p_out = cross(s, travel_out);
  const std::array<Complex, 3> e{Complex(in.re.x, in.im.x), Complex(in.re.y, in.im.y), Complex(in.re.z, in.im.z)};
  const Complex a = r.s * along(e, s);
  const Complex b = r.p * along(e, p_in);
  return {a * s.x + b * p_out.x, a * s.y + b * p_out.y, a * s.z + b * p_out.z};
}

double distance(const Field& a, const std::array<Complex, 3>& b) {
  return std::max({std::abs(Complex(a.re.x, a.im.x) - b[0]), std::abs(Complex(a.re.y, a.im.y) - b[1]),
                   std::abs(Complex(a.re.z, a.im.z) - b[2])});
}

TEST(Fresnel, AgreesWithDoublePrecisionAtEveryAngleAndPermittivity) {
  for (const Complex permittivity : permittivities) {
    for (int degree = 0; degree < 90; ++degree) {
      const auto cos_incidence = static_cast<float>(std::cos(radians_from_deg(degree)));
      const FresnelCoefficients r = fresnel(single(permittivity), cos_incidence);
      const Exact expected = exact_fresnel(permittivity, cos_incidence);
      EXPECT_LT(std::abs(exact(r.s) - expected.s), 2e-6) << permittivity << " at " << degree << "°";
      EXPECT_LT(std::abs(exact(r.p) - expected.p), 2e-6) << permittivity << " at " << degree << "°";
    }
  }
}

TEST(Fresnel, PolarizationsDifferBySignOnlyAtNormalIncidence) {
  for (const Complex permittivity : permittivities) {
    const FresnelCoefficients r = fresnel(single(permittivity), 1.0F);
    EXPECT_NEAR(r.p.re, -r.s.re, 1e-6F);
    EXPECT_NEAR(r.p.im, -r.s.im, 1e-6F);
  }
}

TEST(Fresnel, EverythingIsReflectedAtGrazing) {
  for (const Complex permittivity : permittivities) {
    const FresnelCoefficients r = fresnel(single(permittivity), 0.0F);
    EXPECT_NEAR(std::abs(exact(r.s) + 1.0), 0.0, 1e-5);
    EXPECT_NEAR(std::abs(exact(r.p) + 1.0), 0.0, 1e-5);
  }
}

TEST(Fresnel, ReflectsNoMoreThanArrives) {
  for (const Complex permittivity : permittivities) {
    for (int i = 0; i <= 1000; ++i) {
      const FresnelCoefficients r = fresnel(single(permittivity), static_cast<float>(i) / 1000.0F);
      EXPECT_LE(power_of(r.s), 1.0F + 1e-6F);
      EXPECT_LE(power_of(r.p), 1.0F + 1e-6F);
    }
  }
}

TEST(Reflected, IsTheTextbookDecompositionIntoSAndP) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Complex permittivity = permittivities[i % permittivities.size()];
    const Vec3f facet = any_direction(hashed(i, 10));
    Vec3f travel_in = any_direction(hashed(i, 11));
    if (dot(travel_in, facet) > 0.0F) travel_in = -travel_in;
    if (length(cross(travel_in, facet)) < 0.01F) continue;
    const Vec3f travel_out = normalized(travel_in - facet * (2.0F * dot(travel_in, facet)));
    const PolarizationBasis basis(travel_in);
    const FieldPair in{{basis.v, basis.h * 0.5F}, {basis.h, basis.v * -0.3F}};
    const FieldPair out = reflected(in, single(permittivity), travel_in, travel_out, facet);
    const Vec3d k_in = travel_in.to<double>();
    const Vec3d m = facet.to<double>();
    const Vec3d k_out = k_in - m * (2.0 * dot(k_in, m));
    // At the pseudo-Brewster angle of a conductor r_p turns by √|ε| for each unit of cos θ, which holds only 24 bits.
    const double tolerance =
        3e-6 + 2e-7 * std::sqrt(std::abs(permittivity)) / (1.0 + std::abs(permittivity) * std::pow(dot(k_in, m), 2));
    EXPECT_LT(distance(out.from_v, exact_reflection(in.from_v, permittivity, k_in, k_out, m)), tolerance)
        << permittivity << " draw " << i;
    EXPECT_LT(distance(out.from_h, exact_reflection(in.from_h, permittivity, k_in, k_out, m)), tolerance)
        << permittivity << " draw " << i;
  }
}

TEST(Reflected, IsSmoothThroughNormalIncidence) {
  const Vec3f facet{0.0F, 0.0F, 1.0F};
  for (const float tilt : {0.0F, 1e-7F, 1e-6F, 1e-5F, 3e-5F, 1e-4F}) {
    for (int turn = 0; turn < 8; ++turn) {
      const float azimuth = static_cast<float>(turn) * 0.7F;
      const Vec3f travel_in{tilt * std::cos(azimuth), tilt * std::sin(azimuth), -1.0F};
      const Vec3f travel_out{travel_in.x, travel_in.y, 1.0F};
      const Field east{{1.0F, 0.0F, travel_in.x}, {}};
      const Field north{{0.0F, 1.0F, travel_in.y}, {}};
      const FieldPair out = reflected({east, north}, {5.24F, -0.503F}, travel_in, travel_out, facet);
      const Exact r = exact_fresnel({5.24, -0.503}, 1.0);
      EXPECT_LT(distance(out.from_v, {r.s, 0.0, -r.s * static_cast<double>(travel_in.x)}), 1e-6)
          << tilt << " " << azimuth;
      EXPECT_LT(distance(out.from_h, {0.0, r.s, -r.s * static_cast<double>(travel_in.y)}), 1e-6)
          << tilt << " " << azimuth;
    }
  }
}

TEST(Reflected, LeavesAcrossTheOutgoingWave) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Vec3f facet = any_direction(hashed(i, 20));
    Vec3f travel_in = any_direction(hashed(i, 21));
    if (dot(travel_in, facet) > 0.0F) travel_in = -travel_in;
    const Vec3f travel_out = normalized(travel_in - facet * (2.0F * dot(travel_in, facet)));
    const PolarizationBasis basis(travel_in);
    const FieldPair out = reflected({{basis.v, {}}, {basis.h, {}}}, {16.6F, -7.4F}, travel_in, travel_out, facet);
    EXPECT_LT(std::sqrt(power_of(out.from_v.along(travel_out))), 1e-6F);
    EXPECT_LT(std::sqrt(power_of(out.from_h.along(travel_out))), 1e-6F);
  }
}

TEST(MeanReflectivity, AgreesWithFineQuadratureInDoublePrecision) {
  for (const Complex permittivity : permittivities) {
    constexpr int steps = 200'000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double root = (i + 0.5) / steps;
      const Exact r = exact_fresnel(permittivity, root * root);
      sum += (std::norm(r.s) + std::norm(r.p)) * 2.0 * std::pow(root, 3) / steps;
    }
    EXPECT_NEAR(mean_reflectivity(single(permittivity)), sum, 2e-5) << permittivity;
  }
}

}  // namespace
}  // namespace sigmascape::scatter
