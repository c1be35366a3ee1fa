#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/directions.h"
#include "validation/validation_record.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/sobol.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/surface_model.h"

namespace sigmascape::physics_test {
namespace {

/// Power that leaves over power that arrives in vertical polarization, by the surface's own samples.
double returned_power(const scatter::SurfaceModel& model, double incidence_deg) {
  constexpr std::uint32_t points = 1U << 16U;
  const Vec3f to_source = direction_at(radians_from_deg(incidence_deg));
  const scatter::PolarizationBasis basis(-to_source);
  double power = 0.0;
  for (std::uint32_t i = 0; i < points; ++i) {
    const SobolPoint point(3, i);
    const auto drawn = model.sample(to_source, up, point.pair(0));
    const Vec2f phases = point.pair(1);
    const auto out =
        model.scatter({{basis.v, {}}, {basis.h, {}}}, to_source, drawn.direction, up, {phases.x, phases.y});
    power += static_cast<double>(out.from_v.power()) * static_cast<double>(drawn.direction.z / drawn.pdf) / points;
  }
  return power;
}

TEST(ConstantGamma, DirectionalAlbedo) {
  struct Row {
    double gamma_db, incidence_deg, albedo, tolerance;
  };
  for (const Row& row : {Row{-15.0, 0.0, 0.0097, 5e-5}, Row{-15.0, 60.0, 0.0143, 5e-5}, Row{-5.0, 0.0, 0.097, 5e-4},
                         Row{-5.0, 60.0, 0.1425, 5e-5}}) {
    const scatter::ConstantGammaParameters parameters{linear_from_db(row.gamma_db), {0.0, 1.0}};
    const scatter::SurfaceModel model({.name = "land", .model = parameters, .source = {}}, 10e9);
    const auto report = [&](const char* how, double measured) {
      validation::expect_close(
          {.group = "Constant gamma",
           .name = fmt::format("albedo, γ {} dB, incidence {}°, {}", row.gamma_db, row.incidence_deg, how),
           .expected = row.albedo,
           .measured = measured,
           .tolerance = row.tolerance,
           .unit = "1",
           .source = "Lommel–Seeliger law integrated independently"});
    };
    report("closed form",
           scatter::constant_gamma_albedo(parameters.gamma, std::cos(radians_from_deg(row.incidence_deg))));
    report("paths", returned_power(model, row.incidence_deg));
  }
}

TEST(ConstantGamma, UrbanIsBartonsExample) {
  const scatter::SurfaceModel urban(scatter::library_material("urban"), 10e9);
  const double psi = radians_from_deg(20.0);
  const radar::Channels brdf = urban.backscatter(direction_at(radians_from_deg(70.0)), up);
  validation::expect_close(
      {.group = "Constant gamma",
       .name = "urban, σ0 at 20° of grazing",
       .expected = db_from_linear(0.1082),
       .measured = db_from_linear(4.0 * pi * static_cast<double>(brdf.vv) * std::pow(std::sin(psi), 2)),
       .tolerance = 0.01,
       .unit = "dB",
       .source = "MathWorks landreflectivity(\"Urban\", 20°, 10 GHz): γ = −5.00 dB"});
}

TEST(ConstantGamma, FrequencyLawIsOffUnlessNamed) {
  scatter::ConstantGammaParameters land{0.01, {}};
  EXPECT_EQ(scatter::gamma_at(land, 1e9), 0.01);
  land.frequency_law = scatter::GammaFrequencyLaw::SquareRootFrom10Ghz;
  EXPECT_NEAR(scatter::gamma_at(land, 10e9), 0.01, 1e-15);
  // 5 dB a decade.
  EXPECT_NEAR(db_from_linear(scatter::gamma_at(land, 1e9)), -25.0, 1e-9);
}

TEST(ConstantGamma, ThatCreatesPowerIsRefused) {
  const auto model = [](double gamma, double cross_ratio) {
    return scatter::SurfaceModel(
        {.name = "land", .model = scatter::ConstantGammaParameters{gamma, {cross_ratio, 0.5}}, .source = {}}, 10e9);
  };
  EXPECT_NO_THROW((void)model(0.9, 0.1));
  EXPECT_THROW((void)model(0.95, 0.1), Error);
}

}  // namespace
}  // namespace sigmascape::physics_test
