#include "sigmascape/simulate/windblown.h"

#include <gtest/gtest.h>

#include "sigmascape/base/parallel.h"

namespace sigmascape::simulate {
namespace {

/// A sheet of leaves of 8 m by 8 m here and there over bare ground, with a meadow in the west.
scene::Scene place_with_sheets(std::initializer_list<Vec2f> places) {
  scene::Scene scene;
  scene.extent = {-5000.0, -3000.0, 5000.0, 3000.0};
  scene.terrain = {-5000.0, 3000.0, 10000.0, Array2D<float>(2, 2, 0.0F)};
  const auto material = [&](const char* name, bool plants) {
    return scene.material_index(
        {.name = name, .model = scatter::LambertParameters{0.5, {0.1, 0.5}}, .source = {}, .plants = plants});
  };
  const scene::MaterialIndex meadow = material("meadow", true), bare = material("grass pavers", false);
  scene.ground = {{-5000.0, 3000.0, 6000.0, 2, 1}, Array2D<scene::MaterialIndex>(2, 1, bare)};
  scene.ground.material(0, 0) = meadow;
  scene.prototypes.push_back({.name = "sheet",
                              .vertices = {{-4, -4, 5}, {4, -4, 5}, {4, 4, 6}, {-4, 4, 6}},
                              .triangles = {{0, 1, 2}, {0, 2, 3}},
                              .materials = {bare, bare}});
  for (const Vec2f place : places) scene.instances.push_back({.x_m = place.x, .y_m = place.y});
  return scene;
}

TEST(Windblown, KnowsCrownsAllOverTheScene) {
  const scene::Scene scene =
      place_with_sheets({{1500.0F, 0.0F}, {4990.0F, -2990.0F}, {4990.0F, 2990.0F}, {1144.0F, 952.0F}});
  const Windblown windblown = windblown_of(scene);
  // The last stands where four squares meet, 2048 m from one another, from the extent's corner on.
  parallel_for(64, 4, [&](std::size_t, unsigned) {
    for (const Vec2d place :
         {Vec2d{1500.0, 0.0}, {4990.0, -2990.0}, {4990.0, 2990.0}, {1142.0, 954.0}, {1146.0, 950.0}})
      EXPECT_TRUE(windblown(place)) << place.x << ' ' << place.y;
    for (const Vec2d place : {Vec2d{1510.0, 0.0}, {4000.0, -2990.0}, {1152.0, 952.0}})
      EXPECT_FALSE(windblown(place)) << place.x << ' ' << place.y;
    EXPECT_TRUE(windblown({-3000.0, 0.0})) << "a meadow";
  });
}

}  // namespace
}  // namespace sigmascape::simulate
