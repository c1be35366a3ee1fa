#include "sigmascape/trace/surroundings.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/scene/paper_scene.h"
#include "sigmascape/trace/scene_geometry.h"
#include "sigmascape/trace/scene_heights.h"

namespace sigmascape::trace {
namespace {

TEST(Surroundings, HoldWhatIsNearAndAsFarAsItsShadowReaches) {
  const Surroundings around{.place = {0.0, 0.0, 100.0, 100.0},
                            .near_m = 50.0,
                            .least_slope = std::tan(radians_from_deg(5.0)),
                            .lowest_m = 7.0};
  EXPECT_TRUE(around.hold({50.0, 50.0}, 0.0, -100.0));
  EXPECT_TRUE(around.hold({149.0, 50.0}, 0.0, -100.0));
  EXPECT_FALSE(around.hold({151.0, 50.0}, 0.0, 7.0));
  EXPECT_TRUE(around.hold({151.0, 50.0}, 2.0, 7.0)) << "its edge is near";
  const double shadow_m = 20.0 / std::tan(radians_from_deg(5.0));
  EXPECT_TRUE(around.hold({50.0, -shadow_m + 0.1}, 0.0, 27.0));
  EXPECT_FALSE(around.hold({50.0, -shadow_m - 0.1}, 0.0, 27.0));
  EXPECT_FALSE(around.hold({-0.8 * shadow_m, -0.8 * shadow_m}, 0.0, 27.0)) << "farther across a corner";
  EXPECT_NEAR(around.reach(27.0).west_m, -shadow_m, 1e-9);
  EXPECT_EQ(around.reach(8.0).north_m, 150.0);
}

/// The paper's landscape and what of it matters to a square in its middle.
struct Landscape {
  scene::Scene scene = scene::paper_scene({.scale = 0.5});
  SceneHeights heights = heights_of(scene, Footing::Terrain);
  Surroundings around{.place = radar::widened(middle(), 60.0),
                      .near_m = 40.0,
                      .least_slope = std::tan(radians_from_deg(8.0)),
                      .lowest_m = heights.lowest_m};
  SceneGeometry whole{scene, Footing::Terrain}, part{scene, Footing::Terrain, around};

  [[nodiscard]] radar::Rectangle middle() const {
    const Vec2d centre = scene.extent.centre();
    return {centre.x, centre.y, centre.x, centre.y};
  }
  /// Somewhere on what stands in the square, from straight above; relative to its middle, as rays are.
  [[nodiscard]] Vec3f place(std::uint64_t number) const {
    const auto across = [&](std::uint64_t which) { return 120.0F * unit_float(hashed(number, which)) - 60.0F; };
    SurfaceHit hit;
    EXPECT_TRUE(whole.intersect({across(1), across(2), 200.0F}, {0.0F, 0.0F, -1.0F}, hit));
    return hit.position + Vec3f{0.0F, 0.0F, 0.05F};
  }
};

TEST(Surroundings, ARadarSeesOfThePlaceWhatItSeesOfTheWholeScene) {
  const Landscape land;
  EXPECT_LT(land.part.memory_bytes(), land.whole.memory_bytes() / 2);
  EXPECT_EQ(land.part.highest_m(), land.whole.highest_m());
  EXPECT_EQ(land.part.lowest_m(), land.whole.lowest_m());
  std::size_t hidden = 0;
  for (std::uint64_t number = 0; number < 20'000; ++number) {
    const Vec3f place = land.place(number);
    const double azimuth_rad = 2.0 * pi * static_cast<double>(unit_float(hashed(number, 3)));
    const double elevation_deg = 8.0 + 10.0 * static_cast<double>(unit_float(hashed(number, 4)));
    const Vec3f to_radar = radar::direction_to_radar({azimuth_rad, radians_from_deg(elevation_deg)}).to<float>();
    const bool is_hidden = land.whole.occluded(place, to_radar);
    hidden += is_hidden ? 1 : 0;
    ASSERT_EQ(land.part.occluded(place, to_radar), is_hidden) << number;
  }
  EXPECT_GT(hidden, 5'000U);
  EXPECT_LT(hidden, 15'000U);
}

TEST(Surroundings, HeightsThatAreKnownAreNotFoundAgain) {
  const Landscape land;
  const SceneHeights known{land.heights.lowest_m - 3.0, land.heights.highest_m + 5.0, land.heights.highest_ground_m};
  const SceneGeometry part(land.scene, Footing::Terrain, land.around, known);
  EXPECT_EQ(part.lowest_m(), known.lowest_m);
  EXPECT_EQ(part.highest_m(), known.highest_m);
  EXPECT_EQ(part.memory_bytes(), land.part.memory_bytes()) << "what is held goes by its own height";
  EXPECT_EQ(land.heights.highest_ground_m, land.scene.terrain.highest_m());
  EXPECT_EQ(heights_of(land.scene, Footing::LevelPlane).highest_ground_m, 0.0);
}

TEST(Surroundings, RaysMeetNearThePlaceWhatTheyMeetInTheWholeScene) {
  const Landscape land;
  const radar::Rectangle near = radar::widened({0.0, 0.0, 0.0, 0.0}, 60.0 + land.around.near_m - 10.0);
  std::size_t met = 0;
  for (std::uint64_t number = 0; number < 20'000; ++number) {
    const Vec3f place = land.place(number);
    const float up = 2.0F * unit_float(hashed(number, 5)) - 1.0F, turn = 6.2831853F * unit_float(hashed(number, 6));
    const float level = std::sqrt(1.0F - up * up);
    const Vec3f direction{level * std::cos(turn), level * std::sin(turn), up};
    SurfaceHit expected, hit;
    if (!land.whole.intersect(place, direction, expected)) continue;
    if (!near.contains({expected.position.x, expected.position.y})) continue;
    ++met;
    ASSERT_TRUE(land.part.intersect(place, direction, hit)) << number;
    ASSERT_EQ(hit.position, expected.position) << number;
    ASSERT_EQ(hit.normal, expected.normal) << number;
    ASSERT_EQ(hit.material, expected.material) << number;
    ASSERT_EQ(hit.inverse_facet_area_per_m2, expected.inverse_facet_area_per_m2) << number;
  }
  EXPECT_GT(met, 8'000U);
}

}  // namespace
}  // namespace sigmascape::trace
