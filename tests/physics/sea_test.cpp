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

void expect_sea(const char* group, const scatter::Material::Model& parameters, double f_ghz, const SeaRow& row,
                const char* source) {
  const scatter::SurfaceModel sea({.name = "sea", .model = parameters, .source = {}}, f_ghz * 1e9);
  const double psi = radians_from_deg(row.grazing_deg);
  const Vec3f to_radar = Vec3d{std::cos(psi), 0.0, std::sin(psi)}.to<float>();
  const radar::Channels brdf = sea.backscatter(to_radar, Vec3f{0.0F, 0.0F, 1.0F});
  const auto report = [&](const char* polarization, double expected_db, float value) {
    validation::expect_close(
        {.group = group,
         .name =
             fmt::format("{} GHz, sea state {}, grazing {}°, {}", f_ghz, row.sea_state, row.grazing_deg, polarization),
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
    expect_sea("NRL sea", scatter::NrlSeaParameters{.sea_state = row.sea_state}, 10.0, row,
               "coefficients of NRL_SigmaSea.m evaluated independently");
  }
}

TEST(NrlSea, BackscatterAtOtherFrequencies) {
  struct Row {
    double f_ghz;
    SeaRow at;
  };
  for (const Row& row :
       {Row{1.3, {3, 1, -59.10, -54.01}}, Row{1.3, {3, 10, -46.12, -35.38}}, Row{3.0, {3, 1, -52.61, -48.75}},
        Row{3.0, {3, 10, -42.63, -34.18}}, Row{35.0, {3, 1, -33.54, -33.32}}, Row{35.0, {3, 10, -32.36, -30.67}}}) {
    expect_sea("NRL sea", scatter::NrlSeaParameters{.sea_state = 3.0}, row.f_ghz, row.at,
               "coefficients of NRL_SigmaSea.m evaluated independently");
  }
}

// −20 dB of √(σ0_VV σ0_HH) unless stated, of each model's own VV and HH.
TEST(Sea, CrossPolarizationIsThatOfTheMean) {
  const double psi = radians_from_deg(10.0);
  const auto expect_hv_db = [](const char* group, double expected_db, double hv) {
    validation::expect_close({.group = group,
                              .name = "10 GHz, sea state 3, grazing 10°, HV",
                              .expected = expected_db,
                              .measured = db_from_linear(hv),
                              .tolerance = 0.02,
                              .unit = "dB",
                              .source = "−20 dB + (σ0_HH + σ0_VV)/2 in dB"});
  };
  expect_hv_db("NRL sea", -20.0 + (-37.60 - 32.46) / 2.0, scatter::nrl_sea_sigma0({.sea_state = 3.0}, 10e9, psi).hv);
  const scatter::GitSeaParameters upwind{.sea_state = 3.0, .wind_angle_rad = 0.0, .wind_speed_mps = 8.5};
  expect_hv_db("GIT sea", -20.0 + (-31.78 - 27.77) / 2.0, scatter::git_sea_sigma0(upwind, 10e9, psi).hv);
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
    expect_sea("GIT sea", parameters, 10.0, row, "Horst, Dyer and Tuley 1978 evaluated independently, wind 8.5 m/s");
  }
}

// Below 3 GHz VV has another law; a risen sea across the wind has wind and waves of its state alone.
TEST(GitSea, BackscatterAtOtherFrequenciesAndStates) {
  const scatter::GitSeaParameters upwind{.sea_state = 3.0, .wind_angle_rad = 0.0, .wind_speed_mps = 8.5};
  for (const SeaRow& row : {SeaRow{3, 1, -52.78, -47.23}, SeaRow{3, 10, -41.24, -30.00}}) {
    expect_sea("GIT sea", upwind, 2.0, row, "Horst, Dyer and Tuley 1978 evaluated independently, wind 8.5 m/s");
  }
  expect_sea("GIT sea", scatter::GitSeaParameters{.sea_state = 5.0}, 5.0, {5, 1, -39.10, -38.28},
             "Horst, Dyer and Tuley 1978 evaluated independently, across the wind of a risen sea");
}

// The report states VV over HH in decibels, with coefficients rounded by themselves; of waves 0.08 S² = 0.722 m.
TEST(GitSea, VerticalOverHorizontalBelowThreeGigahertz) {
  const scatter::GitSeaParameters sea{.sea_state = 3.0};
  for (const double f_ghz : {1.3, 2.0, 2.99}) {
    for (const double grazing_deg : {1.0, 3.0, 10.0}) {
      const double psi = radians_from_deg(grazing_deg);
      const scatter::Sigma0 sigma0 = scatter::git_sea_sigma0(sea, f_ghz * 1e9, psi);
      validation::expect_close({.group = "GIT sea",
                                .name = fmt::format("{} GHz, sea state 3, grazing {}°, VV/HH", f_ghz, grazing_deg),
                                .expected = -1.73 * std::log(0.722 + 0.015) +
                                            3.76 * std::log(wavelength_m(f_ghz * 1e9)) + 2.46 * std::log(psi + 1e-4) +
                                            22.2,
                                .measured = db_from_linear(sigma0.vv / sigma0.hh),
                                .tolerance = 0.12,
                                .unit = "dB",
                                .source = "−1.73 ln(h + 0.015) + 3.76 ln λ + 2.46 ln(ψ + 10⁻⁴) + 22.2"});
    }
  }
}

// σ0 of 20° over that of 10°, where the model ends: sin 20°/sin 10°, 2.94 dB.
TEST(GitSea, GammaIsConstantAboveTheModel) {
  const scatter::GitSeaParameters sea{.sea_state = 3.0};
  const auto sigma0 = [&](double grazing_deg) {
    return scatter::git_sea_sigma0(sea, 10e9, radians_from_deg(grazing_deg));
  };
  EXPECT_NEAR(db_from_linear(sigma0(20.0).hh / sigma0(10.0).hh), 2.94, 0.005);
  EXPECT_NEAR(db_from_linear(sigma0(20.0).vv / sigma0(10.0).vv), 2.94, 0.005);
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
