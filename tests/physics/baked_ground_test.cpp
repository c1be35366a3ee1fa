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

constexpr double gamma = 0.03;

/// Mean σ0_VV of the middle 200 m of a map, in decibels over γ sin ψ.
double error_db(const radar::RangeAzimuthImage& image, const scene::Scene& scene, double elevation_deg) {
  const auto map = product::ground_map(image, scene.terrain, {-100, 100, 4.0, 50, 50});
  double mean = 0.0;
  for (const radar::Channels& cell : map.sigma0.values()) mean += static_cast<double>(cell.vv) / 2500.0;
  return db_from_linear(mean / (gamma * std::sin(radians_from_deg(elevation_deg))));
}

// The whole way twice: traced live, and baked, stored, loaded and rendered.
TEST(BakedGround, BothWaysReturnGammaTimesSine) {
  const scatter::Material ground{
      .name = "gamma", .model = scatter::ConstantGammaParameters{gamma, {0.1, 0.5}}, .source = {}};
  const scene::Scene scene = level_scene(ground, 512.0);
  bake::BakeSettings settings;
  settings.aspects.azimuths_rad = {0.0, radians_from_deg(120.0), radians_from_deg(240.0)};
  settings.aspects.elevations_rad = atlas::paper_aspect_grid().elevations_rad;
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = 4;
  const ScratchFolder folder;
  const auto baked_atlas = [&](bake::Shadows shadows, const char* name) {
    settings.shadows = shadows;
    SilentProgress silent;
    bake::bake(scene, settings, folder.path(name), silent);
    return atlas::load_atlas(atlas::Store::open(folder.path(name)));
  };
  const atlas::Atlas atlas = baked_atlas(bake::Shadows::Baked, "baked");
  const atlas::Atlas apart = baked_atlas(bake::Shadows::RunTime, "apart");
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);

  for (const double azimuth_deg : {0.0, 77.0, 180.0}) {
    for (const double elevation_deg : {3.0, 5.0, 7.2, 17.0, 33.0}) {
      radar::Radar radar;
      radar.position = radar::position_seeing({}, radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg), 20e3);
      radar.range_resolution_m = 4.0;
      radar.beam_width_rad = 4.0 * std::sqrt(2.0) / 20e3;
      const auto expect = [&](std::string_view way, const radar::RangeAzimuthImage& image) {
        const std::string name = fmt::format("level constant-gamma ground {}, azimuth {:.0f}°, elevation {:.1f}°", way,
                                             azimuth_deg, elevation_deg);
        validation::expect_close({.group = "From scene to map",
                                  .name = name,
                                  .expected = 0.0,
                                  .measured = error_db(image, scene, elevation_deg),
                                  .tolerance = 0.05,
                                  .unit = "dB over γ sin ψ",
                                  .source = "definition of constant gamma"});
      };
      const radar::Rectangle area{-150, -150, 150, 150};
      for (const int level : {1, 3}) {
        render::RenderCounts counts;
        expect(level == 1 ? "baked" : "baked, from mip 2",
               simulate::baked_image(atlas, scene.terrain, radar, area, {.level_of_detail = level}, counts));
        expect(level == 1 ? "kept apart" : "kept apart, from mip 2",
               simulate::baked_image(apart, scene.terrain, radar, area, {.level_of_detail = level}, counts));
      }
      if (azimuth_deg != 77.0) continue;
      trace::TraceCounts counts;
      expect("traced live", simulate::traced_image(scene, geometry, radar, area, {.samples_per_cell = 4}, counts));
    }
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
