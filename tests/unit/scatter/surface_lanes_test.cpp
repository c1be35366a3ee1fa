#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"
#include "sigmascape/scatter/lanes.h"
#include "sigmascape/scatter/surface_model.h"

namespace sigmascape::scatter {
namespace {

Vec3f drawn_direction(std::uint64_t key, Vec3f normal) {
  return cosine_direction(normal, {unit_float(hashed(key, 1)), unit_float(hashed(key, 2))}).direction;
}

/// Sixteen waves that meet faces of all sizes, turned every way, and where they leave to; a few leave into the face.
struct Company {
  ArrivalLanes at;
  FieldPairLanes in;
  VectorLanes to_sink;
  PairLanes u;

  explicit Company(std::uint64_t key) {
    for (std::size_t i = 0; i < lane_count; ++i) {
      const std::uint64_t lane = hashed(key, i);
      const float z = 2.0F * unit_float(hashed(lane, 3)) - 1.0F, turn = 6.28F * unit_float(hashed(lane, 4));
      const float radius = std::sqrt(1.0F - z * z);
      const Vec3f normal{radius * std::cos(turn), radius * std::sin(turn), z};
      const Vec3f from = drawn_direction(hashed(lane, 5), normal), to = drawn_direction(hashed(lane, 6), normal);
      at.to_source.set(i, from);
      at.normal.set(i, normal);
      at.inverse_area_per_m2[i] = i % 4 == 0 ? 0.0F : 20.0F * unit_float(hashed(lane, 7));
      to_sink.set(i, i % 8 == 5 ? -to : to);
      const PolarizationBasis basis(-from);
      in.set(i, {{basis.v, basis.h * 0.3F}, {basis.h, basis.v * -0.2F}});
      u.set(i, {unit_float(hashed(lane, 8)), unit_float(hashed(lane, 9))});
    }
  }
};

bool same(const FieldPair& a, const FieldPair& b) {
  return a.from_v.re == b.from_v.re && a.from_v.im == b.from_v.im && a.from_h.re == b.from_h.re &&
         a.from_h.im == b.from_h.im;
}

std::vector<Material> materials_of_all_kinds() {
  std::vector<Material> materials = material_library();
  CookTorranceParameters wall{{5.24, 0.0, 0.0462, 0.7822}, 0.2};
  wall.scattering_coefficient = 0.4;
  materials.push_back({.name = "wall with windows", .model = wall, .source = {}});
  wall = {{5.24, 0.0, 0.0462, 0.7822}, 0.3, MicrofacetDistribution::Ggx};
  wall.multiple_scatter = true;
  materials.push_back({.name = "rough wall", .model = wall, .source = {}});
  return materials;
}

/// Calls body(model, name) for every material that is known at 10 GHz.
template <typename Body>
void for_each_model(const Body& body) {
  int models = 0;
  for (const Material& material : materials_of_all_kinds()) {
    if (material.lowest_frequency_hz > 10e9 || material.highest_frequency_hz < 10e9) continue;
    if (std::ranges::none_of(known_frequencies(material), [](const FrequencyRange& range) {
          return range.lowest_hz <= 10e9 && range.highest_hz >= 10e9;
        })) {
      continue;
    }
    body(SurfaceModel(material, 10e9), material.name);
    ++models;
  }
  EXPECT_GT(models, 40);
}

TEST(SurfaceLanes, EachHasTheAnswerOfASingleWave) {
  for_each_model([](const SurfaceModel& model, const std::string& name) {
    for (std::uint64_t key = 0; key < 20; ++key) {
      const Company waves(key);
      ChannelLanes back;
      VectorLanes next;
      PassageLanes passed;
      model.backscatter(waves.at, back);
      model.sample(waves.at, waves.u, next);
      model.pass_on(waves.in, waves.at, waves.to_sink, waves.u, passed);
      for (std::size_t i = 0; i < lane_count; ++i) {
        const Vec3f to_source = waves.at.to_source[i], to_sink = waves.to_sink[i];
        const Facet face = waves.at.face(i);
        EXPECT_EQ(back[i], model.backscatter(to_source, face)) << name;
        EXPECT_EQ(next[i], model.sample(to_source, face, waves.u[i]).direction) << name;
        if (dot(to_sink, face.normal) <= 0.0F) continue;
        const Passage single = model.pass_on(waves.in[i], to_source, to_sink, face, {waves.u.x[i], waves.u.y[i]});
        EXPECT_TRUE(same(passed.fields[i], single.fields)) << name;
        EXPECT_EQ(passed.pdf[i], single.pdf) << name;
        EXPECT_EQ(passed.reverse_pdf[i], single.reverse_pdf) << name;
      }
    }
  });
}

TEST(SurfaceLanes, PassageIsScatterAndBothDensities) {
  for_each_model([](const SurfaceModel& model, const std::string& name) {
    for (std::uint64_t key = 0; key < 20; ++key) {
      const Company waves(key);
      for (std::size_t i = 0; i < lane_count; ++i) {
        const Vec3f to_source = waves.at.to_source[i], to_sink = waves.to_sink[i];
        const Facet face = waves.at.face(i);
        if (dot(to_sink, face.normal) <= 0.0F) continue;
        const PhaseDraw draw{waves.u.x[i], waves.u.y[i]};
        const Passage passed = model.pass_on(waves.in[i], to_source, to_sink, face, draw);
        EXPECT_TRUE(same(passed.fields, model.scatter(waves.in[i], to_source, to_sink, face, draw))) << name;
        EXPECT_FLOAT_EQ(passed.pdf, model.pdf(to_source, to_sink, face)) << name;
        EXPECT_FLOAT_EQ(passed.reverse_pdf, model.pdf(to_sink, to_source, face)) << name;
      }
    }
  });
}

TEST(SurfaceLanes, OfMirrorsReturnNothingThroughTheFace) {
  const SurfaceModel model(library_material("paper_leaf"), 10e9);
  const Company waves(1);
  PassageLanes passed;
  model.pass_on(waves.in, waves.at, waves.to_sink, waves.u, passed);
  EXPECT_EQ(passed.fields[5].mean_power(), 0.0F);
  EXPECT_EQ(passed.pdf[5], 0.0F);
  EXPECT_EQ(passed.reverse_pdf[5], 0.0F);
}

}  // namespace
}  // namespace sigmascape::scatter
