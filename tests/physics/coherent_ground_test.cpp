#include <cmath>
#include <gtest/gtest.h>

#include "physics/ground_with_box.h"
#include "validation/validation_record.h"

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/product/slant_projection.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape::physics_test {
namespace {

/// Spotlight SAR with cells of 1.5 m times the looks along, from the south on a flight to the east, on cells of 1 m.
radar::GroundMap spotlight(const scene::Scene& scene, std::size_t looks,
                           bake::Shadows shadows = bake::Shadows::RunTime) {
  const atlas::Atlas atlas = baked_from_south(scene, shadows);
  radar::Radar radar;
  radar.mode = radar::Mode::Spotlight;
  radar.frequency_hz = frequency_hz;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(seen_elevation_deg), 5e3);
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.range_resolution_m = 1.5;
  radar.waveform.pulse_repetition_hz = 2000.0;
  const double interval_s = wavelength_m(frequency_hz) * 5e3 / (2.0 * 100.0 * 1.5);
  const simulate::CoherentScene seen{&scene.terrain, render::reflectivity_of(atlas, frequency_hz, 2.0)};
  product::LooksOnGround map(scene.terrain, {-120.0, 120.0, 1.0, 240, 240});
  simulate::range_doppler_looks(seen, radar, {-150.0, -150.0, 150.0, 150.0},
                                {.interval_s = interval_s, .scatterer_spacing_m = 0.5, .seed = 7}, looks,
                                [&](const radar::RangeDopplerImage& look) { map.add(look); });
  return map.map();
}

double mean_over(const radar::GroundMap& map, const radar::Rectangle& part) {
  double sum = 0.0, count = 0.0;
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column) {
      if (!part.contains(map.grid.centre_of(column, row))) continue;
      sum += static_cast<double>(map.sigma0(column, row).vv);
      count += 1.0;
    }
  }
  return sum / count;
}

/// Variance over mean².
double spread_of(const radar::GroundMap& map) {
  double sum = 0.0, squares = 0.0;
  for (const radar::Channels& cell : map.sigma0.values()) {
    const auto value = static_cast<double>(cell.vv);
    sum += value;
    squares += value * value;
  }
  return squares * static_cast<double>(map.sigma0.size()) / (sum * sum) - 1.0;
}

/// Of the cells, those below a tenth of the mean.
double dark_part_of(const radar::GroundMap& map) {
  double sum = 0.0, dark = 0.0;
  for (const radar::Channels& cell : map.sigma0.values()) sum += static_cast<double>(cell.vv);
  const auto cells = static_cast<double>(map.sigma0.size());
  for (const radar::Channels& cell : map.sigma0.values()) dark += static_cast<double>(cell.vv) < 0.1 * sum / cells;
  return dark / cells;
}

const double open_ground = ground_gamma * std::sin(radians_from_deg(seen_elevation_deg));

/// An atlas that keeps the ground apart has nothing of it in its textures; a coherent image shows it all the same.
TEST(CoherentGroundApart, bare_ground_kept_apart_has_its_sigma0) {
  const auto map = spotlight(ground_with_box(0.0, false), 1);
  validation::expect_close({"Coherent maps", "σ0 of bare ground of an atlas that keeps it apart", 0.0,
                            db_from_linear(mean_over(map, {-120.0, -120.0, 120.0, 120.0}) / open_ground), 0.1,
                            "dB over γ sin ψ", "definition of constant gamma"});
  const auto looked = spotlight(ground_with_box(0.0, false), 4);
  validation::expect_close({"Coherent maps", "the same in four looks", 0.0,
                            db_from_linear(mean_over(looked, {-120.0, -120.0, 120.0, 120.0}) / open_ground), 0.1,
                            "dB over γ sin ψ", "definition of constant gamma"});
  // A power that was interpolated between bins would be 0.78, and hardly ever dark.
  validation::expect_close({"Coherent maps", "variance over mean² of one look, on the ground", 1.0, spread_of(map),
                            0.06, "", "exponential speckle"});
  validation::expect_close({"Coherent maps", "variance over mean² of four looks, on the ground", 0.25,
                            spread_of(looked), 0.03, "", "independent looks"});
  validation::expect_close({"Coherent maps", "part of the cells below a tenth of the mean, on the ground",
                            1.0 - std::exp(-0.1), dark_part_of(map), 0.01, "", "exponential speckle"});
}

/// Texels hold means: with n of them a cell that speckled themselves, by the noise of their few rays, the variance
/// would be 1 + 2/n of the square.
TEST(CoherentGround, of_textures_is_not_speckled_twice) {
  const auto map = spotlight(ground_with_box(0.0, false), 1, bake::Shadows::Baked);
  validation::expect_close({"Coherent maps", "variance over mean² of one look, on ground in textures", 1.0,
                            spread_of(map), 0.06, "", "exponential speckle"});
}

/// The shadow of the roof's far edge is dark for h / tan ψ behind the box, and the ground beyond it is not.
TEST(CoherentGroundApart, a_box_casts_its_shadow) {
  const auto map = spotlight(ground_with_box(0.0, true), 1);
  constexpr double half_m = 4.0, from_m = 10.0, to_m = 80.0;
  // Length without power between two edges, as the power that is missing: a blurred edge leaves it as it is.
  const double missing_m =
      from_m - half_box_m + (to_m - from_m) * (1.0 - mean_over(map, {-half_m, from_m, half_m, to_m}) / open_ground);
  validation::expect_close({"Coherent maps", "shadow of a 12 m box in a spotlight image",
                            box_height_m / std::tan(radians_from_deg(seen_elevation_deg)), missing_m, 4.0, "m",
                            "h / tan ψ"});
  EXPECT_LT(mean_over(map, {-half_m, from_m, half_m, 30.0}) / open_ground, 0.03);
  EXPECT_NEAR(mean_over(map, {-110.0, from_m, -20.0, 30.0}) / open_ground, 1.0, 0.1);
}

}  // namespace
}  // namespace sigmascape::physics_test
