#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "validation/validation_record.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/cook_torrance.h"

namespace sigmascape::scatter {
namespace {

constexpr double wavelength = 0.03;
constexpr double frequency_hz = speed_of_light_mps / wavelength;
const Vec3f up{0.0F, 0.0F, 1.0F};

/// A perfectly conducting, all but smooth plate.
CookTorrance plate() {
  return {{{1.0, 0.0, 1e9, 0.0}, 1e-4}, frequency_hz};
}

double cross_section_m2(const CookTorrance& surface, double incidence_rad, double area_m2) {
  const Vec3f to_radar = Vec3d{std::sin(incidence_rad), 0.0, std::cos(incidence_rad)}.to<float>();
  const float brdf = surface.backscatter(to_radar, {up, static_cast<float>(1.0 / area_m2)}).vv;
  return 4.0 * pi * brdf * area_m2 * std::pow(std::cos(incidence_rad), 2);
}

TEST(FlatFace, PeaksLikeThePlateOfPhysicalOptics) {
  for (const double area_m2 : {0.02, 0.25, 1.0, 100.0}) {
    const double expected = 4.0 * pi * area_m2 * area_m2 / (wavelength * wavelength);
    validation::expect_close({.group = "Flat faces",
                              .name = fmt::format("peak of a plate, {} m², 3 cm", area_m2),
                              .expected = db_from_linear(expected),
                              .measured = db_from_linear(cross_section_m2(plate(), 0.0, area_m2)),
                              .tolerance = 0.1,
                              .unit = "dBsm",
                              .source = "physical optics, 4πA²/λ²"});
  }
}

// ∫ σ dΩ = π A |R|², over the angles to which the plate is turned.
TEST(FlatFace, ReturnsThePlatesPowerOverAllAngles) {
  for (const double area_m2 : {0.25, 1.0}) {
    double integral = 0.0;
    const double step = 1e-5;
    for (double theta = 0.5 * step; theta < 0.4; theta += step) {
      integral += cross_section_m2(plate(), theta, area_m2) * 2.0 * pi * std::sin(theta) * step;
    }
    validation::expect_close({.group = "Flat faces",
                              .name = fmt::format("angular integral of a plate, {} m²", area_m2),
                              .expected = pi * area_m2,
                              .measured = integral,
                              .tolerance = 0.01 * pi * area_m2,
                              .unit = "m² sr",
                              .source = "physical optics, πA"});
  }
}

// The diffuse part of a façade adds to the lobe as power, whatever the phases of single draws.
TEST(Facade, PartsAddAsPowers) {
  CookTorranceParameters parameters{{5.24, 0.0, 0.0462, 0.7822}, 0.3};
  parameters.scattering_coefficient = 0.6;
  parameters.depolarization = {0.2, 0.3};
  const CookTorrance facade(parameters, frequency_hz);
  const Vec3f to_radar = normalized(Vec3f{0.3F, 0.1F, 1.0F});
  const radar::Channels expected = facade.backscatter(to_radar, up);
  const PolarizationBasis basis(-to_radar);
  radar::Channels mean;
  constexpr int draws = 40'000;
  for (int i = 0; i < draws; ++i) {
    const PhaseDraw draw{unit_float(hashed(1, i)), unit_float(hashed(2, i))};
    const FieldPair out = facade.scatter({{basis.v, {}}, {basis.h, {}}}, to_radar, to_radar, up, draw);
    const Amplitude vv = out.from_v.along(basis.v), hh = out.from_h.along(basis.h);
    mean += radar::Channels{power_of(vv), power_of(hh), power_of(out.from_v.along(basis.h)), correlation_of(vv, hh)} *
            (1.0F / draws);
  }
  EXPECT_NEAR(mean.vv, expected.vv, 0.01F * expected.vv);
  EXPECT_NEAR(mean.hh, expected.hh, 0.01F * expected.hh);
  EXPECT_NEAR(mean.hv, expected.hv, 0.01F * expected.vv);
  EXPECT_NEAR(mean.re_vvhh, expected.re_vvhh, 0.01F * expected.vv);
  EXPECT_GT(expected.hv, 0.0F);
}

// Lobe and diffuse part together return what the mirrors alone would, no more.
TEST(Facade, StaysPassive) {
  for (const double s : {0.3, 0.7, 1.0}) {
    CookTorranceParameters parameters{{1.0, 0.0, 1e9, 0.0}, 0.1};
    parameters.scattering_coefficient = s;
    const CookTorrance facade(parameters, frequency_hz);
    const Vec3f to_source = normalized(Vec3f{1.0F, 0.0F, 1.0F});
    const PolarizationBasis basis(-to_source);
    double albedo = 0.0;
    constexpr int draws = 40'000;
    for (int i = 0; i < draws; ++i) {
      const auto next = facade.sample(to_source, up, {unit_float(hashed(3, i)), unit_float(hashed(4, i))});
      if (next.pdf <= 0.0F || next.direction.z <= 0.0F) continue;
      const FieldPair out = facade.scatter({{basis.v, {}}, {basis.h, {}}}, to_source, next.direction, up,
                                           {unit_float(hashed(5, i)), unit_float(hashed(6, i))});
      albedo += static_cast<double>(out.mean_power() * next.direction.z / next.pdf) / draws;
    }
    EXPECT_LE(albedo, 1.005) << "S = " << s;
    EXPECT_GE(albedo, 0.98) << "S = " << s;
  }
}

}  // namespace
}  // namespace sigmascape::scatter
