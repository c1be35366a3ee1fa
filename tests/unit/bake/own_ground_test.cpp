// Objects baked on their own terrain: docs/decisions/0051-baked-on-its-own-ground.md.
#include <cmath>
#include <gtest/gtest.h>

#include "validation/validation_record.h"

#include "sigmascape/bake/look_baker.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::bake {
namespace {

constexpr double slope_side_m = 128.0;

/// Ground of the given heights under one tower in the middle.
template <typename Height>
scene::Scene tower_on(const Height& height_at, Vec3f size_m) {
  scene::Scene scene;
  scene.name = "tower";
  scene.extent = {0.0, 0.0, slope_side_m, slope_side_m};
  constexpr double spacing_m = 2.0;
  scene.terrain = {0.0, slope_side_m, spacing_m, Array2D<float>(65, 65)};
  for (std::size_t row = 0; row < 65; ++row) {
    for (std::size_t column = 0; column < 65; ++column)
      scene.terrain.height_m(column, row) =
          static_cast<float>(height_at(slope_side_m - spacing_m * static_cast<double>(row)));
  }
  const scatter::Material ground{.name = "ground", .model = scatter::LambertParameters{1e-4, {0.1, 0.5}}, .source = {}};
  const scatter::Material wall{.name = "wall", .model = scatter::LambertParameters{0.9, {0.1, 0.5}}, .source = {}};
  scene.ground = {{0.0, slope_side_m, slope_side_m, 1, 1},
                  Array2D<scene::MaterialIndex>(1, 1, scene.material_index(ground))};
  scene.prototypes.push_back(scene::box_mesh(size_m, scene.material_index(wall)));
  scene.instances.push_back({.x_m = 64.0, .y_m = 64.0});
  return scene;
}

/// From the north, direct echoes alone.
BakeSettings settings_from_north(double elevation_deg, trace::Footing footing) {
  BakeSettings settings;
  settings.aspects = {{0.0}, {radians_from_deg(elevation_deg)}, {10e9}};
  settings.patches = {1.0, 256};
  settings.sampling = {.samples_per_texel = 16};
  settings.max_bounces = 1;
  settings.footing = footing;
  return settings;
}

BakedLook look_of(const scene::Scene& scene, double elevation_deg, trace::Footing footing) {
  const BakeSettings settings = settings_from_north(elevation_deg, footing);
  const LookBaker baker(scene, settings);
  SilentProgress silent;
  return baker.bake({0, 0}, settings.aspects.look(0).aspect, silent).front();
}

double row_power(const BakedLook& look, std::size_t row) {
  double sum = 0.0;
  for (std::size_t column = 0; column < look.sigma0.columns(); ++column)
    sum += static_cast<double>(look.sigma0(column, row).power(radar::Polarization::Sum));
  return sum;
}

double total_power(const BakedLook& look) {
  double sum = 0.0;
  for (std::size_t row = 0; row < look.sigma0.rows(); ++row) sum += row_power(look, row);
  return sum;
}

TEST(OwnGround, ATowerOnASlopeLiesOverUntilItsRangeMeetsTheSlope) {
  constexpr float height_m = 40.0F, depth_m = 4.0F;
  constexpr double elevation_deg = 30.0;
  for (const double slope : {-0.4, 0.0, 0.4}) {
    const auto scene = tower_on([&](double y) { return slope * (y - 64.0); }, {4.0F, depth_m, height_m});
    const BakedLook look = look_of(scene, elevation_deg, trace::Footing::Terrain);
    std::size_t farthest = 0;
    while (row_power(look, farthest) == 0.0) ++farthest;
    const double front_m = depth_m / 2.0, above_m = height_m - slope * front_m;
    validation::expect_close({.group = "Baked on its own ground",
                              .name = "layover of 40 m on a slope of " + std::to_string(slope),
                              .expected = front_m + above_m / (1.0 / std::tan(radians_from_deg(elevation_deg)) + slope),
                              .measured = 64.0 - (static_cast<double>(farthest) - 128.0),
                              .tolerance = 1.0,
                              .unit = "m",
                              .source = "estimator.md, Eq. (5)"});
  }
}

// The wall's upper half, which a ridge leaves to be seen, stands for all of it; the ridge hides the rest when a map is
// made. The line of sight falls so little that no echo leaves the wall's own texels.
TEST(OwnGround, WhatARidgeHidesIsNotHiddenTwice) {
  constexpr double fall = 0.016, height_m = 16.0, ridge_m = height_m / 2.0 + fall * (94.0 - 65.7);
  const auto behind_ridge = tower_on([](double y) { return std::abs(y - 96.0) < 3.0 ? ridge_m : 0.0; },
                                     {4.0F, 3.4F, static_cast<float>(height_m)});
  const double elevation_deg = deg_from_radians(std::atan(fall));
  const double open = total_power(look_of(behind_ridge, elevation_deg, trace::Footing::LevelPlane));
  const double hidden = total_power(look_of(behind_ridge, elevation_deg, trace::Footing::Terrain));
  EXPECT_NEAR(hidden / open, 1.0, 0.06);
}

// A tower that stands on the next patch answers before its foot, from texels of this one that a ridge hides: they are
// what they are when both patches are one.
TEST(OwnGround, TexelsBehindARidgeKnowWhatStandsBesideThePatch) {
  constexpr double elevation_deg = 10.0, foot_m = 65.7, edge_m = 66.0;
  const double ridge_m = 8.0 + (94.0 - foot_m) * std::tan(radians_from_deg(elevation_deg));
  const auto scene = tower_on([&](double y) { return std::abs(y - 96.0) < 3.0 ? ridge_m : 0.0; }, {4.0F, 3.4F, 16.0F});
  const BakeSettings settings = settings_from_north(elevation_deg, trace::Footing::Terrain);
  const LookBaker baker(scene, settings);
  const radar::Aspect aspect = settings.aspects.look(0).aspect;
  SilentProgress silent;
  const BakedLook whole = baker.bake({0, 0}, aspect, silent).front();
  const radar::GroundGrid beside{0.0, 94.0, 1.0, 128, static_cast<std::size_t>(94.0 - edge_m)};
  const BakedLook part = baker.bake(beside, baker.area_of(beside, aspect), aspect, silent).front();
  EXPECT_GT(total_power(part), 0.0);
  for (std::size_t row = 0; row < beside.rows; ++row) {
    for (std::size_t column = 0; column < beside.columns; ++column) {
      ASSERT_EQ(part.sigma0(column, row), whole.sigma0(column, row + static_cast<std::size_t>(256.0 - 94.0)))
          << column << " " << row;
    }
  }
}

}  // namespace
}  // namespace sigmascape::bake
