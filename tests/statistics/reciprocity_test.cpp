#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>
#include <variant>
#include <vector>

#include "keep_worst.h"
#include "statistics/every_material.h"
#include "validation/validation_record.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/cook_torrance.h"
#include "sigmascape/scatter/surface_model.h"

namespace sigmascape::statistics_test {
namespace {

using scatter::PolarizationBasis;

/// S_qp for receive q and transmit p in the order v, h.
using Matrix = std::array<std::array<std::complex<double>, 2>, 2>;

Matrix in_basis(const scatter::FieldPair& out, const PolarizationBasis& received) {
  const auto element = [](const scatter::Field& field, Vec3f unit) {
    const scatter::Amplitude a = field.along(unit);
    return std::complex<double>(a.re, a.im);
  };
  return {{{element(out.from_v, received.v), element(out.from_h, received.v)},
           {element(out.from_v, received.h), element(out.from_h, received.h)}}};
}

/// Scattering from an antenna in direction `to_source` to one in direction `to_sink`, each in the basis of the wave
/// that it would send: the backscatter alignment, in which reciprocity is a plain transposition.
template <typename Model>
Matrix scattering_matrix(const Model& model, Vec3f to_source, Vec3f to_sink, Vec3f normal, scatter::PhaseDraw draw) {
  const PolarizationBasis sent(-to_source);
  const PolarizationBasis received(-to_sink);
  return in_basis(model.scatter({{sent.v, {}}, {sent.h, {}}}, to_source, to_sink, normal, draw), received);
}

/// The largest |S_qp − S'_pq| over the largest element: what is small beside its neighbours holds no more digits than
/// they do.
double departure_from_transpose(const Matrix& there, const Matrix& back) {
  double largest = 0.0, difference = 0.0;
  for (std::size_t q = 0; q < 2; ++q) {
    for (std::size_t p = 0; p < 2; ++p) {
      keep_worst(largest, std::abs(there[q][p]));
      keep_worst(difference, std::abs(there[q][p] - back[p][q]));
    }
  }
  return largest == 0.0 ? difference : difference / largest;
}

Vec3f hemisphere_direction(Vec3f normal, std::uint64_t key) {
  const float z = std::max(0.002F, unit_float(hashed(key, 1)));
  const float azimuth = 2.0F * static_cast<float>(pi) * unit_float(hashed(key, 2));
  const float radius = std::sqrt(1.0F - z * z);
  return normalized(Basis(normal).world_from_local({radius * std::cos(azimuth), radius * std::sin(azimuth), z}));
}

struct Worst {
  double departure = 0.0;
  int answered = 0;  ///< pairs with any scattering at all
};

/// Ten thousand pairs on surfaces of any orientation: half of them anywhere, half where the model likes to scatter.
template <typename Model>
Worst worst_departure(const Model& model) {
  Worst worst;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    const Vec3f normal = hemisphere_direction({0.0F, 0.0F, 1.0F}, hashed(i, 3));
    const Vec3f a = hemisphere_direction(normal, hashed(i, 4));
    const Vec3f b = i % 2 == 0
                        ? hemisphere_direction(normal, hashed(i, 5))
                        : model.sample(a, normal, {unit_float(hashed(i, 6)), unit_float(hashed(i, 7))}).direction;
    if (dot(b, normal) <= 0.0F) continue;
    const scatter::PhaseDraw draw{unit_float(hashed(i, 8)), unit_float(hashed(i, 9))};
    const Matrix there = scattering_matrix(model, a, b, normal, draw);
    const Matrix back = scattering_matrix(model, b, a, normal, draw);
    keep_worst(worst.departure, departure_from_transpose(there, back));
    if (std::abs(there[0][0]) + std::abs(there[1][1]) > 0.0) ++worst.answered;
  }
  return worst;
}

/// Rounding: some ten units in the last place of a float.
constexpr double of_one_reflection = 1e-6;

void expect_reciprocal(const std::string& name, const Worst& worst) {
  validation::expect_close({.group = "Reciprocity",
                            .name = name + ", largest |S(a→b) − S(b→a)ᵀ| of 10⁴ pairs over the largest element",
                            .expected = 0.0,
                            .measured = worst.departure,
                            .tolerance = of_one_reflection,
                            .unit = "1",
                            .source = "Lorentz reciprocity"});
  EXPECT_GT(worst.answered, 4000) << name << ": too few pairs scatter for the test to mean anything";
}

TEST(Reciprocity, EveryMaterial) {
  for (const scatter::Material& material : every_material()) {
    Worst worst = worst_departure(scatter::SurfaceModel(material, frequency_within(material)));
    for (const double frequency_hz : ends_of_frequencies(material)) {
      const Worst at_end = worst_departure(scatter::SurfaceModel(material, frequency_hz));
      worst = {std::max(worst.departure, at_end.departure), std::min(worst.answered, at_end.answered)};
    }
    expect_reciprocal(material.name, worst);
  }
}

TEST(Reciprocity, EveryOptionOfCookTorrance) {
  using scatter::Masking;
  using scatter::MicrofacetDistribution;
  for (const auto distribution : {MicrofacetDistribution::Beckmann, MicrofacetDistribution::Ggx}) {
    for (const auto masking : {Masking::Correlated, Masking::HeightCorrelated, Masking::Separable}) {
      for (const bool multiple_scatter : {false, true}) {
        const scatter::CookTorrance model({{5.24, 0.0, 0.0462, 0.7822}, 0.3, distribution}, 10e9,
                                          {masking, multiple_scatter});
        expect_reciprocal(fmt::format("concrete, {}, masking {}, multiple scatter {}",
                                      distribution == MicrofacetDistribution::Beckmann ? "Beckmann" : "GGX",
                                      masking == Masking::Correlated         ? "correlated"
                                      : masking == Masking::HeightCorrelated ? "height-correlated"
                                                                             : "separable",
                                      multiple_scatter ? "on" : "off"),
                          worst_departure(model));
      }
    }
  }
}

TEST(Reciprocity, StraightDownAndUp) {
  const Vec3f up{0.0F, 0.0F, 1.0F};
  const Vec3f aside = normalized(Vec3f{0.3F, 0.5F, 0.6F});
  const scatter::PhaseDraw draw{0.2F, 0.7F};
  for (const scatter::Material& material : scatter::material_library()) {
    const scatter::SurfaceModel model(material, frequency_within(material));
    const Matrix there = scattering_matrix(model, up, aside, up, draw);
    EXPECT_LT(departure_from_transpose(there, scattering_matrix(model, aside, up, up, draw)), 1e-6) << material.name;
  }
}

// In bases that follow the wave the same matrix is diag(1, −1) Sᵀ diag(1, −1): h turns over with the direction of
// travel.
TEST(Reciprocity, TransposeInBasesThatFollowTheWave) {
  const scatter::CookTorrance model({{5.24, 0.0, 0.0462, 0.7822}, 0.6, scatter::MicrofacetDistribution::Ggx}, 10e9);
  const Vec3f up{0.0F, 0.0F, 1.0F};
  const Vec3f a = normalized(Vec3f{0.3F, 0.5F, 0.6F});
  const Vec3f b = normalized(Vec3f{-0.7F, 0.1F, 0.4F});
  const auto following = [&](Vec3f from, Vec3f to) {
    const PolarizationBasis before(-from), after(to);
    const scatter::FieldPair out = model.scatter({{before.v, {}}, {before.h, {}}}, from, to, up, {});
    return std::array{out.from_v.along(after.v).re, out.from_h.along(after.v).re, out.from_v.along(after.h).re,
                      out.from_h.along(after.h).re};
  };
  const auto [vv, vh, hv, hh] = following(a, b);
  const auto [back_vv, back_vh, back_hv, back_hh] = following(b, a);
  EXPECT_GT(std::abs(vh), 0.01F * std::abs(vv));
  EXPECT_NEAR(back_vv, vv, 1e-6F);
  EXPECT_NEAR(back_hh, hh, 1e-6F);
  EXPECT_NEAR(back_vh, -hv, 1e-6F);
  EXPECT_NEAR(back_hv, -vh, 1e-6F);
}

// Off two surfaces, there and back: what VH is of one way HV is of the other, which is why a texel holds one of them.
TEST(Reciprocity, OfTwoBouncesOffAnyTwoMaterials) {
  std::vector<scatter::SurfaceModel> models;
  for (const scatter::Material& material : every_material()) {
    const auto known = scatter::known_frequencies(material);
    const bool at_c_band = std::ranges::any_of(
        known, [](const auto& range) { return range.lowest_hz <= 5.405e9 && range.highest_hz >= 5.405e9; });
    if (at_c_band) models.emplace_back(material, 5.405e9);
  }
  ASSERT_GT(models.size(), 40U);
  double worst = 0.0;
  int answered = 0;
  for (std::uint64_t i = 0; i < 40'000; ++i) {
    const auto& first = models[hashed(i, 20) % models.size()];
    const auto& second = models[hashed(i, 21) % models.size()];
    const Vec3f wall = hemisphere_direction({0.0F, -1.0F, 0.0F}, hashed(i, 22));
    const Vec3f ground = hemisphere_direction({0.0F, 0.0F, 1.0F}, hashed(i, 23));
    const Vec3f to_radar = hemisphere_direction(wall, hashed(i, 24));
    const Vec3f between =
        first.sample(to_radar, wall, {unit_float(hashed(i, 25)), unit_float(hashed(i, 26))}).direction;
    if (dot(to_radar, ground) <= 0.0F || dot(-between, ground) <= 0.0F || dot(between, wall) <= 0.0F) continue;
    const scatter::PhaseDraw at_wall{unit_float(hashed(i, 27)), unit_float(hashed(i, 28))};
    const scatter::PhaseDraw at_ground{unit_float(hashed(i, 29)), unit_float(hashed(i, 30))};
    const PolarizationBasis radar(-to_radar);
    const scatter::FieldPair sent{{radar.v, {}}, {radar.h, {}}};
    const Matrix there = in_basis(
        second.scatter(first.scatter(sent, to_radar, between, wall, at_wall), -between, to_radar, ground, at_ground),
        radar);
    const Matrix back = in_basis(
        first.scatter(second.scatter(sent, to_radar, -between, ground, at_ground), between, to_radar, wall, at_wall),
        radar);
    if (std::norm(there[0][0]) + std::norm(there[1][1]) < 1e-12) continue;
    ++answered;
    keep_worst(worst, departure_from_transpose(there, back));
  }
  validation::expect_close({.group = "Reciprocity",
                            .name = "two bounces off any two materials at 5.405 GHz, largest |S − S'ᵀ| of their "
                                    "reversals over the largest element",
                            .expected = 0.0,
                            .measured = worst,
                            // Either reflection may depart by as much as one may alone.
                            .tolerance = 2.0 * of_one_reflection,
                            .unit = "1",
                            .source = "Lorentz reciprocity: VH of a path is HV of its reversal"});
  EXPECT_GT(answered, 5000);
}

// A model that no material uses would go untested here, in the passivity and in the samplers' tests. Crowns are no
// surfaces: their tests are those of the tracer that crosses them.
TEST(Reciprocity, EveryModelIsAmongTheMaterials) {
  std::set<std::size_t> used;
  for (const scatter::Material& material : every_material()) used.insert(material.model.index());
  EXPECT_EQ(used.size(), std::variant_size_v<scatter::Material::Model> - 1);
}

}  // namespace
}  // namespace sigmascape::statistics_test
