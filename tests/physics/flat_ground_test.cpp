#include <cmath>
#include <gtest/gtest.h>

#include "physics/level_scene.h"

namespace sigmascape::physics_test {
namespace {

/// Mean σ0_VV of the middle of level ground, by way of the texels.
double baked_sigma0(const scatter::Material& ground, double elevation_deg, double texel_m, double launch_cell_m) {
  const radar::Aspect aspect{radians_from_deg(130.0), radians_from_deg(elevation_deg)};
  const scene::Scene scene = level_scene(ground);
  const radar::Rectangle area{-32, -32, 32, 32};
  receiver::GroundAccumulator texels(
      {-32, 32, texel_m, static_cast<std::size_t>(64 / texel_m), static_cast<std::size_t>(64 / texel_m)}, aspect);
  texels.add(traced_echoes(scene, aspect, {.area = area, .cell_m = launch_cell_m, .samples = 16}));
  return texels.bins().total()[0] / (64.0 * 64.0);
}

TEST(FlatGround, LambertIsFourAlbedoSineSquared) {
  const scatter::Material ground{.name = "lambert", .model = scatter::LambertParameters{0.4, {0.0, 1.0}}, .source = {}};
  for (const double elevation_deg : {2.0, 5.0, 13.0, 30.0, 45.0, 60.0}) {
    const double expected = 4.0 * 0.4 * std::pow(std::sin(radians_from_deg(elevation_deg)), 2);
    const double measured = baked_sigma0(ground, elevation_deg, 2.0, 2.0);
    EXPECT_NEAR(db_from_linear(measured / expected), 0.0, 0.05) << elevation_deg << "°";
    EXPECT_NEAR(db_from_linear(baked_sigma0(ground, elevation_deg, 1.0, 0.5) / measured), 0.0, 0.02)
        << elevation_deg << "°";
  }
}

TEST(FlatGround, ConstantGammaIsGammaTimesSine) {
  const scatter::Material ground{
      .name = "gamma", .model = scatter::ConstantGammaParameters{0.03, {0.1, 0.5}}, .source = {}};
  for (const double elevation_deg : {2.0, 5.0, 13.0, 30.0, 45.0, 60.0}) {
    const double expected = 0.03 * std::sin(radians_from_deg(elevation_deg));
    EXPECT_NEAR(db_from_linear(baked_sigma0(ground, elevation_deg, 2.0, 2.0) / expected), 0.0, 0.05)
        << elevation_deg << "°";
  }
}

// Kirchhoff: σ0 = π D |R|² G, for Beckmann exp(−tan²θ/α²) / (α² cos⁴θ) where masking is absent.
TEST(FlatGround, BeckmannIsGeometricOptics) {
  for (const double elevation_deg : {90.0 - 10.0, 90.0 - 20.0, 90.0 - 30.0}) {
    const double theta = radians_from_deg(90.0 - elevation_deg);
    const double expected = std::exp(-std::pow(std::tan(theta) / 0.3, 2)) / (0.09 * std::pow(std::cos(theta), 4));
    const double measured = baked_sigma0(rough_conductor("rough", 0.3), elevation_deg, 2.0, 2.0);
    EXPECT_NEAR(db_from_linear(measured / expected), 0.0, 0.05) << elevation_deg << "°";
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
