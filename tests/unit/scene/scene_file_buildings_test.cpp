// Features of building files that stand otherwise than they may have been meant, and files of many.
#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "unit/scene/made_up_place.h"

#include "sigmascape/scene/scene_file.h"

namespace sigmascape::scene {
namespace {

/// Corners of a ring of GeoJSON, in metres from the place's middle.
std::string ring(const std::vector<Vec2d>& corners) {
  std::string text;
  for (std::size_t i = 0; i <= corners.size(); ++i) {
    const Vec2d corner = corners[i % corners.size()];
    text += fmt::format("{}[{},{}]", i == 0 ? "" : ",", MadeUpPlace::east_of_origin_m + corner.x,
                        MadeUpPlace::north_of_origin_m + corner.y);
  }
  return "[" + text + "]";
}

std::string square(double west, double south, double side_m) {
  return ring({{west, south}, {west + side_m, south}, {west + side_m, south + side_m}, {west, south + side_m}});
}

TEST(SceneFileBuildings, WhatHasAirBeneathItIsTold) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(0, 0, 10, 10, R"("h":9,"building":"yes","min_height":"4")") + "," +
                     MadeUpPlace::house(20, 0, 30, 10, R"("h":9,"building":"yes","building:min_level":"2")") + "," +
                     MadeUpPlace::house(40, 0, 50, 10, R"("h":9,"building":"roof","min_height":"0")") + "," +
                     MadeUpPlace::house(60, 0, 70, 10, R"("h":9,"building":"bridge")") + "," +
                     MadeUpPlace::house(80, 0, 90, 10, R"("h":9,"building":"carport")") + "," +
                     MadeUpPlace::house(100, 0, 110, 10, R"("h":9,"building":"house")"));
  const Scene scene = place.read(houses_section);
  EXPECT_EQ(scene.buildings.items.size(), 6U);
  EXPECT_EQ(remark_count(scene, "buildings that begin above the ground"), 2U);
  EXPECT_EQ(remark_count(scene, "roofs and bridges"), 3U);
  const Scene without = place.read(houses_section +
                                   "where = \"building NOT IN ('roof', 'canopy', 'carport', 'bridge') AND "
                                   "(min_height IS NULL OR CAST(min_height AS float) = 0) AND "
                                   "(\\\"building:min_level\\\" IS NULL OR "
                                   "CAST(\\\"building:min_level\\\" AS float) = 0)\"\n");
  EXPECT_EQ(without.buildings.items.size(), 1U) << "as the page of the scene file says it";
}

// On a slope of 5 % the northern wall of 100 m of house stands 5 m deep in the ground.
TEST(SceneFileBuildings, RoofsBeneathTheGroundAreTold) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(0, 0, 20, 100, R"("h":4)") + "," +
                     MadeUpPlace::house(40, 0, 60, 100, R"("h":6)"));
  const Scene scene = place.read(houses_section);
  EXPECT_EQ(remark_count(scene, "buildings whose roof lies beneath the ground at a corner"), 1U);
}

TEST(SceneFileBuildings, ACourtyardAgainstTheOutlineIsNoFlaw) {
  const MadeUpPlace place;
  place.write_houses(R"({"type":"Feature","properties":{"h":5},"geometry":{"type":"Polygon","coordinates":[)" +
                     square(0, 0, 20) + "," + square(0, 5, 10) + "]}}");
  const Scene scene = place.read(houses_section, "[scene]\nstrict = true\n");
  EXPECT_EQ(scene.buildings.items.size(), 1U);
  EXPECT_EQ(remark_count(scene, "self-crossing"), 0U);
  EXPECT_EQ(remark_count(scene, "footprints whose rings touch"), 1U);
}

// A town drawn as one feature of which a tower stands over one house: all others stand on their own ground as before.
TEST(SceneFileBuildings, HousesOfATownThatIsOneFeatureStandWhereTheyStandByThemselves) {
  constexpr int side = 25;
  const MadeUpPlace place;
  std::string parts, houses;
  for (int i = 0; i < side; ++i) {
    for (int k = 0; k < side; ++k) {
      const double west = 10.0 * i - 100.0, south = 10.0 * k - 100.0;
      parts += (parts.empty() ? "[" : ",[") + square(west, south, 5) + "]";
      houses += MadeUpPlace::house(west, south, west + 5, south + 5, R"("h":6)") + ",";
    }
  }
  const std::string tower = MadeUpPlace::house(2, -2, 7, 3, R"("h":20)");
  const auto read = [&](const std::string& features) {
    place.write_houses(features + "," + tower);
    const Scene scene = place.read(houses_section + "max_flawed_share = 1\n");
    std::vector<float> footings_m;
    for (const Building& building : scene.buildings.items) footings_m.push_back(building.footing_m);
    std::ranges::sort(footings_m);
    return footings_m;
  };
  const auto of_houses = read(houses.substr(0, houses.size() - 1));
  const auto of_town = read(
      R"({"type":"Feature","properties":{"h":6},"geometry":{"type":"MultiPolygon","coordinates":[)" + parts + "]}}");
  EXPECT_EQ(of_houses.size(), 1U + side * side);
  EXPECT_EQ(of_town, of_houses);
}

}  // namespace
}  // namespace sigmascape::scene
