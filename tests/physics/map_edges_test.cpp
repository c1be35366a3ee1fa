// A map of a part of the ground shows what a map of all of it shows there.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "keep_worst.h"
#include "physics/baked_atlas.h"
#include "physics/image_total.h"
#include "physics/level_scene.h"
#include "validation/validation_record.h"

#include "sigmascape/product/ground_projection.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::physics_test {
namespace {

constexpr double map_elevation_deg = 20.0, scene_side_m = 512.0, radar_distance_m = 5e3;
constexpr radar::GroundGrid part{-60, 48, 4.0, 24, 24};

/// Of the outermost cells of the part that one farthest from γ sin ψ, in decibels.
double worst_at_the_edge_db(const radar::RangeAzimuthImage& image, const scene::Scene& scene) {
  const auto map = product::ground_map(image, scene.terrain, part);
  double worst_db = 0.0;
  for (std::size_t row = 0; row < part.rows; ++row) {
    for (std::size_t column = 0; column < part.columns; ++column) {
      if (row > 0 && row + 1 < part.rows && column > 0 && column + 1 < part.columns) continue;
      const double error_db = db_from_linear(static_cast<double>(map.sigma0(column, row).vv) /
                                             (ground_gamma * std::sin(radians_from_deg(map_elevation_deg))));
      keep_worst(worst_db, error_db);
    }
  }
  return worst_db;
}

scene::Scene ground_of_constant_gamma() {
  return level_scene(gamma_ground(), scene_side_m);
}

atlas::Atlas baked_at_one_look(const scene::Scene& scene) {
  bake::BakeSettings settings;
  settings.aspects.azimuths_rad = {0.0};
  settings.aspects.elevations_rad = {radians_from_deg(map_elevation_deg)};
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = 4;
  return baked_atlas(scene, settings);
}

// A beam half as wide as the part, as wide, and twice.
TEST(MapEdges, GroundBesideTheMapAnswersInItsOutermostCells) {
  const scene::Scene scene = ground_of_constant_gamma();
  const atlas::Atlas atlas = baked_at_one_look(scene);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);

  for (const double azimuth_deg : {0.0, 205.0}) {
    for (const double beam_m : {48.0, 96.0, 192.0}) {
      radar::Radar radar;
      radar.position = radar::position_seeing({}, radians_from_deg(azimuth_deg), radians_from_deg(map_elevation_deg),
                                              radar_distance_m);
      radar.range_resolution_m = 8.0;
      radar.beam_width_rad =
          beam_m * std::numbers::sqrt2 / (radar_distance_m * std::cos(radians_from_deg(map_elevation_deg)));
      const auto expect = [&](std::string_view way, const radar::RangeAzimuthImage& image) {
        validation::expect_close(
            {.group = "From scene to map",
             .name = fmt::format("edge of a map of 96 m {}, beam of {:g} m, azimuth {:.0f}°", way, beam_m, azimuth_deg),
             .expected = 0.0,
             .measured = worst_at_the_edge_db(image, scene),
             .tolerance = 0.2,
             .unit = "dB over γ sin ψ",
             .source = "definition of constant gamma"});
      };
      render::RenderCounts rendered;
      expect("baked", simulate::baked_image(atlas, scene.terrain, radar, part.extent(), {}, rendered));
      trace::TraceCounts traced;
      expect("traced", simulate::traced_image(scene, geometry, radar, part.extent(), {.samples_per_cell = 16}, traced));
    }
  }
}

/// Of the cells of the part that one, in decibels, in which its own map is farthest from that of the whole scene.
double worst_against_the_whole_db(const atlas::Atlas& atlas, const scene::Scene& scene, const radar::Radar& radar,
                                  const radar::GroundGrid& grid) {
  render::RenderCounts counts;
  const auto map_of = [&](const radar::Rectangle& area) {
    return product::ground_map(simulate::baked_image(atlas, scene.terrain, radar, area, {}, counts), scene.terrain,
                               grid);
  };
  const auto own = map_of(grid.extent()), whole = map_of(scene.extent);
  double worst_db = 0.0;
  for (std::size_t i = 0; i < own.sigma0.size(); ++i) {
    const double error_db = db_from_linear(static_cast<double>(own.sigma0.values()[i].vv) /
                                           static_cast<double>(whole.sigma0.values()[i].vv));
    keep_worst(worst_db, error_db);
  }
  return worst_db;
}

