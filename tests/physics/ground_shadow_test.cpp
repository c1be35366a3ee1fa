#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/ground_with_box.h"
#include "physics/image_total.h"
#include "validation/validation_record.h"

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::physics_test {
namespace {

/// The scene baked from the south at one elevation and seen from there, 20 km away.
radar::RangeAzimuthImage image_from_south(const scene::Scene& scene, bake::Shadows shadows,
                                          const radar::Rectangle& area) {
  const atlas::Atlas atlas = baked_from_south(scene, shadows);
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(seen_elevation_deg), 20e3);
  radar.range_resolution_m = 2.0;
  radar.beam_width_rad = 2.0 * std::sqrt(2.0) / 20e3;
  render::RenderCounts counts;
  return simulate::baked_image(atlas, scene.terrain, radar, area, {}, counts);
}

radar::RangeAzimuthImage image_from_south(const scene::Scene& scene, bake::Shadows shadows) {
  return image_from_south(scene, shadows, {-150, -150, 150, 150});
}

/// Length of ground without power behind the box: what is missing of the open ground's power, over that power. Smearing
/// by the radar's response leaves it as it is.
double shadow_length_m(const radar::RangeAzimuthImage& image, const scene::Scene& scene) {
  const auto map = product::ground_map(image, scene.terrain, {-50, 100, 1.0, 100, 100});
  const auto power_at = [&](Vec2d p) {
    const Vec2d cell = map.grid.cells_from(p);
    return static_cast<double>(map.sigma0(static_cast<std::size_t>(cell.x), static_cast<std::size_t>(cell.y)).vv);
  };
  constexpr double start_m = 3.0;  // behind the box, clear of the smeared echo of the box itself
  double missing_m = start_m;
  for (double y = half_box_m + start_m + 0.5; y < 95.0; y += 1.0) {
    missing_m += 1.0 - power_at({0.5, y}) / power_at({-40.5, y});
  }
  return missing_m;
}

TEST(GroundShadow, BareSlopesReturnTheirOwnAngleAndArea) {
  for (const double slope_deg : {-10.0, 0.0, 10.0}) {
    const double slope = radians_from_deg(slope_deg);
    const scene::Scene scene = ground_with_box(std::tan(slope), false);
    const double expected = ground_gamma * std::sin(radians_from_deg(seen_elevation_deg) + slope) / std::cos(slope) *
                            scene.extent.width_m() * scene.extent.height_m();
    // All of the scene, beside which nothing answers.
    const auto image = image_from_south(scene, bake::Shadows::RunTime, scene.extent);
    validation::expect_close(
        {.group = "Ground apart",
         .name = fmt::format("constant-gamma ground that rises away from the radar by {:.0f}°", slope_deg),
         .expected = 0.0,
         .measured = db_from_linear(total_vv_m2(image) / expected),
         .tolerance = 0.03,
         .unit = "dB over γ sin(ψ + β) of the true area",
         .source = "definition of constant gamma"});
  }
}

TEST(GroundShadow, ABoxThrowsTheShadowOfItsSlope) {
  for (const double slope_deg : {-10.0, 0.0, 10.0}) {
    const double rise = std::tan(radians_from_deg(slope_deg)), tangent = std::tan(radians_from_deg(seen_elevation_deg));
    const scene::Scene scene = ground_with_box(rise, true);
    // From the far edge of the roof, which stands this much above the ground below it.
    const double expected_m = (box_height_m - half_box_m * rise) / (tangent + rise);
    validation::expect_close({.group = "Ground apart",
                              .name = fmt::format("shadow of a 12 m box on a slope of {:.0f}°", slope_deg),
                              .expected = expected_m,
                              .measured = shadow_length_m(image_from_south(scene, bake::Shadows::RunTime), scene),
                              .tolerance = 2.0,
                              .unit = "m",
                              .source = "h / (tan ψ + tan β)"});
  }
}

// On level ground, from a baked look, it makes no difference where the shadow is made: each echo is there once.
TEST(GroundShadow, NothingIsHiddenOrCountedTwice) {
  const scene::Scene scene = ground_with_box(0.0, true);
  const auto at_run_time = image_from_south(scene, bake::Shadows::RunTime),
             baked = image_from_south(scene, bake::Shadows::Baked);
  EXPECT_NEAR(total_vv_m2(at_run_time) / total_vv_m2(baked), 1.0, 0.003);
  EXPECT_NEAR(shadow_length_m(at_run_time, scene), shadow_length_m(baked, scene), 2.0);
}

// What was lost of the ground's layers is told, and made again by a bake that goes on.
TEST(GroundShadow, ALostLayerIsToldAndMadeAgain) {
  const scene::Scene scene = ground_with_box(0.0, true);
  bake::BakeSettings settings;
  settings.aspects = {{pi}, {radians_from_deg(seen_elevation_deg)}, {frequency_hz}};
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = 2;
  const ScratchFolder folder;
  SilentProgress silent;
  bake::bake(scene, settings, folder.path("atlas"), silent);
  const auto lost = folder.path("atlas") / "patch_-001_-001" / "obstacles.tif";
  ASSERT_TRUE(std::filesystem::remove(lost));
  const auto load = [&] { static_cast<void>(atlas::load_atlas(atlas::Store::open(folder.path("atlas")))); };
  EXPECT_NE(message_of_error(load).find("obstacles.tif: is missing"), std::string::npos) << message_of_error(load);
  EXPECT_EQ(bake::bake(scene, settings, folder.path("atlas"), silent).already, 4U);
  EXPECT_NO_THROW(load());
}

}  // namespace
}  // namespace sigmascape::physics_test
