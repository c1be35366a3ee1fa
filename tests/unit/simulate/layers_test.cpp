#include "sigmascape/simulate/layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "physics/level_scene.h"
#include "scratch_folder.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/scene/solid_mesh.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::simulate {
namespace {

using physics_test::lambert;

constexpr double cell_m = 1.0;
constexpr float height_m = 20.0F, depth_m = 12.0F, width_m = 40.0F;
const radar::GroundGrid narrow_grid{-4.0, 160.0, cell_m, 8, 220};

/// A box so high, whose near side stands at y = 0, on level ground.
scene::Scene tower_scene(float tall_m) {
  scene::Scene scene = physics_test::level_scene(lambert("ground", 0.5), 512.0);
  scene.prototypes.push_back(scene::box_mesh({width_m, depth_m, tall_m}, scene.material_index(lambert("box", 0.5))));
  scene.instances.push_back({.y_m = depth_m / 2.0F});
  return scene;
}

scene::Scene box_scene() {
  return tower_scene(height_m);
}

constexpr double foot_m = 16.0;

/// A ridge from west to east with its crest at y = 0 and its feet at ±foot_m, on level ground.
scene::Scene ridge_scene(double slope_rad) {
  scene::Scene scene = physics_test::level_scene(lambert("ground", 0.5), 512.0);
  const auto nodes = static_cast<std::size_t>(512.0 / foot_m) + 1;
  scene.terrain = {-256.0, 256.0, foot_m, Array2D<float>(nodes, nodes)};
  for (std::size_t column = 0; column < nodes; ++column)
    scene.terrain.height_m(column, nodes / 2) = static_cast<float>(foot_m * std::tan(slope_rad));
  return scene;
}

radar::Radar radar_in_the_south(double elevation_deg) {
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(elevation_deg), 20e3);
  return radar;
}

struct Stretch {
  double south_m = 0.0, north_m = 0.0;
};

/// Where, along the middle of the map, a mask is set: from the southern edge of its first cell to the northern of its
/// last, all between being set.
Stretch stretch_of(const Array2D<float>& mask, const radar::GroundGrid& map = narrow_grid) {
  const std::size_t column = mask.columns() / 2;
  std::size_t first = mask.rows(), last = 0, count = 0;
  for (std::size_t row = 0; row < mask.rows(); ++row) {
    if (mask(column, row) == 0.0F) continue;
    first = std::min(first, row);
    last = row;
    ++count;
  }
  EXPECT_EQ(count, last - first + 1) << "the mask has gaps";
  return {map.north_m - static_cast<double>(last + 1) * cell_m, map.north_m - static_cast<double>(first) * cell_m};
}

std::size_t set_cells(const Array2D<float>& mask) {
  return mask.size() - static_cast<std::size_t>(std::ranges::count(mask.values(), 0.0F));
}

enum class Way { Traced, Swept };

radar::LayerStack layers_of(Way way, const scene::Scene& scene, const radar::Radar& radar,
                            const std::vector<LayerKind>& kinds, const radar::GroundGrid& map = narrow_grid,
                            unsigned threads = 1, const std::vector<radar::Target>& targets = {}) {
  if (way == Way::Traced) {
    return traced_layers(scene, trace::SceneGeometry(scene, trace::Footing::Terrain), radar, map, kinds, threads,
                         targets);
  }
  const auto obstacles = scene::obstacles_of(scene, {-256.0, 256.0, 0.5, 1024, 1024});
  return swept_layers({&scene.terrain, &obstacles, &scene.ground, scene.materials.size()}, radar, map, kinds, threads,
                      targets);
}

class Layers : public ::testing::TestWithParam<Way> {};

// The far edge of the roof throws the shadow; beneath the box the ground is hidden as well.
TEST_P(Layers, ABoxHidesItsFootprintAndHeightOverTangent) {
  for (const double elevation_deg : {13.0, 29.0, 45.0}) {
    const auto stack = layers_of(GetParam(), box_scene(), radar_in_the_south(elevation_deg), {LayerKind::Shadow});
    const Stretch shadow = stretch_of(stack.layers[0].values);
    EXPECT_NEAR(shadow.south_m, 0.0, cell_m) << elevation_deg;
    EXPECT_NEAR(shadow.north_m, depth_m + height_m / std::tan(radians_from_deg(elevation_deg)), cell_m)
        << elevation_deg;
  }
}

