#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "plain_scene.h"
#include "validation/validation_record.h"

#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::trace {
namespace {

const Viewpoint from_south_southwest = Viewpoint::distant({pi + 0.3, radians_from_deg(40.0)});

/// Boxes on ground, all of one material: two along a street, or four about a pit.
scene::Scene walled_scene(const scatter::Material& material, bool pit) {
  scene::Scene scene = plain_scene(0.0);
  const scene::MaterialIndex index = scene.material_index(material);
  scene.ground.material(0, 0) = index;
  scene.prototypes.push_back(scene::box_mesh({8, 20, 10}, index));
  for (const float x : {-8.0F, 8.0F}) scene.instances.push_back({.x_m = x});
  if (!pit) return scene;
  for (const float y : {-8.0F, 8.0F}) {
    scene.instances.push_back({.y_m = y, .yaw_rad = static_cast<float>(pi / 2.0)});
  }
  return scene;
}

PowerBooks books_of(const scene::Scene& scene, double frequency_hz, const PathOptions& options) {
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const PathTracer tracer(geometry, surface_models(scene, frequency_hz), from_south_southwest, options, 1);
  const LaunchArea launch = launch_area(from_south_southwest, {-8, -8, 8, 8}, 2.0, 0.0, geometry.highest_m() + 1.0, {});
  return tracer.trace(launch, {0, 256, 256}, 1, [](std::span<const radar::Echo>, unsigned) {}).power;
}

double frequency_within(const scatter::Material& material) {
  const auto known = scatter::known_frequencies(material);
  return std::clamp(10e9, known.front().lowest_hz, known.front().highest_hz);
}

TEST(PowerBooks, BalanceForEveryMaterial) {
  for (const scatter::Material& material : scatter::material_library()) {
    for (const bool pit : {false, true}) {
      const PowerBooks books =
          books_of(walled_scene(material, pit), frequency_within(material), {.max_bounces = 6, .power_books = true});
      ASSERT_GT(books.paths, 1000U);
      const std::string name = material.name + (pit ? ", pit" : ", street");
      EXPECT_LT(std::abs(books.imbalance()), 3.0 * books.imbalance_error()) << name;
      // Most materials have an error of less than 0.3 %, conductors one of up to 1.7 %.
      EXPECT_NEAR(books.imbalance(), 0.0, 0.02) << name;
      EXPECT_LT(books.imbalance_error(), 0.018) << name << ": too noisy to tell";
      EXPECT_GT(books.escaped, 0.0) << name;
      EXPECT_GE(books.cut, 0.0) << name;
    }
  }
}

TEST(PowerBooks, OfLambertKnowTheAlbedo) {
  // Level ground meets no path twice: it absorbs what its albedo leaves, and the rest escapes.
  const scene::Scene scene = plain_scene(0.3);
  const PowerBooks books = books_of(scene, 10e9, {.power_books = true});
  validation::expect_close({.group = "Books of power",
                            .name = "level Lambert ground of albedo 0.3: part that escapes",
                            .expected = 0.3,
                            .measured = books.escaped / static_cast<double>(books.paths),
                            .tolerance = 0.01,
                            .unit = "1",
                            .source = "definition of the albedo"});
}

TEST(PowerBooks, CutGrowsAsBouncesAreForbidden) {
  const scene::Scene scene = walled_scene(lambert("bright", 0.9), true);
  const auto part_cut = [&](int most) {
    const PowerBooks books = books_of(scene, 10e9, {.max_bounces = most, .power_books = true});
    return books.cut / static_cast<double>(books.paths);
  };
  EXPECT_GT(part_cut(2), 2.0 * part_cut(6));
  EXPECT_GT(part_cut(6), 0.0);
}

TEST(PowerBooks, RouletteTakesNothingInTheMean) {
  const PowerBooks books = books_of(walled_scene(lambert("dark", 0.3), true), 10e9, {.power_books = true});
  EXPECT_NE(books.roulette, 0.0);
  EXPECT_LT(std::abs(books.roulette) / static_cast<double>(books.paths), 0.01);
}

TEST(PowerBooks, AreEmptyUnlessAskedFor) {
  EXPECT_EQ(books_of(plain_scene(), 10e9, {}).paths, 0U);
}

}  // namespace
}  // namespace sigmascape::trace
