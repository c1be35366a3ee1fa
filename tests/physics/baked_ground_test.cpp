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

/// Mean σ0_VV of the middle 200 m of a map.
double mean_vv(const radar::RangeAzimuthImage& image, const scene::Scene& scene) {
  const auto map = product::ground_map(image, scene.terrain, {-100, 100, 4.0, 50, 50});
  double mean = 0.0;
  for (const radar::Channels& cell : map.sigma0.values()) mean += static_cast<double>(cell.vv) / 2500.0;
  return mean;
}

/// The same in decibels over γ sin ψ.
double error_db(const radar::RangeAzimuthImage& image, const scene::Scene& scene, double elevation_deg) {
  return db_from_linear(mean_vv(image, scene) / (ground_gamma * std::sin(radians_from_deg(elevation_deg))));
}

/// One that sees the middle of the scene in cells of 4 m.
radar::Radar radar_seeing(double azimuth_deg, double elevation_deg) {
  radar::Radar radar;
  radar.position = radar::position_seeing({}, radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg), 20e3);
  radar.range_resolution_m = 4.0;
  radar.beam_width_rad = 4.0 * std::sqrt(2.0) / 20e3;
  return radar;
}

// The whole way twice: traced live, and baked, stored, loaded and rendered.
TEST(BakedGround, BothWaysReturnGammaTimesSine) {
  const scene::Scene scene = level_scene(gamma_ground(), 512.0);
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
      const radar::Radar radar = radar_seeing(azimuth_deg, elevation_deg);
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

// Ground whose γ changes with the angle, of which what is read between two elevations is never quite true: at those
// that looks were baked at it is, 13° and 45°, and between them near enough. σ0 = 4 ρ sin² ψ, one part in 1 + 0.1 of it
// VV.
TEST(BakedGround, ALambertSurfaceKeptApartIsAsBrightAsItIs) {
  constexpr double albedo = 0.3, cross = 0.1;
  const scatter::Material ground{
      .name = "lambert", .model = scatter::LambertParameters{albedo, {cross, 0.5}}, .source = {}};
  const scene::Scene scene = level_scene(ground, 512.0);
  bake::BakeSettings settings;
  settings.aspects.azimuths_rad = {0.0};
  settings.aspects.elevations_rad = {radians_from_deg(13.0), radians_from_deg(45.0)};
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = 2;
  const ScratchFolder folder;
  SilentProgress silent;
  bake::bake(scene, settings, folder.path("apart"), silent);
  const atlas::Atlas atlas = atlas::load_atlas(atlas::Store::open(folder.path("apart")));
  for (const double elevation_deg : {5.0, 13.0, 20.0, 31.0, 45.0, 58.0}) {
    render::RenderCounts counts;
    const auto image = simulate::baked_image(atlas, scene.terrain, radar_seeing(0.0, elevation_deg),
                                             {-150, -150, 150, 150}, {}, counts);
    const double sine = std::sin(radians_from_deg(elevation_deg));
    const bool was_baked = elevation_deg == 13.0 || elevation_deg == 45.0;
    const std::string name = fmt::format("level Lambert ground kept apart, elevation {:.0f}°{}", elevation_deg,
                                         was_baked ? ", as baked" : "");
    validation::expect_close(
        {.group = "From scene to map",
         .name = name,
         .expected = 0.0,
         .measured = db_from_linear(mean_vv(image, scene) / (4.0 * albedo * sine * sine / (1.0 + cross))),
         .tolerance = was_baked ? 0.05 : 0.22,
         .unit = "dB over 4 ρ sin² ψ / 1.1",
         .source = "Lambert's law"});
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