void expect_part_of_the_whole(const atlas::Atlas& atlas, const scene::Scene& scene, const radar::Radar& radar,
                              const radar::GroundGrid& grid) {
  validation::expect_close({.group = "From scene to map",
                            .name = fmt::format("map of {:g} m by {:g} m as part of one of 512 m, {}",
                                                grid.extent().width_m(), grid.extent().height_m(), radar.name),
                            .expected = 0.0,
                            .measured = worst_against_the_whole_db(atlas, scene, radar, grid),
                            .tolerance = 0.25,
                            .unit = "dB",
                            .source = "the same ground"});
}

// Ranges change least at the point nearest to the radar, which lies on an edge of the map and not at a corner.
TEST(MapEdges, OfSteepMapsTheNearestEdgeHasGroundBeside) {
  const scene::Scene scene = ground_of_constant_gamma();
  radar::Radar radar;
  constexpr radar::GroundGrid strip{-60, 192, 4.0, 24, 96};
  radar.name = "from 15 m beside its long side and 400 m up";
  radar.position = {strip.extent().west_m - 15.0, strip.extent().centre().y, 400.0};
  radar.range_resolution_m = 2.0;
  radar.beam_width_rad = radians_from_deg(3.0);
  expect_part_of_the_whole(baked_at_one_look(scene), scene, radar, strip);
}

TEST(MapEdges, LobesBesideTheAxisHaveTheirGround) {
  const scene::Scene scene = ground_of_constant_gamma();
  radar::Radar radar;
  radar.name = "two lobes 70 m beside the axis";
  radar.position = radar::position_seeing({}, 0.0, radians_from_deg(map_elevation_deg), radar_distance_m);
  radar.range_resolution_m = 8.0;
  radar.beam_width_rad = radians_from_deg(0.4);
  radar.antenna.azimuth = radar::TabulatedBeam{
      {{-4.0, 1e-4}, {-3.0, 1e-2}, {-2.0, 1.0}, {-1.0, 1e-2}, {1.0, 1e-2}, {2.0, 1.0}, {3.0, 1e-2}, {4.0, 1e-4}}};
  expect_part_of_the_whole(baked_at_one_look(scene), scene, radar, part);
}

/// A plane about the origin that falls towards the north.
scene::Scene slope_of_constant_gamma(double slope_deg) {
  scene::Scene scene = ground_of_constant_gamma();
  const auto rise_m = static_cast<float>(0.5 * scene_side_m * std::tan(radians_from_deg(slope_deg)));
  for (const std::size_t column : {0U, 1U}) {
    scene.terrain.height_m(column, 0) = -rise_m;
    scene.terrain.height_m(column, 1) = rise_m;
  }
  return scene;
}

// Traced terrain goes on level beyond its edges, for walls to stand before, and is not of the scene: beside a slope it
// lies in ranges of its own.
TEST(MapEdges, NothingAnswersFromBesideTheScene) {
  for (const auto& [slope_deg, seen_from_deg] : {std::pair{0.0, 20.0}, std::pair{25.0, 20.0}, std::pair{25.0, 75.0}}) {
    const scene::Scene scene = slope_of_constant_gamma(slope_deg);
    const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
    radar::Radar radar;
    const double psi = radians_from_deg(seen_from_deg), tilt = radians_from_deg(slope_deg);
    radar.position = radar::position_seeing({}, 0.0, psi, 200e3);
    radar.range_resolution_m = 4.0;
    radar.beam_width_rad = 8.0 / 200e3;
    trace::TraceCounts counts;
    const auto image = simulate::traced_image(scene, geometry, radar, radar::widened(scene.extent, 100.0),
                                              {.cell_m = 4.0, .samples_per_cell = 16}, counts);
    validation::expect_close(
        {.group = "From scene to map",
         .name = fmt::format("power of all of a slope of {:g}° traced from {:g}°", slope_deg, seen_from_deg),
         .expected = 0.0,
         .measured = db_from_linear(total_vv_m2(image) / (ground_gamma * scene_side_m * scene_side_m *
                                                          (std::sin(psi) + std::cos(psi) * std::tan(tilt)))),
         .tolerance = 0.03,
         .unit = "dB over γ sin of the grazing angle, times the true area",
         .source = "definition of constant gamma"});
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
