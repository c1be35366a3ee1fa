#include "sigmascape/simulate/targets_seen.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "physics/level_scene.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::simulate {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr radar::Rectangle area{-200.0, -200.0, 200.0, 200.0};

radar::Target named_target(const std::string& name, Vec2d place) {
  radar::Target target;
  target.name = name;
  target.track = radar::Track::straight({place.x, place.y, 1.0});
  target.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
  return target;
}

/// 10 km south, 10° high.
radar::Radar from_the_south() {
  radar::Radar radar;
  radar.position = {0.0, -10e3, 10e3 * std::tan(radians_from_deg(10.0))};
  return radar;
}

/// A house of 20 m between 30 and 40 m north of the middle, and a crown of e⁻¹ in 10 m west of it.
radar::ObstacleMap house_and_crown() {
  radar::ObstacleMap map{.grid = {-100.0, 100.0, 2.0, 100, 100}, .obstacles = Array2D<radar::Obstacle>(100, 100)};
  for (std::size_t row = 30; row < 35; ++row) {
    for (std::size_t column = 0; column < 100; ++column) {
      map.obstacles(column, row) = column < 40 ? radar::Obstacle{.crown_top_m = 50.0F, .crown_extinction_per_m = 0.1F}
                                               : radar::Obstacle{.solid_top_m = 20.0F};
    }
  }
  return map;
}

TEST(TargetsSeen, tells_which_are_hidden_and_which_fade) {
  const terrain::HeightField level{
      .west_m = -500.0, .north_m = 500.0, .spacing_m = 10.0, .height_m = Array2D<float>(101, 101, 0.0F)};
  const radar::ObstacleMap obstacles = house_and_crown();
  const auto seen = [&](std::vector<radar::Target> targets) {
    return targets_in_map(targets, from_the_south(), area, level, &obstacles);
  };
  const auto open = named_target("open", {0.0, 0.0}), behind = named_target("behind", {20.0, 60.0}),
             among = named_target("among", {-60.0, 60.0}), far = named_target("far", {0.0, 300.0});

  EXPECT_EQ(seen({open}).count, 1U);
  EXPECT_THAT(seen({open, far}).warnings, IsEmpty());
  EXPECT_EQ(seen({behind}).count, 0U);
  EXPECT_THAT(seen({behind}).warnings,
              ElementsAre("target behind is hidden by ground or by what stands on it, and nothing of it is seen"));
  EXPECT_THAT(seen({far}).warnings, ElementsAre("target far stands beside what is mapped"));
  EXPECT_THAT(seen({far, far}).warnings, ElementsAre("all 2 targets stand beside what is mapped"));
  // 10 m over the ground on the way are 10.15 m, of e⁻¹ in 10 m.
  EXPECT_THAT(seen({among}).warnings, ElementsAre("target among is behind crowns, which leave 4.4 dB less of it"));

  const TargetsSeen of_all = seen({open, behind, among, far});
  EXPECT_EQ(of_all.count, 2U);
  EXPECT_THAT(of_all.warnings,
              ElementsAre("of 4 targets 1 (behind) is hidden by ground or by what stands on it, and nothing of it is "
                          "seen",
                          "of 4 targets 1 (among) is behind crowns, which leave 4.4 dB less of it"));
  // Pulses hold what stands beside the area too.
  const TargetsSeen of_pulses =
      targets_in_pulses(std::vector{open, behind, far}, from_the_south(), area, level, &obstacles);
  EXPECT_EQ(of_pulses.count, 2U);
  EXPECT_THAT(of_pulses.warnings, ElementsAre(::testing::HasSubstr("of 3 targets 1 (behind) is hidden")));
  EXPECT_THAT(seen({behind, behind, open}).warnings,
              ElementsAre("of 3 targets 2 (behind and behind) are hidden by ground or by what stands on it, and "
                          "nothing of them is seen"));
}

TEST(TargetsSeen, names_a_few_of_many) {
  std::vector<radar::Target> targets;
  for (const char* name : {"a", "b", "c", "d", "e"}) targets.push_back(named_target(name, {}));
  std::vector<const radar::Target*> told;
  const auto with = [&](std::size_t index) {
    told.push_back(&targets[index]);
    return names_of(told);
  };
  EXPECT_EQ(with(0), "a");
  EXPECT_EQ(with(1), "a and b");
  EXPECT_EQ(with(2), "a, b and c");
  EXPECT_EQ(with(3), "a, b, c and d");
  EXPECT_EQ(with(4), "a, b, c and 2 more");
}

TEST(TargetsSeen, of_a_traced_map_are_those_of_the_scene_too) {
  auto scene = physics_test::level_scene(scatter::Material{.name = "stone", .model = {}, .source = {}}, 400.0);
  scene.prototypes.push_back(scene::box_mesh({40.0F, 10.0F, 20.0F}, 0));
  scene.instances.push_back({});
  scene.point_targets.push_back(
      {.name = "reflector", .position = {0.0, 20.0}, .height_m = 1.0, .rcs_m2 = {1.0F, 1.0F, 0.0F, 1.0F}});
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  const std::vector<radar::Target> added{named_target("added", {0.0, -60.0})};
  const TargetsSeen seen = targets_in_traced(scene, geometry, added, from_the_south(), area);
  EXPECT_EQ(seen.count, 1U);
  EXPECT_THAT(seen.warnings, ElementsAre("of 2 targets 1 (reflector) is hidden by ground or by what stands on it, and "
                                         "nothing of it is seen"));
}

}  // namespace
}  // namespace sigmascape::simulate
