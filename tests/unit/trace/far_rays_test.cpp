#include <cmath>
#include <gtest/gtest.h>
#include <mutex>

#include "plain_scene.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::trace {
namespace {

constexpr double far_m = 60'000.0;

/// A village in a plain that goes on as far as a hill could be seen.
scene::Scene village_in_a_wide_plain(Vec2d place = {}) {
  constexpr std::size_t nodes = 121;
  scene::Scene scene = plain_scene();
  scene.extent = {-far_m, -far_m, far_m, far_m};
  scene.terrain = {-far_m, far_m, 2.0 * far_m / (nodes - 1), Array2D<float>(nodes, nodes, 0.0F)};
  scene.ground = {{-far_m, far_m, 2.0 * far_m, 1, 1}, Array2D<scene::MaterialIndex>(1, 1, scene.ground.material(0, 0))};
  for (std::uint64_t i = 0; i < 16; ++i) {
    const auto column = static_cast<float>(i % 4), row = static_cast<float>(i / 4);
    add_box(scene, {8, 10, 9},
            {static_cast<float>(place.x) - 26.0F + 17.0F * column, static_cast<float>(place.y) - 26.0F + 17.0F * row});
    scene.instances.back().yaw_rad = 6.0F * unit_float(hashed(7, i));
  }
  return scene;
}

/// What paths of several vertices bring back from about the village.
double power_of_several_bounces(const scene::Scene& scene, const radar::Aspect& aspect, Vec2d place = {}) {
  const SceneGeometry geometry(scene, Footing::Terrain);
  const auto viewpoint = Viewpoint::distant(aspect);
  const PathTracer tracer(geometry, surface_models(scene, 10e9), viewpoint, {}, 1);
  const radar::Rectangle about{place.x - 40.0, place.y - 40.0, place.x + 40.0, place.y + 40.0};
  LaunchArea launch = launch_area(viewpoint, about, 2.0, 0.0, 10.0, {10.0, 10.0});
  launch.top_height_m = geometry.highest_m() + 1.0;
  double power = 0.0;
  std::mutex guard;
  tracer.trace(launch, {0, 16, 16}, 2, [&](std::span<const radar::Echo> echoes, unsigned) {
    const std::lock_guard lock(guard);
    for (const radar::Echo& echo : echoes)
      power += echo.bounces > 1 ? echo.rcs_m2.power(radar::Polarization::Sum) : 0.0;
  });
  return power;
}

// Rays start above the highest hill, wherever it is, and single precision has a step of 4 mm at 50 km: they met walls
// from behind, and what went on from there was lost within the house.
TEST(FarRays, AFarHillTakesNothingFromAVillage) {
  const struct {
    double elevation_deg;
    float hill_m;
  } rows[] = {{1.0, 981.0F}, {5.0, 1899.0F}, {5.0, 2816.0F}};
  for (const auto& row : rows) {
    for (const double azimuth_deg : {0.0, 120.0, 240.0}) {
      const radar::Aspect aspect{radians_from_deg(azimuth_deg), radians_from_deg(row.elevation_deg)};
      scene::Scene scene = village_in_a_wide_plain();
      const double without = power_of_several_bounces(scene, aspect);
      scene.terrain.height_m(0, 60) = row.hill_m;  // in the west, from where no radar looks
      const double with = power_of_several_bounces(scene, aspect);
      EXPECT_NEAR(with / without, 1.0, 0.02) << row.hill_m << " m seen from " << azimuth_deg << "°";
    }
  }
}

TEST(FarRays, AVillageAtTheEdgeOfALargeSceneIsAsBrightAsInItsMiddle) {
  const radar::Aspect aspect{radians_from_deg(120.0), radians_from_deg(20.0)};
  const double in_the_middle = power_of_several_bounces(village_in_a_wide_plain(), aspect);
  const Vec2d place{54'000.0, -58'000.0};
  const double at_the_edge = power_of_several_bounces(village_in_a_wide_plain(place), aspect, place);
  EXPECT_NEAR(at_the_edge / in_the_middle, 1.0, 0.02);
}

}  // namespace
}  // namespace sigmascape::trace
