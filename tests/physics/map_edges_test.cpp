// A map of a part of the ground shows what a map of all of it shows there.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/level_scene.h"
#include "scratch_folder.h"
#include "validation/validation_record.h"

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::physics_test {
namespace {

constexpr double gamma = 0.03, elevation_deg = 20.0, side_m = 512.0, distance_m = 5e3;
constexpr radar::GroundGrid part{-60, 48, 4.0, 24, 24};

/// Of the outermost cells of the part that one farthest from γ sin ψ, in decibels.
double worst_at_the_edge_db(const radar::RangeAzimuthImage& image, const scene::Scene& scene) {
  const auto map = product::ground_map(image, scene.terrain, part);
  double worst_db = 0.0;
  for (std::size_t row = 0; row < part.rows; ++row) {
    for (std::size_t column = 0; column < part.columns; ++column) {
      if (row > 0 && row + 1 < part.rows && column > 0 && column + 1 < part.columns) continue;
      const double error_db = db_from_linear(static_cast<double>(map.sigma0(column, row).vv) /
                                             (gamma * std::sin(radians_from_deg(elevation_deg))));
      if (std::abs(error_db) > std::abs(worst_db)) worst_db = error_db;
    }
  }
  return worst_db;
}

// A beam half as wide as the part, as wide, and twice.
TEST(MapEdges, GroundBesideTheMapAnswersInItsOutermostCells) {
  const scatter::Material ground{
      .name = "gamma", .model = scatter::ConstantGammaParameters{gamma, {0.1, 0.5}}, .source = {}};
  const scene::Scene scene = level_scene(ground, side_m);
  bake::BakeSettings settings;
  settings.aspects.azimuths_rad = {0.0};
  settings.aspects.elevations_rad = {radians_from_deg(elevation_deg)};
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = 4;
  const ScratchFolder folder;
  SilentProgress silent;
  bake::bake(scene, settings, folder.path("atlas"), silent);
  const atlas::Atlas atlas = atlas::load_atlas(atlas::Store::open(folder.path("atlas")));
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);

  for (const double azimuth_deg : {0.0, 205.0}) {
    for (const double beam_m : {48.0, 96.0, 192.0}) {
      radar::Radar radar;
      radar.position =
          radar::position_seeing({}, radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg), distance_m);
      radar.range_resolution_m = 8.0;
      radar.beam_width_rad = beam_m * std::numbers::sqrt2 / (distance_m * std::cos(radians_from_deg(elevation_deg)));
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

}  // namespace
}  // namespace sigmascape::physics_test
