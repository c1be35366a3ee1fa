#include "sigmascape/scatter/ulaby_dobson.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "keep_worst.h"
#include "physics/ulaby_dobson_curves.h"
#include "validation/validation_record.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/surface_model.h"
#include "sigmascape/scatter/ulaby_dobson_table.h"

namespace sigmascape::physics_test {
namespace {

double seen_sigma0_db(const scatter::SurfaceModel& model, Channel channel, double incidence_deg) {
  const double theta = radians_from_deg(incidence_deg);
  const Vec3f to_radar = Vec3d{std::sin(theta), 0.0, std::cos(theta)}.to<float>();
  const radar::Channels brdf = model.backscatter(to_radar, Vec3f{0.0F, 0.0F, 1.0F});
  const float value = channel == Channel::HH ? brdf.hh : channel == Channel::VV ? brdf.vv : brdf.hv;
  return db_from_linear(4.0 * pi * static_cast<double>(value) * std::pow(std::cos(theta), 2));
}

/// The worst of the angles of a curve from the row's first to `last_deg`.
template <typename Sigma0Db>
double worst_error_db(const Curve& curve, double last_deg, Sigma0Db sigma0_db) {
  double worst = 0.0;
  for (std::size_t i = 0; i < incidences_deg.size(); ++i) {
    if (incidences_deg[i] < row_of(curve).least_incidence_deg || incidences_deg[i] > last_deg) continue;
    const double error = sigma0_db(incidences_deg[i]) - curve.sigma0_db[i];
    keep_worst(worst, error);
  }
  return worst;
}

std::string angles_of(const Curve& curve, double last_deg) {
  return fmt::format("worst error of {} to {}° of incidence", std::max(10.0, row_of(curve).least_incidence_deg),
                     last_deg);
}

void expect_fit(const Curve& curve, const char* source) {
  const double last_deg = incidences_deg.back();
  const double worst = worst_error_db(
      curve, last_deg, [&](double incidence_deg) { return row_of(curve).sigma0_db(radians_from_deg(incidence_deg)); });
  validation::expect_close({.group = "Ulaby–Dobson",
                            .name = name_of(curve) + ", fit, " + angles_of(curve, last_deg),
                            .expected = 0.0,
                            .measured = worst,
                            .tolerance = 0.01,
                            .unit = "dB",
                            .source = source});
}

void expect_backscatter(const Curve& curve, bool unverified_rows, const char* source) {
  const scatter::Material material{
      .name = "land",
      .model = scatter::UlabyDobsonParameters{.terrain = curve.terrain, .unverified_rows = unverified_rows},
      .source = {}};
  const scatter::SurfaceModel model(material, frequency_in(curve.band));
  const double last_deg = row_of(curve).greatest_incidence_deg;
  const double worst = worst_error_db(
      curve, last_deg, [&](double incidence_deg) { return seen_sigma0_db(model, curve.channel, incidence_deg); });
  validation::expect_close({.group = "Ulaby–Dobson",
                            .name = name_of(curve) + ", backscatter, " + angles_of(curve, last_deg),
                            .expected = 0.0,
                            .measured = worst,
                            .tolerance = 0.05,
                            .unit = "dB",
                            .source = source});
}

TEST(UlabyDobson, FitsOfAllVerifiedRows) {
  for (const Curve& curve : curves) {
    EXPECT_TRUE(row_of(curve).verified) << name_of(curve);
    expect_fit(curve, ulaby_dobson_source);
  }
}

TEST(UlabyDobson, BackscatterOfAllVerifiedRows) {
  for (const Curve& curve : curves) expect_backscatter(curve, false, ulaby_dobson_source);
}

TEST(UlabyDobson, FitsOfAllUnverifiedRows) {
  for (const Curve& curve : unverified_curves) {
    EXPECT_FALSE(row_of(curve).verified) << name_of(curve);
    expect_fit(curve, unverified_source);
  }
  EXPECT_EQ(std::size(curves) + std::size(unverified_curves), scatter::ulaby_dobson_table().size());
}

TEST(UlabyDobson, BackscatterOfAllUnverifiedRows) {
  for (const Curve& curve : unverified_curves) expect_backscatter(curve, true, unverified_source);
}

// The tables between their nodes, from the zenith to where the rows end.
TEST(UlabyDobson, TablesFollowTheFitsBetweenTheirNodes) {
  for (const Curve& curve : curves) {
    const scatter::Material material{
        .name = "land", .model = scatter::UlabyDobsonParameters{.terrain = curve.terrain}, .source = {}};
    const scatter::SurfaceModel model(material, frequency_in(curve.band));
    for (double incidence_deg = 0.0; incidence_deg < row_of(curve).greatest_incidence_deg; incidence_deg += 0.37) {
      EXPECT_NEAR(seen_sigma0_db(model, curve.channel, incidence_deg),
                  row_of(curve).sigma0_db(radians_from_deg(incidence_deg)), 0.02)
          << name_of(curve) << " at " << incidence_deg << "°";
    }
  }
}

// A fit's cosine turns soil at L band down to −75 dB at grazing; the continuation keeps γ instead.
TEST(UlabyDobson, GammaIsConstantBeyondTheRows) {
  for (const Curve& curve : curves) {
    const auto& row = row_of(curve);
    const double end_rad = radians_from_deg(row.greatest_incidence_deg);
    const double at_end = row.sigma0(end_rad) / std::cos(end_rad);
    for (const double incidence_deg : {60.1, 65.0, 70.1, 75.0, 80.0, 85.0, 89.0}) {
      if (incidence_deg < row.greatest_incidence_deg) continue;
      const double theta = radians_from_deg(incidence_deg);
      EXPECT_NEAR(db_from_linear(row.sigma0(theta) / std::cos(theta) / at_end), 0.0, 1e-9) << name_of(curve);
    }
  }
}

/// Calls body(parameters, band) for every class and band that has rows of its own for all three channels.
template <typename Body>
void for_each_full_band(const Body& body) {
  for (const scatter::UlabyDobsonRow& row : scatter::ulaby_dobson_table()) {
    if (row.channel != Channel::HV) continue;
    body(scatter::UlabyDobsonParameters{.terrain = row.terrain, .unverified_rows = !row.verified}, row.band);
  }
}

TEST(UlabyDobson, CrossPolarizationLiesBelowBothCoPolarizationsAtEveryAngle) {
  for_each_full_band([](const scatter::UlabyDobsonParameters& land, Band band) {
    for (double grazing_deg = 0.1; grazing_deg <= 90.0; grazing_deg += 0.1) {
      const auto sigma0 = scatter::ulaby_dobson_sigma0(land, frequency_in(band), radians_from_deg(90.0 - grazing_deg));
      ASSERT_LT(sigma0.hv, std::min(sigma0.vv, sigma0.hh))
          << "class " << static_cast<int>(land.terrain) << " at " << frequency_in(band) / 1e9 << " GHz, " << grazing_deg
          << "° of grazing";
    }
  });
}

// The rule of docs/physics/ulaby_dobson.md: 70°, and 60° where the fits contradict one another before.
TEST(UlabyDobson, RowsEndBeforeTheFitsCross) {
  for_each_full_band([](const scatter::UlabyDobsonParameters& land, Band band) {
    const auto row = [&](Channel channel) {
      return row_of({.terrain = land.terrain, .band = band, .channel = channel, .sigma0_db = {}});
    };
    const auto vv = row(Channel::VV), hh = row(Channel::HH), hv = row(Channel::HV);
    bool cross = false;
    for (double incidence_deg = hv.least_incidence_deg; incidence_deg <= 70.0; incidence_deg += 0.1) {
      const double theta = radians_from_deg(incidence_deg);
      cross = cross || hv.sigma0_db(theta) >= std::min(vv.sigma0_db(theta), hh.sigma0_db(theta));
    }
    for (const auto& one : {vv, hh, hv}) EXPECT_EQ(one.greatest_incidence_deg, cross ? 60.0 : 70.0);
  });
}

// Cross-polarization is a table of its own: grass at C band and 40° loses 5.3 dB against HH and 6.5 dB against VV.
TEST(UlabyDobson, PolarizationsDiffer) {
  const auto sigma0 = scatter::ulaby_dobson_sigma0({.terrain = Class::Grass}, 5.405e9, radians_from_deg(40.0));
  EXPECT_NEAR(db_from_linear(sigma0.hv / sigma0.hh), -19.123 + 13.819, 0.002);
  EXPECT_NEAR(db_from_linear(sigma0.hv / sigma0.vv), -19.123 + 12.609, 0.002);
}

TEST(UlabyDobson, VerifiedShrubsHaveNoRowAtSBand) {
  EXPECT_THROW((void)scatter::ulaby_dobson_sigma0({.terrain = Class::Shrubs}, 3e9, 0.5), Error);
  const double hh = scatter::ulaby_dobson_sigma0({.terrain = Class::Shrubs, .unverified_rows = true}, 3e9, 0.5).hh;
  // The corrupt row of the public source gives +41 dB and more.
  EXPECT_LT(db_from_linear(hh), -5.0);
}

TEST(UlabyDobson, UnverifiedRowsMustBeAskedFor) {
  for (const Class terrain : {Class::Soil, Class::Grass, Class::ShortVegetation, Class::DrySnow, Class::WetSnow}) {
    EXPECT_THROW((void)scatter::ulaby_dobson_sigma0({.terrain = terrain}, 10e9, 0.5), Error);
    EXPECT_NO_THROW((void)scatter::ulaby_dobson_sigma0({.terrain = terrain, .unverified_rows = true}, 10e9, 0.5));
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
