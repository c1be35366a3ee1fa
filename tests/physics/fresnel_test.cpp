#include "sigmascape/scatter/fresnel.h"

#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scatter/permittivity.h"

namespace sigmascape::physics_test {
namespace {

using Complex = std::complex<double>;
using scatter::Permittivity;

scatter::FresnelCoefficients fresnel_of(Complex permittivity, double cos_incidence) {
  return scatter::fresnel({static_cast<float>(permittivity.real()), static_cast<float>(permittivity.imag())},
                          static_cast<float>(cos_incidence));
}

double fresnel_reflectivity(Complex permittivity) {
  return power_of(fresnel_of(permittivity, 1.0).s);
}

TEST(Fresnel, NormalReflectivityOfMaterialsAtTenGigahertz) {
  const struct {
    const char* name;
    Permittivity permittivity;
    double expected_db;
    double tolerance_db;
  } rows[] = {
      {"concrete", {5.24, 0.0, 0.0462, 0.7822}, -8.10, 0.005},  {"brick", {3.91, 0.0, 0.0238, 0.16}, -9.67, 0.005},
      {"wood", {1.99, 0.0, 0.0047, 1.0718}, -15.33, 0.005},     {"glass", {6.31, 0.0, 0.0036, 1.3394}, -7.32, 0.005},
      {"paper's building", {1e5, 0.0, 1e5, 0.0}, -0.03, 0.005}, {"paper's leaf", {50.0, 0.0, 1e2, 0.0}, -1.01, 0.005},
      {"paper's bark", {200.0, 0.0, 5e-3, 0.0}, -1.23, 0.005},
  };
  for (const auto& row : rows) {
    validation::expect_close(
        {.group = "Fresnel",
         .name = fmt::format("reflectivity at normal incidence, {}, 10 GHz", row.name),
         .expected = row.expected_db,
         .measured = db_from_linear(fresnel_reflectivity(row.permittivity.relative_at(10e9))),
         .tolerance = row.tolerance_db,
         .unit = "dB",
         .source = "|(1 − √ε)/(1 + √ε)|² in double precision; constants ITU-R P.2040-3 and Visina et al."});
  }
}

TEST(Fresnel, BrewsterAngle) {
  for (const double permittivity : {2.0, 2.25, 5.24, 80.0}) {
    // tan θ_B = √ε, hence cos θ_B = 1/√(1 + ε) and |r_s| = (ε − 1)/(ε + 1).
    const auto r = fresnel_of(permittivity, 1.0 / std::sqrt(1.0 + permittivity));
    validation::expect_close({.group = "Fresnel",
                              .name = fmt::format("|r_p|² at the Brewster angle, ε = {}", permittivity),
                              .expected = 0.0,
                              .measured = power_of(r.p),
                              .tolerance = 1e-12,
                              .unit = "1",
                              .source = "closed form"});
    validation::expect_close({.group = "Fresnel",
                              .name = fmt::format("|r_s|² at the Brewster angle, ε = {}", permittivity),
                              .expected = std::pow((permittivity - 1.0) / (permittivity + 1.0), 2),
                              .measured = power_of(r.s),
                              .tolerance = 1e-6,
                              .unit = "1",
                              .source = "closed form ((ε − 1)/(ε + 1))²"});
  }
  validation::expect_close({.group = "Fresnel",
                            .name = "unpolarized Mueller element at the Brewster angle, refractive index 1.5",
                            .expected = 0.0739645,
                            .measured = 0.5 * power_of(fresnel_of(2.25, 1.0 / std::sqrt(3.25)).s),
                            .tolerance = 1e-6,
                            .unit = "1",
                            .source = "Mitsuba 3, test_mueller.py"});
}

TEST(Fresnel, IdealConductorReversesSAndKeepsP) {
  const Complex conductor = Permittivity{1.0, 0.0, 1e9, 0.0}.relative_at(10e9);
  for (const double incidence_deg : {0.0, 30.0, 60.0, 80.0}) {
    const auto r = fresnel_of(conductor, std::cos(radians_from_deg(incidence_deg)));
    const auto report = [&](const char* name, double expected, double measured) {
      validation::expect_close({.group = "Fresnel",
                                .name = fmt::format("ideal conductor, {}, incidence {}°", name, incidence_deg),
                                .expected = expected,
                                .measured = measured,
                                .tolerance = 5e-4,
                                .unit = "1",
                                .source = "r_s = −1, r_p = +1"});
    };
    report("Re r_s", -1.0, r.s.re);
    report("Im r_s", 0.0, r.s.im);
    report("Re r_p", 1.0, r.p.re);
    report("Im r_p", 0.0, r.p.im);
  }
}

/// The mean over the hemisphere and both polarizations for a dielectric of refractive index n, in closed form [Duntley
/// 1942].
double duntley(double n) {
  const double n2 = n * n;
  const double n4 = n2 * n2;
  return 0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * std::pow(n + 1.0, 2)) +
         n2 * std::pow(n2 - 1.0, 2) / std::pow(n2 + 1.0, 3) * std::log((n - 1.0) / (n + 1.0)) -
         2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0)) +
         8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * std::pow(n4 - 1.0, 2)) * std::log(n);
}

TEST(Fresnel, MeanReflectivityOfDielectrics) {
  for (const double index : {1.2, 1.5, 2.3, 3.0}) {
    validation::expect_close({.group = "Fresnel",
                              .name = fmt::format("mean reflectivity F_avg, refractive index {}", index),
                              .expected = duntley(index),
                              .measured = scatter::mean_reflectivity({static_cast<float>(index * index), 0.0F}),
                              .tolerance = 2e-5,
                              .unit = "1",
                              .source = "closed form, Duntley 1942"});
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
