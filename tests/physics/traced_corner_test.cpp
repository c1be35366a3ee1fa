#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "physics/level_scene.h"
#include "validation/validation_record.h"

namespace sigmascape::physics_test {
namespace {

constexpr const char* traced_corner_group = "Corner reflectors, traced";
constexpr double corner_height_m = 5.0;

/// Corner reflectors of perfectly conducting, all but smooth plates, above black ground. Diffraction widens each
/// plate's lobe until it peaks as physical optics says.
class PlateScene {
 public:
  PlateScene() : scene_(level_scene(lambert("black", 0.0))) {}

  void add_plate(std::vector<Vec3d> corners, Vec3d axis, double turn_rad) {
    std::vector<Vec3f> turned;
    for (const Vec3d corner : corners) turned.push_back(turned_about(axis, corner, turn_rad).to<float>());
    scene::append_facet(plates_, turned, scene_.material_index(rough_conductor("plate", 1e-4)));
  }

  /// What comes back after `bounces` bounces, seen from `aspect`.
  [[nodiscard]] std::array<double, 4> seen(const radar::Aspect& aspect, std::size_t bounces, double at_frequency_hz,
                                           double cell_m) {
    scene_.prototypes = {plates_};
    scene_.instances = {{.lift_m = static_cast<float>(corner_height_m)}};
    const Vec2d landing =
        radar::horizontal_direction(aspect.azimuth_rad) * (corner_height_m * std::tan(aspect.elevation_rad));
    const auto echoes = traced_echoes(
        scene_, aspect,
        {.area = {landing.x - 3.0, landing.y - 3.0, landing.x + 3.0, landing.y + 3.0}, .cell_m = cell_m, .samples = 16},
        at_frequency_hz);
    return bounce_sums(echoes)[bounces];
  }

 private:
  static Vec3d turned_about(Vec3d axis, Vec3d p, double angle_rad) {
    return p * std::cos(angle_rad) + cross(axis, p) * std::sin(angle_rad) +
           axis * (dot(axis, p) * (1.0 - std::cos(angle_rad)));
  }

  scene::Scene scene_;
  scene::Mesh plates_;
};

/// A floor and a wall of side a that meet along x, seen at 45° from the south, turned about the line of sight.
std::array<double, 4> traced_dihedral(double side_m, double turn_rad, double at_frequency_hz) {
  const radar::Aspect aspect{pi, radians_from_deg(45.0)};
  const Vec3d sight = radar::direction_to_radar(aspect);
  const double half = side_m / 2.0;
  PlateScene scene;
  scene.add_plate({{-half, -side_m, 0}, {half, -side_m, 0}, {half, 0, 0}, {-half, 0, 0}}, sight, turn_rad);
  scene.add_plate({{-half, 0, 0}, {half, 0, 0}, {half, 0, side_m}, {-half, 0, side_m}}, sight, turn_rad);
  return scene.seen(aspect, 2, at_frequency_hz, 0.1);
}

void expect_dbsm(const std::string& name, double expected_db, double measured_m2, const char* source) {
  validation::expect_close({.group = traced_corner_group,
                            .name = name,
                            .expected = expected_db,
                            .measured = db_from_linear(measured_m2),
                            .tolerance = 0.1,
                            .unit = "dBsm",
                            .source = source});
}

// Two flat plates, each widened to α² = λ²/4πA, and both orders as amplitudes make the peak of physical optics.
TEST(TracedCorners, DihedralPeaksLikePhysicalOptics) {
  expect_dbsm("dihedral, 1 m × 1 m plates, 3 cm, VV", 44.46, traced_dihedral(1.0, 0.0, speed_of_light_mps / 0.03)[0],
              "physical optics, 8πa²b²/λ²");
  expect_dbsm("dihedral, 1.5 m × 1.5 m plates, 5.405 GHz, VV", 46.17, traced_dihedral(1.5, 0.0, 5.405e9)[0],
              "Sentinel-1 calibration, ESA STEP forum: 46.17 dBsm");
}

TEST(TracedCorners, DihedralTurnedAboutTheLineOfSight) {
  const double full = traced_dihedral(1.0, 0.0, frequency_hz)[0];
  for (const double turn_deg : {0.0, 22.5, 45.0, 90.0}) {
    const double cos_squared = 0.5 + 0.5 * std::cos(4.0 * radians_from_deg(turn_deg));
    const auto sums = traced_dihedral(1.0, radians_from_deg(turn_deg), frequency_hz);
    const auto report = [&](const char* name, std::size_t channel, double expected) {
      validation::expect_close(
          {.group = traced_corner_group,
           .name = fmt::format("dihedral turned by {}° about the line of sight, {}", turn_deg, name),
           .expected = expected,
           .measured = sums[channel] / full,
           .tolerance = 0.01,
           .unit = "of VV unturned",
           .source = "S = [−cos 2χ, ∓sin 2χ; ∓sin 2χ, cos 2χ]"});
    };
    report("|VV|²", 0, cos_squared);
    report("|HH|²", 1, cos_squared);
    report("|HV|²", 2, 1.0 - cos_squared);
    report("Re VV HH*", 3, 0.0 - cos_squared);
  }
}

TEST(TracedCorners, TrihedralIsTheIdentity) {
  PlateScene scene;
  scene.add_plate({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 0, 1}, 0.0);
  scene.add_plate({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, {0, 0, 1}, 0.0);
  scene.add_plate({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {0, 0, 1}, 0.0);
  for (const double azimuth_deg : {30.0, 45.0, 60.0}) {
    for (const double elevation_deg : {25.0, 35.26, 50.0}) {
      const auto sums =
          scene.seen({radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)}, 3, frequency_hz, 0.2);
      ASSERT_GT(sums[0], 1.0);
      const auto report = [&](const char* name, std::size_t channel, double expected) {
        validation::expect_close(
            {.group = traced_corner_group,
             .name = fmt::format("trihedral, azimuth {}°, elevation {}°, {}", azimuth_deg, elevation_deg, name),
             .expected = expected,
             .measured = sums[channel] / sums[0],
             .tolerance = 0.01,
             .unit = "of |VV|²",
             .source = "image theory: S is the identity"});
      };
      report("|HH|²", 1, 1.0);
      report("|HV|²", 2, 0.0);
      report("Re VV HH*", 3, 1.0);
    }
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
