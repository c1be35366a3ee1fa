#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <variant>

#include "directions.h"
#include "statistics/chi_square.h"
#include "statistics/every_material.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scatter/cook_torrance.h"
#include "sigmascape/scatter/diffuse.h"
#include "sigmascape/scatter/surface_model.h"

namespace sigmascape::statistics_test {
namespace {

using scatter::MicrofacetDistribution;
using scatter::Microfacets;

constexpr double overall_significance = 0.01;

/// The least probable of several tests, which must still be likelier than Šidák's bound for so many.
class Battery {
 public:
  void add(const std::string& name, const SamplerVerdict& verdict) {
    ++tests_;
    // A few may lie in the sliver of a cell that the border of the density leaves and quadrature misses.
    EXPECT_LE(verdict.test.impossible, 20.0) << name << ": samples fell where the density is zero";
    EXPECT_LE(verdict.total_density, 1.0 + 2e-3) << name;
    if (verdict.test.probability < least_probability_) {
      least_probability_ = verdict.test.probability;
      least_ = fmt::format("{} (χ² {:.0f} of {:.0f} degrees of freedom)", name, verdict.test.statistic,
                           verdict.test.degrees_of_freedom);
    }
  }

  /// Reports 1 − p of the worst test: at most 1 − Šidák's significance.
  void conclude(const std::string& what) const {
    validation::expect_close({.group = "Samplers",
                              .name = fmt::format("{}, worst of {} χ² tests: {}", what, tests_, least_),
                              .expected = 0.0,
                              .measured = 1.0 - least_probability_,
                              .tolerance = 1.0 - sidak_significance(overall_significance, tests_),
                              .unit = "1 − p",
                              .source = "Pearson's χ², 1 % overall, Šidák"});
  }

 private:
  std::size_t tests_ = 0;
  double least_probability_ = 1.0;
  std::string least_;
};

TEST(ChiSquareTail, AgreesWithClosedForms) {
  // Two degrees: exp(−x/2); four: (1 + x/2) exp(−x/2); one: erfc(√(x/2)).
  for (const double x : {0.1, 1.0, 3.0, 10.0, 40.0}) {
    EXPECT_NEAR(chi_square_tail(x, 2.0), std::exp(-x / 2.0), 1e-12);
    EXPECT_NEAR(chi_square_tail(x, 4.0), (1.0 + x / 2.0) * std::exp(-x / 2.0), 1e-12);
    EXPECT_NEAR(chi_square_tail(x, 1.0), std::erfc(std::sqrt(x / 2.0)), 1e-12);
  }
  EXPECT_NEAR(chi_square_tail(2880.0, 2880.0), 0.5, 0.01);
}

// What the machinery is for: a density that is three per cent off at the edge must not pass.
TEST(ChiSquareTest, RejectsASlightlyWrongDensity) {
  const Sampler wrong{.sample = [](Vec2f u) { return scatter::cosine_direction(up, u).direction; },
                      .pdf = [](Vec3f d) { return std::pow(d.z, 1.03) * 2.03 / (2.0 * pi); }};
  EXPECT_LT(tested(wrong, height_chart(), 1'000'000, 1).test.probability, 1e-4);
}

TEST(Sampling, CosineDirections) {
  Battery battery;
  const Sampler sampler{.sample = [](Vec2f u) { return scatter::cosine_direction(up, u).direction; },
                        .pdf = [](Vec3f d) { return static_cast<double>(scatter::cosine_pdf(d, up)); }};
  battery.add("cosine", tested(sampler, height_chart(), 1'000'000, 2));
  battery.conclude("cosine-weighted directions");
}

class VisibleNormals : public testing::TestWithParam<MicrofacetDistribution> {};

TEST_P(VisibleNormals, HaveTheirDensity) {
  Battery battery;
  for (const double alpha : {0.05, 0.1, 0.3, 0.6}) {
    const Microfacets facets(GetParam(), static_cast<float>(alpha));
    for (const double incidence_deg : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0}) {
      const Vec3f w = direction(incidence_deg, 37.0);
      const Sampler sampler{.sample = [&](Vec2f u) { return facets.visible_normal(w, u); },
                            .pdf =
                                [&](Vec3f m) {
                                  return static_cast<double>(facets.visible_part(w.z) * facets.density(m) *
                                                             std::max(0.0F, dot(w, m)) / w.z);
                                }};
      battery.add(
          fmt::format("α {}, incidence {}°", alpha, incidence_deg),
          tested(sampler, normal_chart(alpha), 1'000'000, static_cast<std::uint64_t>(incidence_deg + 1000.0 * alpha)));
    }
  }
  battery.conclude(
      fmt::format("visible normals, {}", GetParam() == MicrofacetDistribution::Beckmann ? "Beckmann" : "GGX"));
}

INSTANTIATE_TEST_SUITE_P(Microfacets, VisibleNormals,
                         testing::Values(MicrofacetDistribution::Beckmann, MicrofacetDistribution::Ggx));

/// `model` as a sampler in the frame of its normal; samples of no density are those that give up.
template <typename Model>
Sampler sampler_of(const Model& model, Vec3f to_source) {
  return {.sample =
              [&model, to_source](Vec2f u) {
                const scatter::DirectionSample drawn = model.sample(to_source, up, u);
                return drawn.pdf > 0.0F ? drawn.direction : Vec3f{0.0F, 0.0F, -1.0F};
              },
          .pdf = [&model, to_source](Vec3f to_sink) { return static_cast<double>(model.pdf(to_source, to_sink, up)); }};
}

class EveryMaterialSampled : public testing::TestWithParam<double> {};

TEST_P(EveryMaterialSampled, HasItsDensity) {
  Battery battery;
  const double incidence_deg = GetParam();
  for (const scatter::Material& material : every_material()) {
    const scatter::SurfaceModel model(material, frequency_within(material));
    const auto* facets = std::get_if<scatter::CookTorranceParameters>(&material.model);
    const Vec3f to_source = direction(incidence_deg, 200.0);
    const bool narrow = facets != nullptr && facets->alpha < 0.25;
    const DirectionChart chart = narrow ? mirror_chart(to_source.to<double>(), facets->alpha) : height_chart();
    battery.add(material.name,
                tested(sampler_of(model, to_source), chart, 200'000, static_cast<std::uint64_t>(incidence_deg)));
  }
  battery.conclude(fmt::format("SurfaceModel::sample, all materials and models, incidence {}°", incidence_deg));
}

INSTANTIATE_TEST_SUITE_P(Sampling, EveryMaterialSampled, testing::Values(0.0, 45.0, 85.0));

TEST(Sampling, MirrorsAndMultipleScatterTogether) {
  Battery battery;
  for (const auto distribution : {MicrofacetDistribution::Beckmann, MicrofacetDistribution::Ggx}) {
    const scatter::CookTorrance model({{5.24, 0.0, 0.0462, 0.7822}, 0.6, distribution}, 10e9,
                                      {.multiple_scatter = true});
    for (const double incidence_deg : {0.0, 45.0, 85.0}) {
      battery.add(fmt::format("incidence {}°", incidence_deg),
                  tested(sampler_of(model, direction(incidence_deg, 200.0)), height_chart(), 200'000, 7));
    }
  }
  battery.conclude("Cook–Torrance with multiple scatter");
}

}  // namespace
}  // namespace sigmascape::statistics_test
