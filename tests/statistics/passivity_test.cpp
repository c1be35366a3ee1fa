#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "directions.h"
#include "keep_worst.h"
#include "statistics/every_material.h"
#include "validation/validation_record.h"

#include "sigmascape/base/sobol.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/cook_torrance.h"
#include "sigmascape/scatter/surface_model.h"

namespace sigmascape::statistics_test {
namespace {

constexpr scatter::Permittivity perfect_conductor{1.0, 0.0, 1e9, 0.0};
constexpr double incidences_deg[] = {0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0};

struct ReturnedPower {
  double from_v = 0.0;
  double from_h = 0.0;
};

/// Power that leaves over power that arrives for either transmit polarization, summed over receive polarizations: the
/// mean of |S|² cos θo / pdf over drawn directions.
template <typename Model>
ReturnedPower returned_power(const Model& model, Vec3f to_source, std::uint32_t points) {
  const scatter::PolarizationBasis basis(-to_source);
  const scatter::FieldPair in{{basis.v, {}}, {basis.h, {}}};
  ReturnedPower sum;
  for (std::uint32_t i = 0; i < points; ++i) {
    const SobolPoint point(11, i);
    const scatter::DirectionSample drawn = model.sample(to_source, up, point.pair(0));
    if (drawn.pdf <= 0.0F) continue;
    const Vec2f phases = point.pair(1);
    const scatter::FieldPair out = model.scatter(in, to_source, drawn.direction, up, {phases.x, phases.y});
    const double weight = static_cast<double>(drawn.direction.z) / static_cast<double>(drawn.pdf) / points;
    sum.from_v += static_cast<double>(out.from_v.power()) * weight;
    sum.from_h += static_cast<double>(out.from_h.power()) * weight;
  }
  return sum;
}

TEST(Passivity, EveryMaterial) {
  for (const scatter::Material& material : every_material()) {
    const scatter::SurfaceModel model(material, frequency_within(material));
    double greatest = 0.0;
    for (const double incidence_deg : incidences_deg) {
      const ReturnedPower power = returned_power(model, direction(incidence_deg, 200.0), 1U << 14U);
      for (const double returned : {power.from_v, power.from_h}) keep_worst(greatest, returned);
      EXPECT_GT(power.from_v, 0.0) << material.name << " at " << incidence_deg << "°";
      EXPECT_GT(power.from_h, 0.0) << material.name << " at " << incidence_deg << "°";
    }
    for (const double frequency_hz : ends_of_frequencies(material)) {
      const scatter::SurfaceModel at_end(material, frequency_hz);
      for (const double incidence_deg : {0.0, 40.0, 70.0, 85.0}) {
        const ReturnedPower power = returned_power(at_end, direction(incidence_deg, 200.0), 1U << 13U);
        for (const double returned : {power.from_v, power.from_h}) keep_worst(greatest, returned);
      }
    }
    validation::expect_close(
        {.group = "Passivity",
         .name = fmt::format("{}, excess of returned power (greatest return {:.4f}, all bands, 0–85°)", material.name,
                             greatest),
         .expected = 0.0,
         .measured = greatest <= 1.0 ? 0.0 : greatest - 1.0,
         .tolerance = 1e-3,
         .unit = "1",
         .source = "conservation of energy"});
  }
}

// A conductor with facets so flat that they neither hide nor light one another returns everything.
TEST(Passivity, SmoothConductorReturnsEverything) {
  const scatter::SurfaceModel model(scatter::library_material("ideal_conductor"), 10e9);
  for (const double incidence_deg : incidences_deg) {
    const ReturnedPower power = returned_power(model, direction(incidence_deg, 200.0), 1U << 14U);
    validation::expect_close({.group = "Passivity",
                              .name = fmt::format("ideal_conductor, incidence {}°, mean returned power", incidence_deg),
                              .expected = 1.0,
                              .measured = 0.5 * (power.from_v + power.from_h),
                              .tolerance = 2e-3,
                              .unit = "1",
                              .source = "conservation of energy"});
  }
}

// With what facets pass on to one another given back, a rough conductor returns everything too.
TEST(Passivity, RoughConductorWithMultipleScatterReturnsEverything) {
  using scatter::MicrofacetDistribution;
  for (const auto distribution : {MicrofacetDistribution::Beckmann, MicrofacetDistribution::Ggx}) {
    for (const double alpha : {0.1, 0.3, 0.6, 1.0}) {
      const scatter::CookTorrance single({perfect_conductor, alpha, distribution}, 10e9);
      const scatter::CookTorrance full({perfect_conductor, alpha, distribution}, 10e9, {.multiple_scatter = true});
      for (const double incidence_deg : {0.0, 30.0, 60.0, 80.0, 85.0}) {
        const Vec3f to_source = direction(incidence_deg, 200.0);
        const ReturnedPower power = returned_power(full, to_source, 1U << 16U);
        validation::expect_close(
            {.group = "Passivity",
             .name = fmt::format("rough conductor with multiple scatter, {} α {}, incidence {}°",
                                 distribution == MicrofacetDistribution::Beckmann ? "Beckmann" : "GGX", alpha,
                                 incidence_deg),
             .expected = 1.0,
             .measured = 0.5 * (power.from_v + power.from_h),
             .tolerance = 5e-3,
             .unit = "1",
             .source = "conservation of energy"});
        const ReturnedPower without = returned_power(single, to_source, 1U << 14U);
        EXPECT_LT(without.from_v + without.from_h, power.from_v + power.from_h + 1e-3);
      }
    }
  }
}

// The diffuse part of walls that are not flat, whose co-polarized elements are correlated, adds to the rest as power.
TEST(Passivity, RoughConductorThatScattersToo) {
  for (const double correlation : {0.0, 0.5, 1.0}) {
    for (const double scattering_coefficient : {0.4, 0.7}) {
      const scatter::CookTorrance wall({.permittivity = perfect_conductor,
                                        .alpha = 1.0,
                                        .distribution = scatter::MicrofacetDistribution::Ggx,
                                        .scattering_coefficient = scattering_coefficient,
                                        .depolarization = {0.1, correlation},
                                        .multiple_scatter = true},
                                       10e9);
      for (const double incidence_deg : {0.0, 45.0}) {
        const ReturnedPower power = returned_power(wall, direction(incidence_deg, 200.0), 1U << 16U);
        for (const auto& [polarization, returned] : {std::pair{'V', power.from_v}, {'H', power.from_h}}) {
          validation::expect_close(
              {.group = "Passivity",
               .name = fmt::format("rough conductor with multiple scatter and S = {}, ρ = {}, incidence {}°, from {}",
                                   scattering_coefficient, correlation, incidence_deg, polarization),
               .expected = 1.0,
               .measured = returned,
               .tolerance = 5e-3,
               .unit = "1",
               .source = "conservation of energy"});
        }
      }
    }
  }
}

// Real materials absorb at each of the many reflections, so that the term must not give back all that masking takes.
TEST(Passivity, RoughDielectricWithMultipleScatterStaysPassive) {
  const scatter::CookTorranceParameters concrete{
      {5.24, 0.0, 0.0462, 0.7822}, 1.0, scatter::MicrofacetDistribution::Ggx};
  const scatter::CookTorrance single(concrete, 10e9);
  const scatter::CookTorrance full(concrete, 10e9, {.multiple_scatter = true});
  for (const double incidence_deg : incidences_deg) {
    const Vec3f to_source = direction(incidence_deg, 200.0);
    const ReturnedPower with = returned_power(full, to_source, 1U << 14U);
    const ReturnedPower without = returned_power(single, to_source, 1U << 14U);
    EXPECT_GT(with.from_v, without.from_v) << incidence_deg << "°";
    EXPECT_LT(with.from_v, 0.35) << incidence_deg << "°";
    EXPECT_LT(with.from_h, 0.75) << incidence_deg << "°";
  }
}

}  // namespace
}  // namespace sigmascape::statistics_test