/// A flat crown of 10 m in its middle, 20 m up and 120 m wide, seen under 80°: s = 10 m/sin 80° · √(1 − (y/60 m)²) of
/// it take e^−κs of the power out and back where they share gaps, and else e^−2κs, less than half where s is above 6.9
/// m.
TEST_P(Layers, ACrownHidesWhereLessThanHalfOfThePowerComesBack) {
  const double kappa = 0.05, elevation = radians_from_deg(80.0);
  for (const bool shares_gaps : {true, false}) {
    scene::Scene scene = physics_test::level_scene(lambert("ground", 0.5), 512.0);
    const scatter::CrownParameters leaves{.extinction_per_m = kappa, .shares_gaps = shares_gaps};
    const auto medium = scene.material_index({.name = "leaves", .model = leaves, .source = {}});
    scene.prototypes.push_back(scene::wall_mesh(0.001F, 0.001F, 0));
    scene.crowns.push_back({.prototype = 0, .shape = {{0.0F, 0.0F, 20.0F}, {60.0F, 60.0F, 5.0F}}, .medium = medium});
    scene.instances.push_back({});
    const auto stack = layers_of(GetParam(), scene, radar_in_the_south(80.0), {LayerKind::Shadow});
    if (shares_gaps) {
      EXPECT_EQ(set_cells(stack.layers[0].values), 0U);
      continue;
    }
    const double longest_m = 10.0 / std::sin(elevation), hiding_m = std::log(2.0) / (2.0 * kappa);
    const double half_m = 60.0 * std::sqrt(1.0 - std::pow(hiding_m / longest_m, 2.0));
    const Stretch shadow = stretch_of(stack.layers[0].values);
    EXPECT_NEAR(shadow.south_m, 20.0 / std::tan(elevation) - half_m, 2.0 * cell_m);
    EXPECT_NEAR(shadow.north_m, 20.0 / std::tan(elevation) + half_m, 2.0 * cell_m);
  }
}

// Wall and roof lie over by height times tangent, the roof's far edge from the other end of the box.
TEST_P(Layers, ABoxLiesOverByHeightTimesTangent) {
  for (const double elevation_deg : {13.0, 29.0, 45.0}) {
    const auto stack = layers_of(GetParam(), box_scene(), radar_in_the_south(elevation_deg), {LayerKind::Layover});
    const Stretch layover = stretch_of(stack.layers[0].values);
    const double over_m = height_m * std::tan(radians_from_deg(elevation_deg));
    EXPECT_NEAR(layover.south_m, -over_m, cell_m) << elevation_deg;
    EXPECT_NEAR(layover.north_m, std::max(0.0, depth_m - over_m), cell_m) << elevation_deg;
  }
}

/// As a box of that length towards north, as wide as the map, whose near side stands at `south_m`.
radar::Target box_target(double south_m, double length_m, double tall_m) {
  return {.name = "target",
          .track = radar::Track::straight({0.0, south_m + length_m / 2.0, tall_m / 2.0}),
          .rcs_m2 = radar::Channels{},
          .size_m = {length_m, static_cast<double>(width_m), tall_m}};
}

// As over a box of the scene, but that its faces do not answer: it lies over nothing.
TEST_P(Layers, ATargetHidesItsFootprintAndHeightOverTangent) {
  const scene::Scene level = physics_test::level_scene(lambert("ground", 0.5), 512.0);
  const auto target = box_target(0.0, depth_m, height_m);
  const auto stack = layers_of(GetParam(), level, radar_in_the_south(29.0), {LayerKind::Shadow, LayerKind::Layover},
                               narrow_grid, 1, {target});
  const Stretch shadow = stretch_of(stack.layers[0].values);
  EXPECT_NEAR(shadow.south_m, 0.0, cell_m);
  EXPECT_NEAR(shadow.north_m, depth_m + height_m / std::tan(radians_from_deg(29.0)), cell_m);
  EXPECT_EQ(set_cells(stack.layers[1].values), 0U);
}

// Ninety metres high and thirty before it, the target hides all of the box.
TEST_P(Layers, WhatATargetHidesLiesOverNothing) {
  const auto in_front = box_target(-30.0, 10.0, 90.0);
  const auto layover_of = [&](const std::vector<radar::Target>& targets) {
    return layers_of(GetParam(), box_scene(), radar_in_the_south(45.0), {LayerKind::Layover}, narrow_grid, 1, targets);
  };
  EXPECT_GT(set_cells(layover_of({}).layers[0].values), 0U);
  EXPECT_EQ(set_cells(layover_of({in_front}).layers[0].values), 0U);
}

