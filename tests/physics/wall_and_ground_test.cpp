#include <cmath>
#include <gtest/gtest.h>
#include <mutex>

#include "physics/level_scene.h"

namespace sigmascape::physics_test {
namespace {

/// Looks horizontally `azimuth_deg` off the normal of a 10 m × 10 m wall that faces south, from 45° above.
BounceSums wall_sums(double alpha_wall, double alpha_ground, double azimuth_off_deg = 0.0,
                     const LookSettings& settings = {}) {
  scene::Scene scene = level_scene(rough_conductor("ground", alpha_ground));
  add_wall(scene, rough_conductor("wall", alpha_wall), 10.0F, 10.0F, pi);
  return bounce_sums(traced_echoes(scene, {pi + radians_from_deg(azimuth_off_deg), radians_from_deg(45.0)}, settings));
}

// One order of bounces at a mirror wall over a Beckmann ground returns L h tan θ / α² [radiometric closed form]; both
// orders together, being coherent, four times that in co-polarization.
TEST(WallAndGround, MirrorWallOnRoughGround) {
  const double closed_form = 4.0 * 10.0 * 10.0 / (0.3 * 0.3);
  const auto sums = wall_sums(0.002, 0.3);
  EXPECT_NEAR(db_from_linear(sums[2][0] / closed_form), 0.0, 0.1);
  EXPECT_NEAR(db_from_linear(sums[2][1] / closed_form), 0.0, 0.1);
}

TEST(WallAndGround, BothRoughAgreesWithQuadrature) {
  const auto sums = wall_sums(0.1, 0.3, 0.0, {.samples = 256});
  // 1057.05 m² for one order over all polarizations [separable masking, all but absent at 45° and these widths]; tilted
  // facets turn part of it into cross-polarization.
  EXPECT_NEAR(db_from_linear((sums[2][0] + sums[2][2]) / (4.0 * 1057.05)), 0.0, 0.1);
}

TEST(WallAndGround, TurnedWallFollowsClosedForm) {
  // Co- and cross-polarized power of one order: 830.628 m² at 10° off the normal; the pair adds 4× in VV and HH and,
  // since S_HV = S_VH here, in HV too.
  const auto sums = wall_sums(0.002, 0.3, 10.0);
  const double total = (sums[2][0] + sums[2][2]);
  EXPECT_NEAR(db_from_linear(total / (4.0 * 830.628)), 0.0, 0.1);
  EXPECT_NEAR(db_from_linear(sums[2][2] / sums[2][1]), -5.49, 0.15);
}

TEST(WallAndGround, TwoBouncesHaveOppositePhases) {
  const auto sums = wall_sums(0.002, 0.3);
  EXPECT_NEAR(sums[2][3] / std::sqrt(sums[2][0] * sums[2][1]), -1.0, 0.02);
  EXPECT_NEAR(sums[1][3] / std::sqrt(sums[1][0] * sums[1][1]), 1.0, 1e-3);
}

// 8 ρ² cos² A F with F = 0.200044 for perpendicular squares is 80.0175 m² when orders add as powers; as amplitudes
// twice that.
TEST(WallAndGround, LambertWallOnLambertGround) {
  const scatter::Material white{.name = "white", .model = scatter::LambertParameters{1.0, {0.0, 1.0}}, .source = {}};
  scatter::Material black = white;
  black.name = "black";
  std::get<scatter::LambertParameters>(black.model).albedo = 0.0;
  scene::Scene scene = level_scene(black);
  scene.ground = {{-5.0, 0.0, 10.0, 1, 1}, Array2D<scene::MaterialIndex>(1, 1)};
  add_wall(scene, white, 10.0F, 10.0F, pi);
  // The white square before the wall, in a map of 10 m cells around it.
  scene.ground.grid = {-15.0, 10.0, 10.0, 3, 3};
  scene.ground.material = Array2D<scene::MaterialIndex>(3, 3, scene.material_index(black));
  scene.ground.material(1, 1) = scene.material_index(white);
  const auto sums =
      bounce_sums(traced_echoes(scene, {pi, radians_from_deg(45.0)}, {.samples = 256, .options = {.max_bounces = 2}}));
  EXPECT_NEAR(db_from_linear(sums[2][0] / (2.0 * 80.0175)), 0.0, 0.1);
}

// Both estimators see the same power; the reciprocal one with far less scatter.
TEST(WallAndGround, ReciprocalWeightingKeepsTheMean) {
  const LookSettings one_way{.samples = 256, .options = {.max_bounces = 2, .estimator = trace::Estimator::OneWay}};
  const LookSettings reciprocal{.samples = 256, .options = {.max_bounces = 2}};
  const double a = wall_sums(0.3, 0.3, 0.0, one_way)[2][0];
  const double b = wall_sums(0.3, 0.3, 0.0, reciprocal)[2][0];
  EXPECT_NEAR(db_from_linear(a / b), 0.0, 0.1);
}

// For a mirror wall at no azimuth every way over ground and wall is as long as to the wall's foot and back.
TEST(WallAndGround, DoubleBounceLiesOnTheFootOfTheWall) {
  for (const double azimuth_deg : {0.0, 30.0, 60.0}) {
    scene::Scene scene = level_scene(rough_conductor("ground", 0.6));
    add_wall(scene, rough_conductor("wall", 0.002), 10.0F, 10.0F, pi);
    const radar::Aspect aspect{pi + radians_from_deg(azimuth_deg), radians_from_deg(20.0)};
    double power = 0.0, south = 0.0;
    const Vec2d towards = radar::horizontal_direction(aspect.azimuth_rad);
    for (const auto& echo : traced_echoes(scene, aspect)) {
      if (echo.bounces != 2) continue;
      const double y = towards.y * (-echo.range_m / std::cos(aspect.elevation_rad)) + towards.x * echo.cross;
      power += echo.rcs_m2.vv;
      south += echo.rcs_m2.vv * -y;
    }
    EXPECT_NEAR(south / power, 0.0, 0.05) << "azimuth " << azimuth_deg << "° off";
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
