// Buildings that are kept apart from textures: what a map shows of them is held against what follows from their walls
// and roofs, 4π f cos² θ over what of them is seen, and against the path-traced map of the same scene.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "physics/baked_atlas.h"
#include "physics/level_scene.h"
#include "scratch_folder.h"
#include "validation/validation_record.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/base/error.h"
#include "sigmascape/live/live_ground.h"
#include "sigmascape/live/live_renderer.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/product/map_metrics.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/render/building_layer.h"
#include "sigmascape/render/ground_scatterers.h"
#include "sigmascape/scene/building_extrusion.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::physics_test {
namespace {

constexpr double house_albedo = 0.5, baked_texel_m = 2.0;

/// A box about a place, its long sides turned clockwise from east.
struct Box {
  Vec2d middle;
  double length_m, width_m, height_m, turn_rad = 0.0;

  [[nodiscard]] geo::Polygon outline() const {
    const Vec2d along{std::cos(turn_rad), -std::sin(turn_rad)}, across{std::sin(turn_rad), std::cos(turn_rad)};
    geo::Polygon polygon;
    for (const auto& [a, b] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
      polygon.outer.push_back(middle + along * (a * length_m) + across * (b * width_m));
    return polygon;
  }
};

/// On level ground.
void put(scene::Scene& scene, const Box& box, const scatter::Material& wall, const scatter::Material& roof) {
  const scene::MaterialIndex of_wall = scene.material_index(wall), of_roof = scene.material_index(roof);
  scene::append_building(scene.buildings, box.outline(), box.height_m, 0.0, of_wall, of_roof);
}

bake::BakeSettings settings_of(bake::Buildings buildings, int bounces) {
  bake::BakeSettings settings;
  settings.aspects = {{0.0, pi}, {radians_from_deg(15.0)}, {frequency_hz}};
  settings.patches = {baked_texel_m, 256};
  settings.sampling.samples_per_texel = 4;
  settings.max_bounces = bounces;
  settings.buildings = buildings;
  return settings;
}

radar::Radar radar_at(double azimuth_deg, double elevation_deg) {
  radar::Radar radar;
  radar.position = radar::position_seeing({}, radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg), 40e3);
  radar.range_resolution_m = baked_texel_m;
  radar.beam_width_rad = baked_texel_m * std::sqrt(2.0) / 40e3;
  return radar;
}

constexpr radar::GroundGrid map_cells{-64.0, 64.0, baked_texel_m, 64, 64};

radar::GroundMap rendered_map(const scene::Scene& scene, const atlas::Atlas& atlas, const radar::Radar& radar) {
  render::RenderCounts counts;
  return product::ground_map(simulate::baked_image(atlas, scene.terrain, radar, map_cells.extent(), {}, counts),
                             scene.terrain, map_cells);
}

radar::GroundMap traced_map(const scene::Scene& scene, const radar::Radar& radar, int bounces) {
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  trace::TraceCounts counts;
  return product::ground_map(
      simulate::traced_image(scene, geometry, radar, map_cells.extent(),
                             {.cell_m = 1.0, .samples_per_cell = 16, .max_bounces = bounces}, counts),
      scene.terrain, map_cells);
}

/// Of the cells whose middles lie within.
double power_m2(const radar::GroundMap& map, const radar::Rectangle& within = map_cells.extent()) {
  double sum = 0.0;
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column) {
      if (within.contains(map.grid.centre_of(column, row)))
        sum += static_cast<double>(map.sigma0(column, row).vv) * baked_texel_m * baked_texel_m;
    }
  }
  return sum;
}

/// Of one of Lambert's faces: 4π (ρ/π) cos² θ a square metre.
double returned_m2(double area_m2, double cosine) {
  return 4.0 * house_albedo * cosine * cosine * area_m2;
}