// From 60° the arc of equal range rises by 30°. A slope of 50° folds over the level ground before it, as far as its
// height times tangent; the far side, seen as well, lies over all of the near one.
TEST_P(Layers, ASlopeSteeperThanTheArcFoldsOverTheGroundBeforeIt) {
  const double slope_rad = radians_from_deg(50.0), elevation_rad = radians_from_deg(60.0);
  const auto stack =
      layers_of(GetParam(), ridge_scene(slope_rad), radar_in_the_south(60.0), {LayerKind::Layover, LayerKind::Shadow});
  const Stretch layover = stretch_of(stack.layers[0].values);
  EXPECT_NEAR(layover.south_m, -foot_m * std::tan(slope_rad) * std::tan(elevation_rad), cell_m);
  EXPECT_NEAR(layover.north_m, 0.0, cell_m);
  EXPECT_EQ(set_cells(stack.layers[1].values), 0U);
}

// Seen from 45° a far side of 60° is hidden: nothing lies over the near one, which itself lies over twelve metres of
// level ground. Two metres before the crest the map ends, for there it is a matter of the step which side is seen.
TEST_P(Layers, AHiddenFarSideLiesOverNothing) {
  const double slope_rad = radians_from_deg(60.0);
  const radar::GroundGrid map{-4.0, -2.0, cell_m, 8, 58};
  const auto stack = layers_of(GetParam(), ridge_scene(slope_rad), radar_in_the_south(45.0), {LayerKind::Layover}, map);
  const Stretch layover = stretch_of(stack.layers[0].values, map);
  EXPECT_NEAR(layover.south_m, -foot_m * std::tan(slope_rad), cell_m);
  EXPECT_NEAR(layover.north_m, -foot_m, cell_m);
}

TEST_P(Layers, GroundFlatterThanTheArcIsNotLainOver) {
  for (const double slope_deg : {0.0, 25.0, 29.0}) {
    const auto stack =
        layers_of(GetParam(), ridge_scene(radians_from_deg(slope_deg)), radar_in_the_south(60.0), {LayerKind::Layover});
    EXPECT_EQ(set_cells(stack.layers[0].values), 0U) << slope_deg;
  }
}

// Rays meet a square of the terrain as two triangles, here up to four metres above or below its saddle, none steeper
// than 15°.
TEST_P(Layers, TwistedGroundNeitherLiesOverItselfNorHidesItself) {
  scene::Scene scene = physics_test::level_scene(lambert("ground", 0.5), 512.0);
  scene.terrain = {-256.0, 256.0, 64.0, Array2D<float>(9, 9)};
  for (std::size_t row = 0; row < 9; ++row) {
    for (std::size_t column = 0; column < 9; ++column)
      scene.terrain.height_m(column, row) = (row + column) % 2 == 0 ? 8.0F : 0.0F;
  }
  const auto stack = layers_of(GetParam(), scene, radar_in_the_south(60.0), {LayerKind::Layover, LayerKind::Shadow},
                               {-64.0, 64.0, 2.0, 64, 64});
  EXPECT_EQ(set_cells(stack.layers[0].values), 0U);
  EXPECT_EQ(set_cells(stack.layers[1].values), 0U);
}

TEST_P(Layers, GroundThatLeansTowardsTheRadarIsMetMoreSteeply) {
  const double slope_rad = radians_from_deg(10.0), elevation_deg = 20.0;
  scene::Scene scene = physics_test::level_scene(lambert("ground", 0.5), 512.0);
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t column = 0; column < 2; ++column)
      scene.terrain.height_m(column, row) = static_cast<float>((row == 0 ? 256.0 : -256.0) * std::tan(slope_rad));
  }
  const radar::Radar radar = radar_in_the_south(elevation_deg);
  const auto stack =
      layers_of(GetParam(), scene, radar, {LayerKind::Incidence, LayerKind::Range}, {-0.5, 0.5, 1.0, 1, 1});
  EXPECT_NEAR(stack.layers[0].values(0, 0), radians_from_deg(90.0 - elevation_deg) - slope_rad, 1e-4);
  EXPECT_EQ(stack.layers[0].unit, "rad");
  EXPECT_NEAR(stack.layers[1].values(0, 0), 20e3, 0.01);
}

