#include "sigmascape/scatter/reciprocal_backscatter.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "directions.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/sobol.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/billingsley.h"
#include "sigmascape/scatter/constant_gamma.h"
#include "sigmascape/scatter/git_sea.h"
#include "sigmascape/scatter/nrl_sea.h"
#include "sigmascape/scatter/ulaby_dobson.h"

namespace sigmascape::scatter {
namespace {

struct NamedSurface {
  std::string name;
  ReciprocalBackscatter surface;
};

/// Every table at every band that it serves, and the seas over their range.
std::vector<NamedSurface> surfaces() {
  std::vector<NamedSurface> made;
  for (const auto terrain :
       {TerrainClass::Soil, TerrainClass::Grass, TerrainClass::Shrubs, TerrainClass::ShortVegetation,
        TerrainClass::DrySnow, TerrainClass::WetSnow, TerrainClass::Trees}) {
    const UlabyDobsonParameters parameters{.terrain = terrain, .unverified_rows = true, .depolarization = {}};
    for (const FrequencyRange& band : ulaby_dobson_bands(parameters)) {
      const double frequency_hz = 0.5 * (band.lowest_hz + band.highest_hz);
      made.push_back({fmt::format("Ulaby–Dobson class {}, {} GHz", static_cast<int>(terrain), frequency_hz / 1e9),
                      ulaby_dobson(parameters, frequency_hz)});
    }
  }
  for (const auto terrain : {BillingsleyTerrain::GeneralRural, BillingsleyTerrain::Forest, BillingsleyTerrain::Desert})
    made.push_back({fmt::format("Billingsley terrain {}", static_cast<int>(terrain)),
                    billingsley({.terrain = terrain, .depolarization = {}})});
  for (const double state : {0.0, 3.0, 6.0}) {
    for (const double frequency_hz : {0.5e9, 10e9, 35e9})
      made.push_back({fmt::format("NRL sea state {}, {} GHz", state, frequency_hz / 1e9),
                      nrl_sea({.sea_state = state}, frequency_hz)});
    for (const double frequency_hz : {1e9, 10e9})
      made.push_back({fmt::format("GIT sea state {}, {} GHz", std::max(1.0, state), frequency_hz / 1e9),
                      git_sea({.sea_state = std::max(1.0, state), .wind_angle_rad = 0.0}, frequency_hz)});
  }
  return made;
}

struct ReturnedPower {
  double from_v = 0.0;
  double from_h = 0.0;
};

ReturnedPower returned_power(const ReciprocalBackscatter& surface, double incidence_deg) {
  constexpr std::uint32_t points = 1U << 13U;
  const Vec3f to_source = direction(incidence_deg, 200.0);
  const PolarizationBasis basis(-to_source);
  ReturnedPower sum;
  for (std::uint32_t i = 0; i < points; ++i) {
    const SobolPoint point(11, i);
    const DirectionSample drawn = surface.sample(to_source, up, point.pair(0));
    const Vec2f phases = point.pair(1);
    const FieldPair out =
        surface.scatter({{basis.v, {}}, {basis.h, {}}}, to_source, drawn.direction, up, {phases.x, phases.y});
    const double weight = static_cast<double>(drawn.direction.z / drawn.pdf) / points;
    sum.from_v += static_cast<double>(out.from_v.power()) * weight;
    sum.from_h += static_cast<double>(out.from_h.power()) * weight;
  }
  return sum;
}

// The furnace: for either transmit polarization, no more leaves in both receive polarizations than arrives.
TEST(ReciprocalBackscatter, IsPassiveForEveryTable) {
  for (const NamedSurface& named : surfaces()) {
    for (const double incidence_deg : {0.0, 1.0, 5.0, 10.0, 20.0, 40.0, 60.0, 75.0, 85.0}) {
      const ReturnedPower power = returned_power(named.surface, incidence_deg);
      EXPECT_LE(std::max(power.from_v, power.from_h), 1.0) << named.name << " at " << incidence_deg << "°";
      const double albedo = named.surface.albedo(std::cos(radians_from_deg(incidence_deg)));
      EXPECT_NEAR(std::max(power.from_v, power.from_h), albedo, 0.01 * albedo + 1e-9)
          << named.name << " at " << incidence_deg << "°";
    }
  }
}

TEST(ReciprocalBackscatter, MatrixOfTheWayBackIsTheTranspose) {
  for (const NamedSurface& named : surfaces()) {
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto angle = [&](std::uint64_t key, double range) {
        return range * static_cast<double>(unit_float(hashed(i, key)));
      };
      const Vec3f a = direction(angle(1, 89.0), angle(2, 360.0));
      const Vec3f b = direction(angle(3, 89.0), angle(4, 360.0));
      const PhaseDraw draw{unit_float(hashed(i, 5)), unit_float(hashed(i, 6))};
      const PolarizationBasis sent_a(-a), sent_b(-b);
      const FieldPair there = named.surface.scatter({{sent_a.v, {}}, {sent_a.h, {}}}, a, b, up, draw);
      const FieldPair back = named.surface.scatter({{sent_b.v, {}}, {sent_b.h, {}}}, b, a, up, draw);
      const auto expect_same = [&](Amplitude x, Amplitude y) {
        const float scale = std::sqrt(there.mean_power());
        EXPECT_NEAR(x.re, y.re, 1e-6F * scale) << named.name;
        EXPECT_NEAR(x.im, y.im, 1e-6F * scale) << named.name;
      };
      expect_same(there.from_v.along(sent_b.v), back.from_v.along(sent_a.v));
      expect_same(there.from_h.along(sent_b.h), back.from_h.along(sent_a.h));
      expect_same(there.from_v.along(sent_b.h), back.from_h.along(sent_a.v));
      expect_same(there.from_h.along(sent_b.v), back.from_v.along(sent_a.h));
    }
  }
}

// What a path carries into the direction that it came from is what the radar is told.
TEST(ReciprocalBackscatter, ScatteringTowardsTheSourceIsBackscatter) {
  for (const NamedSurface& named : surfaces()) {
    for (const double incidence_deg : {0.5, 30.0, 59.9, 60.1, 85.0}) {
      const Vec3f w = direction(incidence_deg, 70.0);
      const PolarizationBasis sent(-w);
      const FieldPair out = named.surface.scatter({{sent.v, {}}, {sent.h, {}}}, w, w, up, {0.3F, 0.4F});
      const radar::Channels channels = named.surface.backscatter(w, up);
      EXPECT_NEAR(power_of(out.from_v.along(sent.v)) / channels.vv, 1.0F, 1e-5F) << named.name;
      EXPECT_NEAR(power_of(out.from_h.along(sent.h)) / channels.hh, 1.0F, 1e-5F) << named.name;
      EXPECT_NEAR(power_of(out.from_v.along(sent.h)) / channels.hv, 1.0F, 1e-5F) << named.name;
    }
  }
}

TEST(ReciprocalBackscatter, ConstantGammaIsLommelSeeliger) {
  constexpr double gamma = 0.05;
  const ReciprocalBackscatter table([](double mu) { return Sigma0{gamma * mu, gamma * mu, 0.1 * gamma * mu}; }, {});
  const ConstantGamma closed({gamma, {0.1, 0.5}}, 10e9);
  for (const double from_deg : {0.0, 20.0, 65.0, 88.0}) {
    for (const double to_deg : {3.0, 45.0, 80.0}) {
      const Vec3f a = direction(from_deg, 10.0);
      const Vec3f b = direction(to_deg, 130.0);
      const PolarizationBasis sent(-a);
      const FieldPair in{{sent.v, {}}, {sent.h, {}}};
      EXPECT_NEAR(table.scatter(in, a, b, up, {0.1F, 0.6F}).mean_power() /
                      closed.scatter(in, a, b, up, {0.1F, 0.6F}).mean_power(),
                  1.0F, 1e-4F)
          << from_deg << "° to " << to_deg << "°";
    }
    const double mu = std::cos(radians_from_deg(from_deg));
    EXPECT_NEAR(table.albedo(mu), 1.1 * constant_gamma_albedo(gamma, mu), 1e-4 * gamma) << from_deg << "°";
  }
}

}  // namespace
}  // namespace sigmascape::scatter