void expect_decibels(const std::string& name, double expected_m2, double measured_m2, double tolerance_db) {
  validation::expect_close({.group = "Buildings apart",
                            .name = name,
                            .expected = db_from_linear(expected_m2),
                            .measured = db_from_linear(measured_m2),
                            .tolerance = tolerance_db,
                            .unit = "dBm²",
                            .source = "4π f cos² θ over what is seen"});
}

// At azimuths and elevations that were not baked, the farthest from any that was included.
TEST(BuildingsApart, ReturnWhatTheirWallsAndRoofsDo) {
  scene::Scene scene = level_scene(lambert("black", 0.0), 256.0);
  const Box box{{3.0, -5.0}, 30.0, 18.0, 12.0, radians_from_deg(20.0)};
  put(scene, box, lambert("house", house_albedo), lambert("house", house_albedo));
  const atlas::Atlas atlas = baked_atlas(scene, settings_of(bake::Buildings::Apart, 1));
  for (const auto& [azimuth_deg, elevation_deg] : {std::pair{180.0, 10.0}, {225.0, 20.0}, {317.0, 33.0}, {65.0, 6.0}}) {
    const double elevation_rad = radians_from_deg(elevation_deg);
    const double off_long_rad = radians_from_deg(azimuth_deg - 20.0);  // from the normal of a long side
    const double along = std::abs(std::cos(off_long_rad)), across = std::abs(std::sin(off_long_rad));
    const double expected = returned_m2(box.length_m * box.height_m, along * std::cos(elevation_rad)) +
                            returned_m2(box.width_m * box.height_m, across * std::cos(elevation_rad)) +
                            returned_m2(box.length_m * box.width_m, std::sin(elevation_rad));
    const radar::GroundMap map = rendered_map(scene, atlas, radar_at(azimuth_deg, elevation_deg));
    expect_decibels(fmt::format("a box from {:g}° at {:g}°", azimuth_deg, elevation_deg), expected, power_m2(map),
                    0.02);
  }
}

// Textures hold nothing of a black ground with houses whose echoes are direct.
TEST(BuildingsApart, AreNotInTheTextures) {
  scene::Scene scene = level_scene(lambert("black", 0.0), 256.0);
  put(scene, {{}, 30.0, 18.0, 12.0}, lambert("house", house_albedo), lambert("house", house_albedo));
  const atlas::Atlas apart = baked_atlas(scene, settings_of(bake::Buildings::Apart, 1));
  const atlas::Atlas with = baked_atlas(scene, settings_of(bake::Buildings::Baked, 1));
  const radar::Aspect aspect{pi, radians_from_deg(10.0)};
  float most = 0.0F, most_with = 0.0F;
  for (double y = -40.0; y < 40.0; y += 1.0) {
    most = std::max(most, apart.sigma0_at({0.0, y}, aspect, frequency_hz, 0.0).vv);
    most_with = std::max(most_with, with.sigma0_at({0.0, y}, aspect, frequency_hz, 0.0).vv);
  }
  EXPECT_EQ(most, 0.0F);
  EXPECT_GT(most_with, 0.1F);
  ASSERT_NE(apart.ground_layers(), nullptr);
  EXPECT_TRUE(apart.ground_layers()->buildings.has_value());
  EXPECT_FALSE(with.ground_layers()->buildings.has_value());
}

// A wall of height h lies over by h tan ψ towards the radar, its roof with it.
TEST(BuildingsApart, LieOverTowardsTheRadar) {
  scene::Scene scene = level_scene(lambert("black", 0.0), 256.0);
  const Box box{{0.0, 10.0}, 40.0, 20.0, 20.0};
  put(scene, box, lambert("wall", house_albedo), lambert("black", 0.0));
  const atlas::Atlas atlas = baked_atlas(scene, settings_of(bake::Buildings::Apart, 1));
  for (const double elevation_deg : {15.0, 25.0, 35.0}) {
    const radar::GroundMap map = rendered_map(scene, atlas, radar_at(180.0, elevation_deg));
    double sum = 0.0, moment = 0.0;
    for (std::size_t row = 0; row < map.grid.rows; ++row) {
      const double y = map.grid.centre_of(0, row).y;
      for (const radar::Channels& cell : map.sigma0.row(row)) {
        sum += static_cast<double>(cell.vv);
        moment += static_cast<double>(cell.vv) * y;
      }
    }
    // The wall faces south and stands on y = 0; an even wall has its middle half way up.
    validation::expect_close({.group = "Buildings apart",
                              .name = fmt::format("middle of the layover of a 20 m wall at {:g}°", elevation_deg),
                              .expected = -0.5 * box.height_m * std::tan(radians_from_deg(elevation_deg)),
                              .measured = moment / sum,
                              .tolerance = 0.05,
                              .unit = "m",
                              .source = "half h tan ψ before its foot"});
  }
}