TEST_P(Layers, FromAboveTheRoofIsSeenAndTheGroundAroundIt) {
  const scene::Scene scene = box_scene();
  const auto stack = layers_of(GetParam(), scene, radar_in_the_south(20.0), {LayerKind::Height, LayerKind::Class});
  const std::size_t on_roof = 160 - 6, on_ground = 160 + 20;
  EXPECT_NEAR(stack.layers[0].values(4, on_roof), height_m, 1e-3);
  EXPECT_NEAR(stack.layers[0].values(4, on_ground), 0.0, 1e-3);
  const auto names = class_names(scene);
  EXPECT_EQ(names.at(static_cast<std::size_t>(stack.layers[1].values(4, on_ground))), "ground");
  EXPECT_EQ(names.at(static_cast<std::size_t>(stack.layers[1].values(4, on_roof))),
            GetParam() == Way::Traced ? "box" : "solid object");
}

/// Maps a strip as it flies east, and passes the box of the scene two seconds after time zero.
radar::Radar radar_of_a_strip(double y_m) {
  radar::Radar radar;
  radar.position = {-100.0, y_m, 120.0};
  radar.velocity_mps = {50.0, 0.0, 0.0};
  radar.mode = radar::Mode::Stripmap;
  return radar;
}

/// The mask in the column of cells west of x = −15 m, which the box stands in.
Array2D<float> column_of_box(const radar::LayerStack& stack, std::size_t layer) {
  const auto column = static_cast<std::size_t>((-15.0 - stack.grid.west_m) / stack.grid.cell_m) - 1;
  Array2D<float> mask(1, stack.grid.rows);
  for (std::size_t row = 0; row < stack.grid.rows; ++row) mask(0, row) = stack.layers[layer].values(column, row);
  return mask;
}

// The beam looks north wherever it passes. From the place at time zero, 100 m before, the shadow would slant to the
// east and end at y = 25 m in this column.
TEST_P(Layers, OfAStripAreAsItsBeamPasses) {
  const radar::GroundGrid map{-220.0, 80.0, cell_m, 240, 120};
  const auto stack = layers_of(GetParam(), box_scene(), radar_of_a_strip(-200.0),
                               {LayerKind::Shadow, LayerKind::Layover, LayerKind::Range, LayerKind::Incidence}, map);
  const Stretch shadow = stretch_of(column_of_box(stack, 0), map);
  EXPECT_NEAR(shadow.south_m, 0.0, cell_m);
  EXPECT_NEAR(shadow.north_m, -200.0 + 212.0 * 120.0 / 100.0, cell_m);
  EXPECT_NEAR(stretch_of(column_of_box(stack, 1), map).south_m, -200.0 + std::sqrt(200.0 * 200.0 + 1e4 - 120.0 * 120.0),
              cell_m);
  for (const std::size_t column : {std::size_t{0}, std::size_t{239}}) {
    EXPECT_NEAR(stack.layers[2].values(column, 0), std::hypot(279.5, 120.0), 1e-3);
    EXPECT_NEAR(stack.layers[3].values(column, 0), std::atan2(279.5, 120.0), 1e-4);
  }
}

TEST_P(Layers, OfAStripOnBothSidesOfTheTrackAreOfTwoBeams) {
  scene::Scene scene = box_scene();
  scene.instances.push_back({.y_m = -206.0F});
  const radar::GroundGrid map{-220.0, 150.0, cell_m, 240, 400};
  const auto stack = layers_of(GetParam(), scene, radar_of_a_strip(-100.0), {LayerKind::Shadow}, map);
  const Array2D<float> column = column_of_box(stack, 0);
  Array2D<float> north(1, 250), south(1, 150);
  std::ranges::copy(column.values().subspan(0, 250), north.values().begin());
  std::ranges::copy(column.values().subspan(250), south.values().begin());
  const Stretch northern = stretch_of(north, map);
  EXPECT_NEAR(northern.south_m, 0.0, cell_m);
  EXPECT_NEAR(northern.north_m, -100.0 + 112.0 * 120.0 / 100.0, cell_m);
  const Stretch southern = stretch_of(south, {map.west_m, -100.0, cell_m, 240, 150});
  EXPECT_NEAR(southern.north_m, -200.0, cell_m);
  EXPECT_NEAR(southern.south_m, -100.0 - 112.0 * 120.0 / 100.0, cell_m);
}

