#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scatter/cmod5.h"
#include "sigmascape/scatter/git_sea.h"
#include "sigmascape/scatter/nrl_sea.h"
#include "sigmascape/scatter/surface_model.h"

namespace sigmascape::physics_test {
namespace {

struct SeaRow {
  double sea_state;
  double grazing_deg;
  double hh_db;
  double vv_db;
};

scatter::SurfaceModel sea_of(const scatter::Material::Model& parameters) {
  return {{.name = "sea", .model = parameters, .source = {}}, 10e9};
}

void expect_sea(const char* group, const scatter::SurfaceModel& sea, const SeaRow& row, const char* source) {
  const double psi = radians_from_deg(row.grazing_deg);
  const Vec3f to_radar = Vec3d{std::cos(psi), 0.0, std::sin(psi)}.to<float>();
  const radar::Channels brdf = sea.backscatter(to_radar, Vec3f{0.0F, 0.0F, 1.0F});
  const auto report = [&](const char* polarization, double expected_db, float value) {
    validation::expect_close(
        {.group = group,
         .name = fmt::format("10 GHz, sea state {}, grazing {}°, {}", row.sea_state, row.grazing_deg, polarization),
         .expected = expected_db,
         .measured = db_from_linear(4.0 * pi * static_cast<double>(value) * std::pow(std::sin(psi), 2)),
         .tolerance = 0.06,
         .unit = "dB",
         .source = source});
  };
  report("HH", row.hh_db, brdf.hh);
  report("VV", row.vv_db, brdf.vv);
}

TEST(Cmod5, BackscatterByWind) {
  struct Row {
    double wind_mps, incidence_deg, upwind_db, crosswind_db, downwind_db;
  };
  for (const Row& row : {Row{5, 30, -12.18, -14.28, -12.45}, Row{5, 40, -17.72, -20.99, -18.41},
                         Row{10, 30, -8.03, -11.62, -8.40}, Row{10, 40, -12.35, -17.53, -13.13}}) {
    const double expected_db[] = {row.upwind_db, row.crosswind_db, row.downwind_db};
    for (const int quarter : {0, 1, 2}) {
      validation::expect_close({.group = "CMOD5",
                                .name = fmt::format("wind {} m/s, {}° off it, incidence {}°, VV", row.wind_mps,
                                                    90 * quarter, row.incidence_deg),
                                .expected = expected_db[quarter],
                                .measured = db_from_linear(scatter::cmod5_sigma0(row.wind_mps, quarter * pi / 2.0,
                                                                                 radians_from_deg(row.incidence_deg))),
                                .tolerance = 0.006,
                                .unit = "dB",
                                .source = "coefficients of Hersbach 2003 evaluated independently"});
    }
  }
}

TEST(NrlSea, BackscatterAtTenGigahertz) {
  for (const SeaRow& row : {SeaRow{3, 1, -43.3, -41.2}, SeaRow{3, 10, -37.6, -32.5}, SeaRow{3, 30, -31.4, -26.0},
                            SeaRow{3, 60, -15.7, -17.4}, SeaRow{5, 1, -34.8, -34.0}, SeaRow{1, 10, -46.0, -39.6}}) {
    expect_sea("NRL sea", sea_of(scatter::NrlSeaParameters{.sea_state = row.sea_state}), row,
               "coefficients of NRL_SigmaSea.m evaluated independently");
  }
}

TEST(NrlSea, GammaIsConstantAboveTheFit) {
  const scatter::NrlSeaParameters sea{.sea_state = 4.0};
  const auto gamma = [&](double grazing_deg) {
    const double psi = radians_from_deg(grazing_deg);
    return scatter::nrl_sea_sigma0(sea, 10e9, psi).vv / std::sin(psi);
  };
  EXPECT_NEAR(gamma(75.0) / gamma(60.0), 1.0, 1e-9);
  EXPECT_NEAR(gamma(90.0) / gamma(60.0), 1.0, 1e-9);
  EXPECT_GT(std::abs(gamma(59.0) / gamma(60.0) - 1.0), 0.01);
}

TEST(GitSea, BackscatterUpwindAtTenGigahertz) {
  const scatter::GitSeaParameters parameters{.sea_state = 3.0, .wind_angle_rad = 0.0, .wind_speed_mps = 8.5};
  for (const SeaRow& row : {SeaRow{3, 1, -34.6, -33.5}, SeaRow{3, 10, -31.8, -27.8}}) {
    expect_sea("GIT sea", sea_of(parameters), row, "Horst, Dyer and Tuley 1978 evaluated independently, wind 8.5 m/s");
  }
}

// exp(0.2 (1 − 2.8 ψ) (λ + 0.015)^−0.4) between upwind and across, its inverse towards downwind.
TEST(GitSea, UpwindIsBrighterThanDownwind) {
  const double psi = radians_from_deg(3.0);
  const auto sigma0 = [&](double angle) {
    return scatter::git_sea_sigma0({.sea_state = 3.0, .wind_angle_rad = angle}, 10e9, psi).hh;
  };
  const double ratio = std::exp(0.2 * (1.0 - 2.8 * psi) * std::pow(wavelength_m(10e9) + 0.015, -0.4));
  EXPECT_NEAR(sigma0(0.0) / sigma0(pi / 2.0), ratio, 1e-9);
  EXPECT_NEAR(sigma0(pi / 2.0) / sigma0(pi), ratio, 1e-9);
}

// Without a stated wind the sea is fully risen: 3.16 S^0.8 m/s.
TEST(GitSea, RisenSeaHasItsWind) {
  const double psi = radians_from_deg(3.0);
  const double wind = 3.16 * std::pow(4.0, 0.8);
  EXPECT_NEAR(scatter::git_sea_sigma0({.sea_state = 4.0}, 5e9, psi).vv,
              scatter::git_sea_sigma0({.sea_state = 4.0, .wind_speed_mps = wind}, 5e9, psi).vv, 1e-12);
}

}  // namespace
}  // namespace sigmascape::physics_test