// Of the wall that stands 30 m behind another, what rises above the line of sight over that one's roof.
TEST(BuildingsApart, HideOneAnother) {
  const Box front{{0.0, -30.0}, 60.0, 10.0, 10.0}, behind{{0.0, 15.0}, 40.0, 20.0, 20.0};
  for (const double elevation_deg : {6.0, 12.0, 17.0}) {
    scene::Scene scene = level_scene(lambert("black", 0.0), 256.0);
    put(scene, front, lambert("black", 0.0), lambert("black", 0.0));
    put(scene, behind, lambert("wall", house_albedo), lambert("black", 0.0));
    const atlas::Atlas atlas = baked_atlas(scene, settings_of(bake::Buildings::Apart, 1));
    const double rise = std::tan(radians_from_deg(elevation_deg));
    // From the far edge of the front roof, y = −25, to the wall on y = 5.
    const double hidden_m = std::max(0.0, front.height_m - 30.0 * rise);
    const double expected =
        returned_m2(behind.length_m * (behind.height_m - hidden_m), std::cos(radians_from_deg(elevation_deg)));
    expect_decibels(fmt::format("a wall behind another at {:g}°", elevation_deg), expected,
                    power_m2(rendered_map(scene, atlas, radar_at(180.0, elevation_deg))), 0.15);
  }
}

/// What a layer of buildings returns from all of a place.
double returned_m2(const atlas::Atlas& atlas, const scene::Scene& scene, const render::LayerRequest& request) {
  const auto layer = render::building_layer(atlas, scene.terrain, request);
  double sum = 0.0;
  for (std::size_t row = 0; row < map_cells.rows; ++row) {
    for (std::size_t column = 0; column < map_cells.columns; ++column)
      sum += static_cast<double>(layer->sigma0_at(map_cells.centre_of(column, row)).vv) * baked_texel_m * baked_texel_m;
  }
  return sum;
}