// A target is hidden behind as it is looked at: it drives north, and is passed where it then is.
TEST_P(Layers, OfAStripHaveTheShadowsOfTargetsAsItsBeamPasses) {
  const scene::Scene level = physics_test::level_scene(lambert("ground", 0.5), 512.0);
  const radar::GroundGrid map{-220.0, 80.0, cell_m, 240, 120};
  radar::Target target = box_target(0.0, depth_m, height_m);
  // Two seconds on it stands as the box does.
  target.track = radar::Track::straight({0.0, depth_m / 2.0 - 20.0, height_m / 2.0}, {0.0, 10.0, 0.0});
  const auto stack = layers_of(GetParam(), level, radar_of_a_strip(-200.0), {LayerKind::Shadow}, map, 1, {target});
  const Stretch shadow = stretch_of(column_of_box(stack, 0), map);
  EXPECT_NEAR(shadow.south_m, 0.0, cell_m);
  EXPECT_NEAR(shadow.north_m, -200.0 + 212.0 * 120.0 / 100.0, cell_m);
}

/// 5 m above the ground.
radar::Radar low_radar_at(double north_m) {
  radar::Radar radar;
  radar.position = {0.0, north_m, 5.0};
  return radar;
}

// The line of sight ends at the radar.
TEST_P(Layers, WhatStandsBehindALowRadarNeitherHidesNorLiesOver) {
  const radar::GroundGrid beyond{-4.0, 160.0, cell_m, 8, 110};
  const auto stack =
      layers_of(GetParam(), tower_scene(60.0F), low_radar_at(40.0), {LayerKind::Shadow, LayerKind::Layover}, beyond);
  EXPECT_EQ(set_cells(stack.layers[0].values), 0U);
  EXPECT_EQ(set_cells(stack.layers[1].values), 0U);
}

// So far before a wall of 60 m that it stands below, it is nearer to the ground beyond than to the wall's top.
TEST_P(Layers, AWallLiesOverAsFarAsItsTopIsFromALowRadar) {
  for (const auto& [before_m, mast_m] : {std::pair{10.0, 5.0}, {60.0, 20.0}}) {
    radar::Radar radar;
    radar.position = {0.0, -before_m, mast_m};
    const auto stack = layers_of(GetParam(), tower_scene(60.0F), radar, {LayerKind::Layover});
    const Stretch layover = stretch_of(stack.layers[0].values);
    const auto ground_m = [&](double range_m) { return std::sqrt(range_m * range_m - mast_m * mast_m) - before_m; };
    EXPECT_NEAR(layover.south_m, ground_m(before_m), cell_m) << before_m;
    EXPECT_NEAR(layover.north_m, ground_m(std::hypot(before_m, 60.0 - mast_m)), cell_m) << before_m;
  }
}

TEST_P(Layers, AreTheSameForAnyThreads) {
  const std::vector<LayerKind> kinds{LayerKind::Shadow, LayerKind::Layover, LayerKind::Height};
  const auto one = layers_of(GetParam(), box_scene(), radar_in_the_south(20.0), kinds, narrow_grid, 1);
  const auto three = layers_of(GetParam(), box_scene(), radar_in_the_south(20.0), kinds, narrow_grid, 3);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    EXPECT_TRUE(std::ranges::equal(one.layers[k].values.values(), three.layers[k].values.values()));
  }
}

INSTANTIATE_TEST_SUITE_P(BothWays, Layers, ::testing::Values(Way::Traced, Way::Swept),
                         [](const auto& way) { return way.param == Way::Traced ? "Traced" : "Swept"; });

// A leaf of 45 cm, 10 m up, seen from 45°: it lies over 45 cm of ground 10 m before it, beside the middle of one cell
// of a metre, and over nothing else.
TEST(TracedLayers, ALeafSmallerThanACellLiesOverIt) {
  scene::Scene scene = physics_test::level_scene(lambert("ground", 0.5), 512.0);
  scene.prototypes.push_back(scene::wall_mesh(0.45F, 0.45F, scene.material_index(lambert("leaf", 0.5))));
  scene.instances.push_back({.x_m = 0.25F, .y_m = 0.48F, .lift_m = 10.0F});
  const auto stack = layers_of(Way::Traced, scene, radar_in_the_south(45.0), {LayerKind::Layover});
  EXPECT_EQ(set_cells(stack.layers[0].values), 1U);
  // Column 4 begins at x = 0, row 169 ends at y = −10.
  EXPECT_EQ(stack.layers[0].values(4, 169), 1.0F);
}