// The beam of a strip meets every wall head-on that faces the track, and what a screen hides lies straight behind it.
// From the platform's place at time zero, 60 m away to the west, neither is so.
TEST(BuildingsApart, AreSeenByAStripAsItsBeamPasses) {
  constexpr double platform_m = 150.0, track_m = -200.0, height_m = 20.0, screen_m = 10.0;
  scene::Scene scene = level_scene(lambert("black", 0.0), 256.0);
  for (const double x : {-40.0, 40.0})
    put(scene, {{x, 10.0}, 20.0, 20.0, height_m}, lambert("wall", house_albedo), lambert("black", 0.0));
  put(scene, {{40.0, -15.0}, 20.0, 10.0, screen_m}, lambert("black", 0.0), lambert("black", 0.0));
  const atlas::Atlas atlas = baked_atlas(scene, settings_of(bake::Buildings::Apart, 1));
  // The screen's far edge is on y = −10, the wall on y = 0.
  const double hidden_m = screen_m - 10.0 * (platform_m - screen_m) / (-10.0 - track_m);
  const auto of_wall_from = [&](double lowest_m) {
    constexpr int pieces = 1000;
    double sum = 0.0;
    for (int i = 0; i < pieces; ++i) {
      const double z = lowest_m + (height_m - lowest_m) * (i + 0.5) / pieces, rise = (platform_m - z) / -track_m;
      sum += returned_m2(20.0 * (height_m - lowest_m) / pieces, 1.0 / std::hypot(1.0, rise));
    }
    return sum;
  };
  const double expected = of_wall_from(0.0) + of_wall_from(hidden_m);
  const radar::Vantage strip(radar::PassingBeam{
      .position = {-60.0, track_m, platform_m}, .velocity_mps = {100.0, 0.0, 0.0}, .outwards = {0.0, 1.0}});
  expect_decibels("walls along a strip", expected,
                  returned_m2(atlas, scene, {strip, frequency_hz, map_cells.extent(), 0.0}), 0.15);

  // Scatterers of I/Q have it in the mean.
  double of_scatterers = 0.0;
  constexpr std::uint64_t draws = 64;
  for (std::uint64_t seed = 0; seed < draws; ++seed) {
    for (const radar::Scatterer& scatterer :
         render::ground_scatterers(scene.terrain, render::reflectivity_of(atlas, frequency_hz, baked_texel_m),
                                   radar::ScattererLattice({.seed = seed, .cell_m = baked_texel_m}),
                                   {.vantage = strip, .area = map_cells.extent()}))
      of_scatterers += static_cast<double>(std::norm(scatterer.amplitude_m.vv)) / draws;
  }
  expect_decibels("walls along a strip, as scatterers", expected, of_scatterers, 0.25);
}

// 150 km away over a round Earth a roof is seen under the grazing angle that is left of the flat Earth's.
TEST(BuildingsApart, StandUprightOnARoundEarth) {
  scene::Scene scene = level_scene(lambert("black", 0.0), 256.0);
  const Box box{{0.0, 0.0}, 40.0, 30.0, 10.0};
  put(scene, box, lambert("black", 0.0), lambert("roof", house_albedo));
  const atlas::Atlas atlas = baked_atlas(scene, settings_of(bake::Buildings::Apart, 1));
  const Vec3d radar{0.0, -150e3, 4000.0};
  for (const radar::CurvedEarth earth : {radar::CurvedEarth::flat(), radar::CurvedEarth{}}) {
    const double sine = earth.sin_grazing(radar.z, box.height_m, 150e3);
    expect_decibels(fmt::format("a roof at {:.2f}°", deg_from_radians(std::asin(sine))),
                    returned_m2(box.length_m * box.width_m, sine),
                    returned_m2(atlas, scene, {radar::Vantage(radar), frequency_hz, map_cells.extent(), 0.0, earth}),
                    0.1);
  }
}

/// Ground that rises to the north.
scene::Scene slope_scene(const scatter::Material& ground, double rise) {
  scene::Scene scene = level_scene(ground, 256.0);
  for (const std::size_t column : {0U, 1U}) {
    scene.terrain.height_m(column, 0) = static_cast<float>(128.0 * rise);
    scene.terrain.height_m(column, 1) = static_cast<float>(-128.0 * rise);
  }
  return scene;
}

// A house on a slope stands on its lowest corner: what of its walls is in the hill is not seen, and its roof is whole.
TEST(BuildingsApart, StandInSlopes) {
  for (const double rise : {0.3, 0.6}) {
    scene::Scene scene = slope_scene(lambert("black", 0.0), rise);
    const Box box{{3.0, 5.0}, 20.0, 14.0, 16.0};
    scene::append_building(
        scene.buildings, box.outline(), box.height_m, scene::footing_of(box.outline(), scene.terrain),
        scene.material_index(lambert("wall", house_albedo)), scene.material_index(lambert("roof", house_albedo)));
    const atlas::Atlas atlas = baked_atlas(scene, settings_of(bake::Buildings::Apart, 1));
    for (const auto& [azimuth_deg, elevation_deg] : {std::pair{90.0, 35.0}, {180.0, 20.0}, {215.0, 45.0}}) {
      const radar::Radar radar = radar_at(azimuth_deg, elevation_deg);
      validation::expect_close(
          {.group = "Buildings apart",
           .name = fmt::format("a house on a slope of {:g} from {:g}° at {:g}°", rise, azimuth_deg, elevation_deg),
           .expected = db_from_linear(power_m2(traced_map(scene, radar, 1))),
           .measured = db_from_linear(power_m2(rendered_map(scene, atlas, radar))),
           .tolerance = 0.1,
           .unit = "dBm²",
           .source = "path-traced map"});
    }
  }
}