// Leaves between 10 and 12 m above four metres of ground, seen from 45°: each lies over the ground as far before it as
// it is high, and the bare stem over nothing.
TEST(SweptLayers, ACrownLiesOverFromItsBaseUp) {
  const scene::Scene scene = physics_test::level_scene(lambert("ground", 0.5), 512.0);
  radar::ObstacleMap obstacles{{-256.0, 256.0, 0.5, 1024, 1024}, Array2D<radar::Obstacle>(1024, 1024)};
  for (std::size_t row = 504; row < 512; ++row) {
    for (std::size_t column = 0; column < 1024; ++column)
      obstacles.obstacles(column, row) = {.crown_base_m = 10.0F, .crown_top_m = 12.0F, .crown_extinction_per_m = 0.1F};
  }
  const auto stack = swept_layers({&scene.terrain, &obstacles, &scene.ground, scene.materials.size()},
                                  radar_in_the_south(45.0), narrow_grid, std::vector{LayerKind::Layover}, 1);
  const Stretch layover = stretch_of(stack.layers[0].values);
  EXPECT_NEAR(layover.south_m, -12.0, cell_m);
  EXPECT_NEAR(layover.north_m, 4.0 - 10.0, cell_m);
}

TEST(LayerKinds, AnUnknownWordIsToldTheKnownOnes) {
  EXPECT_EQ(layer_kind("layover"), LayerKind::Layover);
  const std::string message = message_of_error([] { (void)layer_kind("shade"); });
  EXPECT_NE(message.find("shade"), std::string::npos);
  EXPECT_NE(message.find("shadow"), std::string::npos);
}

TEST(TracedBounces, AddUpToTheMap) {
  const scene::Scene scene = box_scene();
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  radar::Radar radar = radar_in_the_south(30.0);
  radar.beam_width_rad = 4.0 / 20e3;
  const radar::Rectangle area{-8.0, -24.0, 8.0, 24.0};
  const TraceSettings settings{.cell_m = 1.0, .samples_per_cell = 16};
  trace::TraceCounts counts;
  const auto whole = traced_image(scene, geometry, radar, area, settings, counts);
  const auto parts = traced_bounces(scene, geometry, radar, area, settings, 3, counts);
  ASSERT_EQ(parts.size(), 3U);
  double multiple = 0.0, brightest = 0.0;
  for (const radar::Channels& bin : whole.rcs_m2.values()) brightest = std::max(brightest, static_cast<double>(bin.vv));
  for (std::size_t i = 0; i < whole.rcs_m2.size(); ++i) {
    const auto vv = [&](std::size_t k) { return static_cast<double>(parts[k].rcs_m2.values()[i].vv); };
    EXPECT_NEAR(vv(0) + vv(1) + vv(2), static_cast<double>(whole.rcs_m2.values()[i].vv), 1e-5 * brightest);
    multiple += vv(1);
  }
  EXPECT_GT(multiple, 0.0) << "wall and ground make double bounces";
}

/// Houses of 6 m on a sixth of all blocks of 8 m, seen under 10°: h tan ψ is a metre, less than steps of coarse cells.
TEST(SweptLayers, MasksTellOfTheGroundWhateverTheCells) {
  const scene::Scene level = physics_test::level_scene(lambert("ground", 0.5), 512.0);
  radar::ObstacleMap town{{-256.0, 256.0, 2.0, 256, 256}, Array2D<radar::Obstacle>(256, 256)};
  for (std::size_t row = 0; row < 256; ++row) {
    for (std::size_t column = 0; column < 256; ++column) {
      if (hashed(column / 4, row / 4) % 6 == 0) town.obstacles(column, row).solid_top_m = 6.0F;
    }
  }
  const CoarseGround ground{&level.terrain, &town, &level.ground, level.materials.size()};
  const auto means = [&](double side_m) {
    const auto count = static_cast<std::size_t>(400.0 / side_m);
    const auto stack = swept_layers(ground, radar_in_the_south(10.0), {-200.0, 200.0, side_m, count, count},
                                    std::vector{LayerKind::Shadow, LayerKind::Layover}, 1, {});
    std::array<double, 2> shares{};
    for (std::size_t k = 0; k < 2; ++k)
      shares[k] = static_cast<double>(set_cells(stack.layers[k].values)) / static_cast<double>(count * count);
    return shares;
  };
  const auto fine = means(1.0);
  ASSERT_GT(fine[1], 0.1);
  for (const double side_m : {4.0, 8.0, 16.0}) {
    const auto coarse = means(side_m);
    EXPECT_NEAR(coarse[0], fine[0], 0.06) << side_m;
    EXPECT_NEAR(coarse[1], fine[1], 0.06) << side_m;
  }
}

}  // namespace
}  // namespace sigmascape::simulate