// Of a hall that is larger than what is mapped, all faces' middles lie beside the map.
TEST(BuildingsApart, AreSeenInPartOfThem) {
  scene::Scene scene = level_scene(lambert("black", 0.0), 256.0);
  put(scene, {{0.0, 0.0}, 240.0, 240.0, 8.0}, lambert("wall", house_albedo), lambert("roof", house_albedo));
  const atlas::Atlas atlas = baked_atlas(scene, settings_of(bake::Buildings::Apart, 1));
  const radar::Radar radar = radar_at(200.0, 25.0);
  const double sine = std::sin(radians_from_deg(25.0));
  for (const Vec2d middle : {Vec2d{0.0, 0.0}, {70.0, 60.0}, {-80.0, 20.0}}) {
    const radar::GroundGrid part{middle.x - 10.0, middle.y + 10.0, baked_texel_m, 10, 10};
    render::RenderCounts counts;
    const radar::GroundMap map = product::ground_map(
        simulate::baked_image(atlas, scene.terrain, radar, radar::widened(part.extent(), 8.0), {}, counts),
        scene.terrain, part);
    double mean = 0.0;
    for (const radar::Channels& cell : map.sigma0.values()) mean += static_cast<double>(cell.vv) / 100.0;
    expect_decibels(fmt::format("roof about ({:g}, {:g}) m", middle.x, middle.y), returned_m2(1.0, sine), mean, 0.05);
  }
}

// Squares of 8 m have what sixteen of 2 m have.
TEST(BuildingsApart, KeepTheirPowerAtCoarserLevels) {
  scene::Scene scene = level_scene(lambert("black", 0.0), 256.0);
  put(scene, {{3.0, -5.0}, 30.0, 18.0, 12.0, radians_from_deg(20.0)}, lambert("house", house_albedo),
      lambert("house", house_albedo));
  const atlas::Atlas atlas = baked_atlas(scene, settings_of(bake::Buildings::Apart, 1));
  const radar::Radar radar = radar_at(225.0, 20.0);
  const double finest_m2 = power_m2(rendered_map(scene, atlas, radar));
  render::RenderCounts counts;
  const radar::GroundMap coarse = product::ground_map(
      simulate::baked_image(atlas, scene.terrain, radar, map_cells.extent(), {.level_of_detail = 3}, counts),
      scene.terrain, map_cells);
  expect_decibels("a box at level of detail 3", finest_m2, power_m2(coarse), 0.1);
}

// Frames would show a town without its houses.
TEST(BuildingsApart, AreRefusedByLiveFrames) {
  scene::Scene scene = level_scene(lambert("black", 0.0), 256.0);
  put(scene, {{}, 30.0, 18.0, 12.0}, lambert("house", house_albedo), lambert("house", house_albedo));
  const ScratchFolder folder;
  SilentProgress silent;
  bake::bake(scene, settings_of(bake::Buildings::Apart, 1), folder.path("atlas"), silent);
  const std::string told =
      message_of_error([&] { static_cast<void>(live::LiveGround::open(folder.path("atlas"), frequency_hz)); });
  EXPECT_NE(told.find("bake an atlas with --buildings both"), std::string::npos) << told;
}

/// What every bin of a live frame over an atlas of that scene has on average.
std::vector<float> frame_of(const scene::Scene& scene, bake::Buildings buildings) {
  const ScratchFolder folder;
  SilentProgress silent;
  bake::bake(scene, settings_of(buildings, 3), folder.path("atlas"), silent);
  const auto ground = live::LiveGround::open(folder.path("atlas"), frequency_hz);
  live::LiveRenderer renderer(
      ground,
      {.content = live::FrameContent::Powers, .beams = 64, .ranges = 64, .beam_step_rad = 2e-3, .range_step_m = 4.0});
  const radar::Radar radar = radar_at(100.0, 22.0);
  const Vec3d away = radar.position;
  const live::Pose pose{.position = away * (2000.0 / length(away)),
                        .first_azimuth_rad = std::atan2(-away.x, -away.y) - 0.064,
                        .first_range_m = 1872.0};
  static_cast<void>(renderer.render(pose));
  ground->wait_until_loaded();
  const auto powers_m2 = renderer.render(pose).powers_m2;
  return {powers_m2.begin(), powers_m2.end()};
}

// The textures of buildings and those of all else add up to what one texture of both has.
TEST(BuildingsApart, AreInLiveFramesFromTexturesOfTheirOwn) {
  scene::Scene scene = level_scene(lambert("black", 0.0), 256.0);
  put(scene, {{}, 30.0, 18.0, 12.0}, lambert("house", house_albedo), lambert("house", house_albedo));
  const std::vector<float> with = frame_of(scene, bake::Buildings::Baked),
                           both = frame_of(scene, bake::Buildings::Both);
  ASSERT_EQ(both.size(), with.size());
  const float brightest = std::ranges::max(with);
  ASSERT_GT(brightest, 1.0F);
  for (std::size_t i = 0; i < with.size(); ++i) EXPECT_NEAR(both[i], with[i], 2e-3F * with[i] + 1e-5F * brightest);
}

/// Nine houses and a tower on ground of constant gamma.
scene::Scene village() {
  scene::Scene scene =
      level_scene({.name = "gamma", .model = scatter::ConstantGammaParameters{0.03, {0.1, 0.5}}, .source = {}}, 256.0);
  for (int i = 0; i < 9; ++i) {
    put(scene,
        {{-40.0 + 40.0 * (i % 3), -40.0 + 40.0 * (i / 3)}, 16.0, 10.0, i == 4 ? 25.0 : 7.0, radians_from_deg(17.0 * i)},
        lambert("wall", 0.3), lambert("roof", 0.1));
  }
  return scene;
}

// The whole of a village with what goes to and fro in it, from between the looks.
TEST(BuildingsApart, MakeMapsNearerToTracedOnes) {
  const scene::Scene scene = village();
  const atlas::Atlas apart = baked_atlas(scene, settings_of(bake::Buildings::Apart, 3));
  const atlas::Atlas with = baked_atlas(scene, settings_of(bake::Buildings::Baked, 3));
  double rms_apart = 0.0, rms_with = 0.0;
  for (const auto& [azimuth_deg, elevation_deg] : {std::pair{45.0, 15.0}, {120.0, 25.0}, {200.0, 10.0}}) {
    const radar::Radar radar = radar_at(azimuth_deg, elevation_deg);
    const radar::GroundMap truth = traced_map(scene, radar, 3);
    const auto at_8_m = [&](const radar::GroundMap& map) {
      return *product::compare_maps(map, truth, {.cells_m = {8.0}}).at_cell(8.0);
    };
    const auto of_apart = at_8_m(rendered_map(scene, apart, radar)), of_with = at_8_m(rendered_map(scene, with, radar));
    rms_apart += of_apart.rms_db / 3.0;
    rms_with += of_with.rms_db / 3.0;
    validation::expect_close({.group = "Buildings apart",
                              .name = fmt::format("a village from {:g}° at {:g}°, power", azimuth_deg, elevation_deg),
                              .expected = 0.0,
                              .measured = of_apart.bias_db,
                              .tolerance = 0.1,
                              .unit = "dB",
                              .source = "path-traced map"});
  }
  EXPECT_LT(rms_apart, 0.6 * rms_with) << rms_apart << " and " << rms_with;
}

}  // namespace
}  // namespace sigmascape::physics_test
