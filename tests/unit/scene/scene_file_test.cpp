#include "sigmascape/scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "unit/scene/made_up_place.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scene/scene_warnings.h"
#include "sigmascape/scene/tree_mesh.h"

namespace sigmascape::scene {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string trees_section =
    "[[trees]]\nfile = \"trees.csv\"\ncrs = \"EPSG:25830\"\nx = \"x\"\ny = \"y\"\nheight_attribute = \"h\"\n";

TEST(SceneFile, TerrainAndLandCoverLieNorthUp) {
  const MadeUpPlace place;
  const Scene scene = place.read();
  EXPECT_NEAR(scene.frame.latitude_deg(), 43.312, 0.01);
  EXPECT_NEAR(scene.terrain.height_at({0.0, 300.0}), 0.05 * 500.0, 0.1);
  EXPECT_EQ(material_at(scene, {0.0, -350.0}), "water");
  EXPECT_EQ(material_at(scene, {0.0, 0.0}), "grass");
  EXPECT_EQ(material_at(scene, {350.0, 300.0}), "forest");
  EXPECT_EQ(material_at(scene, {-350.0, 300.0}), "grass");
}

TEST(SceneFile, WaterIsLevelUpToItsShore) {
  const MadeUpPlace place;
  const Scene scene = place.read();
  const MaterialIndex water = static_cast<MaterialIndex>(
      std::ranges::find(scene.materials, "water", &scatter::Material::name) - scene.materials.begin());
  std::size_t cells = 0;
  for (std::size_t row = 0; row < scene.ground.grid.rows; ++row) {
    for (std::size_t column = 0; column < scene.ground.grid.columns; ++column) {
      if (scene.ground.material(column, row) != water) continue;
      const Vec2d centre = scene.ground.grid.centre_of(column, row);
      ASSERT_DOUBLE_EQ(scene.terrain.height_at(centre), 0.0);
      ASSERT_DOUBLE_EQ(scene.terrain.normal_at(centre).z, 1.0);
      ++cells;
    }
  }
  EXPECT_GT(cells, 1500U);
}

// An elevation model may hold nothing of the sea, and cliffs before it. A lake in the hills is of the same class.
TEST(SceneFile, SeaWithoutHeightsIsLevelledUnderCliffsAndALakeInTheHillsIsNot) {
  const MadeUpPlace place;
  const auto is_lake = [](double x, double y) { return std::hypot(x - 501'000.0, y - 4'795'650.0) < 50.0; };
  const auto is_sea = [](double y) { return y < MadeUpPlace::shore_m; };
  place.write("heights.asc", MadeUpPlace::grid.text([&](double x, double y) {
    return is_sea(y) || is_lake(x, y) ? std::nan("") : 40.0 + 0.05 * (y - MadeUpPlace::shore_m);
  }));
  place.write("cover.asc",
              MadeUpPlace::grid.text([&](double x, double y) { return is_sea(y) || is_lake(x, y) ? 80.0 : 30.0; }));
  const Scene scene = place.read();
  for (const double y_m : {-390.0, -300.0, -225.0}) EXPECT_EQ(scene.terrain.height_at({100.0, y_m}), 0.0) << y_m;
  EXPECT_EQ(remark_count(scene, "made up from"), 0U) << "the sea is level, and the lake small";
  EXPECT_NEAR(scene.terrain.height_at({0.0, 0.0}), 50.0, 0.2);
  EXPECT_NEAR(scene.terrain.height_at({-100.0, 250.0}), 62.5, 1.0);
}

std::vector<std::string> likely_mistakes(const Scene& scene) {
  std::vector<std::string> found;
  for (const Remark& remark : scene.remarks)
    if (remark.is_likely_a_mistake) found.push_back(remark.what);
  return found;
}

TEST(SceneFile, AnExtentBeyondTheRasterIsLikelyAMistake) {
  const MadeUpPlace place;
  const auto with_extent_to = [&](double east_m) {
    return place.read("", fmt::format("[scene]\n"
                                      "extent = {{west_m = 0, south_m = -300, east_m = {}, north_m = 100}}\n",
                                      east_m));
  };
  EXPECT_THAT(likely_mistakes(with_extent_to(400.0)), ::testing::IsEmpty());
  EXPECT_THAT(likely_mistakes(with_extent_to(700.0)),
              ::testing::Contains(HasSubstr("extent that reaches beyond the raster of heights")));
  EXPECT_EQ(remark_count(with_extent_to(700.0), "with holes"), 0U);
}

// The raster's rows run 6° aslant in the frame, some 9° east of the middle of its zone.
TEST(SceneFile, CornersBesideARasterThatLiesAslantAreNoHoles) {
  const MadeUpPlace place;
  const geo::AsciiGrid aslant{1'230'000.0, 4'830'000.0, 5.0, 60, 60};
  place.write("aslant.asc", aslant.text([](double, double) { return 40.0; }));
  const Scene scene =
      read_scene(place.write("aslant.toml",
                             "[scene]\nextent = {west_m = -150, south_m = -150, east_m = 150, north_m = 150}\n"
                             "[terrain]\nfile = \"aslant.asc\"\ncrs = \"EPSG:25830\"\nunit = \"m\"\n"));
  EXPECT_THAT(likely_mistakes(scene), ElementsAre(HasSubstr("extent that reaches beyond the raster")));
}

TEST(SceneFile, LargeHolesOfTheTerrainAreLikelyAMistakeAndSmallOnesAreNot) {
  const MadeUpPlace place;
  const auto with_hole_of = [&](double radius_m) {
    place.write("heights.asc", MadeUpPlace::grid.text([&](double x, double y) {
      return std::hypot(x - 501'100.0, y - 4'795'500.0) < radius_m ? std::nan("") : 40.0;
    }));
    return place.read();
  };
  // Of 0.8 km²: 1 % and 9 %.
  EXPECT_EQ(remark_count(with_hole_of(50.0), "with holes"), 0U);
  EXPECT_THAT(likely_mistakes(with_hole_of(150.0)), ::testing::Contains(HasSubstr("raster of heights with holes")));
}

TEST(SceneFile, WaterFarFromTheLevelStaysWhereItIs) {
  const MadeUpPlace place;
  const Scene scene = place.read("water_classes = [10]\n");
  EXPECT_NEAR(scene.terrain.height_at({350.0, 300.0}), 25.0, 0.2);
}

TEST(SceneFile, AMaterialThatNothingIsMadeOfMakesARemark) {
  const MadeUpPlace place;
  const Scene scene = place.read(
      "nodata_material = \"mine\"\n[materials.mine]\nbase = \"sand\"\n"
      "[materials.conrete]\nbase = \"concrete\"\n");
  ASSERT_EQ(scene.remarks.size(), 1U);
  EXPECT_TRUE(scene.remarks.front().is_likely_a_mistake);
  EXPECT_EQ(scene.remarks.front().what, "materials of the file that nothing is made of");
  EXPECT_THAT(scene.remarks.front().first, HasSubstr("[materials.conrete]"));
}

TEST(SceneFile, AWaterLevelThatLevelsNothingMakesARemark) {
  const MadeUpPlace place;
  EXPECT_TRUE(place.read().remarks.empty());
  const Scene scene = place.read("water_classes = [77]\n");
  ASSERT_FALSE(scene.remarks.empty());
  EXPECT_TRUE(std::ranges::any_of(scene.remarks, [](const Remark& remark) {
    return remark.is_likely_a_mistake && remark.what.find("water level that levels nothing") != std::string::npos;
  }));
}

// Latitude and longitude in the wrong order put the origin on the other side of the Earth.
TEST(SceneFile, AnOriginFarFromTheSceneIsRefused) {
  const MadeUpPlace place;
  EXPECT_NO_THROW(static_cast<void>(place.read("", "[scene]\norigin_lat_deg = 43.3\norigin_lon_deg = -2.9\n")));
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(place.read("", "[scene]\norigin_lat_deg = -2.98\norigin_lon_deg = 43.3\n"));
              }),
              AllOf(HasSubstr("scene.origin_lat_deg: lies "), HasSubstr(" km from the middle of the scene"),
                    HasSubstr("give latitude and longitude of a place within 300 km")));
}

TEST(SceneFile, ExtentAndSpacingAreAsWanted) {
  const MadeUpPlace place;
  const Scene scene = place.read("", "[scene]\nextent = {west_m = -100, south_m = -50, east_m = 200, north_m = 150}\n");
  EXPECT_NEAR(scene.extent.west_m, -100.0, 1e-9);
  EXPECT_NEAR(scene.extent.north_m, 150.0, 1e-9);
  EXPECT_NEAR(scene.extent.width_m(), 300.0, 10.0);
  EXPECT_NEAR(scene.terrain.height_at({0.0, 100.0}), 0.05 * 300.0, 0.1);
}

TEST(SceneFile, HeightsAreInTheStatedUnit) {
  const MadeUpPlace place;
  place.write("level.asc", MadeUpPlace::grid.text([](double, double) { return 100.0; }));
  const auto height_in = [&](const std::string& unit) {
    return read_scene(place.write("unit.toml", "[terrain]\nfile = \"level.asc\"\ncrs = \"EPSG:25830\"\n" + unit))
        .terrain.height_at({0.0, 0.0});
  };
  EXPECT_NEAR(height_in(""), 100.0, 1e-4);
  EXPECT_NEAR(height_in("unit = \"m\"\n"), 100.0, 1e-4);
  EXPECT_NEAR(height_in("unit = \"cm\"\n"), 1.0, 1e-4);
  EXPECT_NEAR(height_in("unit = \"ft\"\n"), 30.48, 1e-4);
  EXPECT_NEAR(height_in("unit = \"us-ft\"\n"), 30.48006, 1e-4);
}

TEST(SceneFile, HeightsOnAMapInFeetAreSaidToBeTakenForMetres) {
  const MadeUpPlace place;
  constexpr geo::AsciiGrid in_feet{1'000'000.0, 200'000.0, 50.0, 40, 40};
  place.write("new_york.asc", in_feet.text([](double, double) { return 100.0; }));
  const auto read_as = [&](const std::string& keys) {
    return read_scene(place.write("feet.toml", "[terrain]\nfile = \"new_york.asc\"\n" + keys));
  };
  const Scene silent = read_as("crs = \"EPSG:2263\"\n");
  EXPECT_NEAR(silent.terrain.height_at({0.0, 0.0}), 100.0, 1e-4);
  ASSERT_EQ(remark_count(silent, "without a unit of heights on a map in feet, taken to be in metres"), 1U);
  EXPECT_THAT(silent.remarks[0].first, HasSubstr("new_york.asc: band 1"));
  const Scene vertical = read_as("crs = \"EPSG:2263+6360\"\n");
  EXPECT_NEAR(vertical.terrain.height_at({0.0, 0.0}), 30.48006, 1e-4);
  EXPECT_TRUE(vertical.remarks.empty());
  EXPECT_TRUE(read_as("crs = \"EPSG:2263\"\nunit = \"m\"\n").remarks.empty());
}

TEST(SceneFile, BuildingsRiseToTheirHeightFromTheLowestGround) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(-20, 0, 20, 40, R"("h":12.5)"));
  const Scene scene = place.read(houses_section);
  ASSERT_EQ(scene.buildings.items.size(), 1U);
  EXPECT_NEAR(static_cast<double>(scene.buildings.items[0].footing_m), 0.05 * 200.0, 0.1);
  EXPECT_NEAR(tallest_object_m(scene), 12.5, 1e-5);
  for (const Vec3f& vertex : scene.buildings.mesh.vertices) EXPECT_TRUE(vertex.z == 0.0F || vertex.z == 12.5F);
}

// Blocks of a town may be one feature: of those that lie partly outside the parts within stand.
TEST(SceneFile, PartsOfABuildingAreInsideOrOutsideEachByItself) {
  const MadeUpPlace place;
  const auto square = [](double west, double south) {
    const double w = MadeUpPlace::east_of_origin_m + west, s = MadeUpPlace::north_of_origin_m + south;
    return fmt::format("[[[{0},{1}],[{2},{1}],[{2},{3}],[{0},{3}],[{0},{1}]]]", w, s, w + 20.0, s + 20.0);
  };
  place.write_houses(R"({"type":"Feature","properties":{"h":9},"geometry":{"type":"MultiPolygon","coordinates":[)" +
                     square(0, 0) + "," + square(100, 50) + "," + square(3000, 0) + "," + square(3100, 0) + "," +
                     square(3200, 0) + "]}}");
  const Scene scene = place.read(houses_section);
  EXPECT_EQ(remark_count(scene, "parts of buildings outside the scene"), 3U);
  float easternmost_m = -1e9F;
  for (const Vec3f& vertex : scene.buildings.mesh.vertices) easternmost_m = std::max(easternmost_m, vertex.x);
  EXPECT_NEAR(easternmost_m, 120.0F, 1.0F);
}

TEST(SceneFile, BuildingsUndergroundAreNotRaised) {
  const MadeUpPlace place;
  const auto raised = [&](const std::string& tags) {
    place.write_houses(MadeUpPlace::house(-20, 0, 0, 20, R"("h":null,)" + tags) + "," +
                       MadeUpPlace::house(40, 0, 60, 20, R"("h":9)"));
    const Scene scene = place.read(houses_section + "default_height_m = 7\n");
    EXPECT_EQ(scene.buildings.items.size() + remark_count(scene, "buildings underground, left out"), 2U) << tags;
    return scene.buildings.items.size() == 2;
  };
  EXPECT_FALSE(raised(R"("location":"underground")"));
  EXPECT_FALSE(raised(R"("location":"underground","layer":"-1","building:levels:underground":"3")"));
  EXPECT_FALSE(raised(R"("building:levels":"0","building:levels:underground":"2")"));
  EXPECT_FALSE(raised(R"("is_underground":true)")) << "as Overture Maps has it";
  EXPECT_TRUE(raised(R"("location":"outdoor","is_underground":false)"));
  EXPECT_TRUE(raised(R"("is_underground":"False")")) << "as tables say it";
  EXPECT_TRUE(raised(R"("layer":"-1")")) << "something passes over it";
  EXPECT_TRUE(raised(R"("building:levels:underground":"2")")) << "a cellar";
  EXPECT_TRUE(raised(R"("building:levels":"4","building:levels:underground":"2")"));
  EXPECT_TRUE(raised(R"("building:levels":"0","building:levels:underground":"1","roof:levels":"1")"));
  place.write_houses(
      MadeUpPlace::house(-20, 0, 0, 20, R"("h":3,"building:levels":"0","building:levels:underground":"2")"));
  EXPECT_EQ(place.read(houses_section).buildings.items.size(), 1U) << "with a height that is stated";
}

// OpenStreetMap has some buildings whose levels are counted from the ground down.
TEST(SceneFile, BuildingsOfLevelsBelowZeroAreUnderground) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(-20, 0, 0, 20, R"("h":null,"building:levels":"-1")") + "," +
                     MadeUpPlace::house(40, 0, 60, 20, R"("h":"4","building:levels":"-1")") + "," +
                     MadeUpPlace::house(80, 0, 99, 20, R"("h":null,"building:levels":"2")"));
  for (const char* const levels : {"levels_attribute = \"building:levels\"\n", ""}) {
    const Scene scene = place.read(houses_section + levels + "default_height_m = 7\n");
    EXPECT_EQ(scene.buildings.items.size(), 2U) << "those of a height or of levels above the ground";
    EXPECT_EQ(remark_count(scene, "buildings underground, left out"), 1U);
  }
}

// On a slope of 5 % a roof that a tower stands through is as level as one that nothing stands through.
TEST(SceneFile, PiecesOfABuildingStandOnTheGroundOfTheWhole) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(0, -100, 20, 100, R"("h":6)") + "," +
                     MadeUpPlace::house(-5, -10, 25, 10, R"("h":20)"));
  const Scene scene = place.read(houses_section + "max_flawed_share = 1\n");
  std::vector<double> footings_m;
  for (const Building& building : scene.buildings.items) footings_m.push_back(static_cast<double>(building.footing_m));
  EXPECT_THAT(footings_m, ElementsAre(DoubleNear(5.0, 0.1), DoubleNear(5.0, 0.1), DoubleNear(9.5, 0.1)));
}

TEST(SceneFile, AFileOfBuildingsUndergroundAloneMakesARemark) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(-20, 0, 0, 20, R"("h":9,"location":"underground")"));
  const Scene scene = place.read(houses_section);
  ASSERT_EQ(remark_count(scene, "buildings underground, left out, so that nothing of the file is used"), 1U);
  EXPECT_TRUE(scene.remarks.back().is_likely_a_mistake);
}

float top_m(const Scene& scene, std::size_t building) {
  return scene.buildings.mesh.vertices[scene.buildings.items.at(building).first_vertex + 1].z;
}

TEST(SceneFile, LevelsAndDefaultStandInForHeights) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(-20, 0, 0, 20, R"("h":null,"levels":"4")") + "," +
                     MadeUpPlace::house(40, 0, 60, 20, R"("h":"30 ft","levels":null)") + "," +
                     MadeUpPlace::house(80, 0, 99, 20, R"("h":null,"levels":null)"));
  const Scene scene =
      place.read(houses_section + "levels_attribute = \"levels\"\nmetres_per_level = 3\ndefault_height_m = 7\n");
  ASSERT_EQ(scene.buildings.items.size(), 3U);
  EXPECT_FLOAT_EQ(top_m(scene, 0), 12.0F);
  EXPECT_FLOAT_EQ(top_m(scene, 1), 9.144F);
  EXPECT_FLOAT_EQ(top_m(scene, 2), 7.0F);
  EXPECT_EQ(remark_count(scene, "without a height"), 1U);
}

// A house of 100 ft, one that says of itself that it has 12 m, one of two storeys.
TEST(SceneFile, PlainHeightsOfBuildingsAreInTheStatedUnit) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(-20, 0, 0, 20, R"("h":"100","levels":null)") + "," +
                     MadeUpPlace::house(40, 0, 60, 20, R"("h":"12 m","levels":null)") + "," +
                     MadeUpPlace::house(80, 0, 99, 20, R"("h":null,"levels":"2")"));
  const std::string section = houses_section + "levels_attribute = \"levels\"\nmetres_per_level = 3\n";
  for (const auto& [unit, metres] :
       {std::pair{"m", 100.0F}, std::pair{"cm", 1.0F}, std::pair{"ft", 30.48F}, std::pair{"us-ft", 30.480061F}}) {
    const Scene scene = place.read(section + "unit = \"" + unit + "\"\n");
    ASSERT_EQ(scene.buildings.items.size(), 3U) << unit;
    EXPECT_FLOAT_EQ(top_m(scene, 0), metres) << unit;
    EXPECT_EQ(top_m(scene, 1), 12.0F) << unit;
    EXPECT_EQ(top_m(scene, 2), 6.0F) << unit;
  }
  const Scene silent = place.read(section);
  EXPECT_EQ(top_m(silent, 0), 100.0F);
  EXPECT_EQ(scene_hash(silent), scene_hash(place.read(section + "unit = \"m\"\n")));
}

TEST(SceneFile, PlainHeightsAndCrownsOfTreesAreInTheStatedUnit) {
  const MadeUpPlace place;
  place.write("trees.csv", "x,y,h,r\n501100,4795500,50,10\n501200,4795500,15 m,3 m\n");
  const std::string section = trees_section + "crown_radius_attribute = \"r\"\n";
  const auto is_as_tall_and_wide = [](const Instance& tree, double height_m, double radius_m) {
    EXPECT_NEAR(static_cast<double>(tree.scale.z * tree_height_m), height_m, 1e-4);
    EXPECT_NEAR(static_cast<double>(tree.scale.x * tree_crown_radius_m), radius_m, 1e-4);
  };
  const Scene in_feet = place.read(section + "unit = \"ft\"\n");
  ASSERT_EQ(in_feet.instances.size(), 2U);
  is_as_tall_and_wide(in_feet.instances[0], 15.24, 3.048);
  is_as_tall_and_wide(in_feet.instances[1], 15.0, 3.0);
  EXPECT_EQ(scene_hash(place.read(section)), scene_hash(place.read(section + "unit = \"m\"\n")));
  EXPECT_NE(scene_hash(place.read(section)), scene_hash(in_feet));
}

TEST(SceneFile, DecimalCommasCountAndDoubtfulOnesAreTold) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(-20, 0, 0, 20, R"("h":"3,5")") + "," +
                     MadeUpPlace::house(40, 0, 60, 20, R"("h":"1,234")"));
  const Scene scene = place.read(houses_section + "default_height_m = 7\n");
  ASSERT_EQ(scene.buildings.items.size(), 2U);
  EXPECT_EQ(top_m(scene, 0), 3.5F);
  EXPECT_EQ(top_m(scene, 1), 7.0F);
  EXPECT_EQ(remark_count(scene, "buildings without a height, given 7 m"), 1U);
  const auto told = std::ranges::find(
      scene.remarks, "values of h whose comma may part decimals or thousands, passed over", &Remark::what);
  ASSERT_NE(told, scene.remarks.end());
  EXPECT_EQ(told->count, 1U);
  EXPECT_THAT(told->first, HasSubstr("feature 1 (1,234)"));
}

TEST(SceneFile, AColumnThatIsEmptyThroughoutIsThere) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(-20, 0, 0, 20, R"("h":null)"));
  const Scene scene = place.read(houses_section + "default_height_m = 7\n");
  ASSERT_EQ(scene.buildings.items.size(), 1U);
  EXPECT_EQ(top_m(scene, 0), 7.0F);
}

TEST(SceneFile, TreesStandOnTheTerrainAndNotInWater) {
  const MadeUpPlace place;
  place.write("trees.csv",
              "x,y,ground,h,r\n501100,4795500,999,20,4\n501200,4795500,999,10,2\n501100,4795100,999,15,3\n");
  const Scene scene = place.read(trees_section + "crown_radius_attribute = \"r\"\n");
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene.instances[0].lift_m, 0.0F);
  EXPECT_NEAR(static_cast<double>(scene.instances[0].scale.z * tree_height_m), 20.0, 1e-4);
  EXPECT_NEAR(static_cast<double>(scene.instances[0].scale.x * tree_crown_radius_m), 4.0, 1e-4);
  EXPECT_NEAR(static_cast<double>(scene.instances[0].y_m), 100.0, 0.5);
  EXPECT_EQ(remark_count(scene, "trees standing in water"), 1U);
}

TEST(SceneFile, GroundBeneathExplicitObjectsIsNotTheAggregate) {
  const MadeUpPlace place;
  place.write("trees.csv", "x,y,h\n501400,4795700,20\n");
  EXPECT_EQ(material_at(place.read(trees_section), {350.0, 300.0}), "forest_floor");
  EXPECT_EQ(material_at(place.read("scatter_as = \"aggregate\"\n" + trees_section), {350.0, 300.0}), "forest");
  EXPECT_EQ(material_at(place.read("scatter_as = \"ground\"\n"), {350.0, 300.0}), "forest_floor");
  EXPECT_EQ(material_at(place.read("[land_cover.classes]\n10 = \"snow\"\n"), {350.0, 300.0}), "snow");
}

const char* const one_road =
    R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25830"}},"features":[
  {"type":"Feature","properties":{"highway":"primary"},"geometry":{"type":"LineString","coordinates":[[500700,4795500],[501500,4795500]]}}]})";

TEST(SceneFile, RoadsArePavedStripsOfTheirWidth) {
  const MadeUpPlace place;
  place.write("roads.geojson", one_road);
  const Scene scene = place.read(
      "cell_m = 1\n[[roads]]\nfile = \"roads.geojson\"\nclass_attribute = "
      "\"highway\"\n[roads.width_m_by_class]\nprimary = 20\n");
  EXPECT_EQ(material_at(scene, {0.0, 100.0}), "asphalt");
  EXPECT_EQ(material_at(scene, {0.0, 108.0}), "asphalt");
  EXPECT_EQ(material_at(scene, {0.0, 92.0}), "asphalt");
  EXPECT_EQ(material_at(scene, {0.0, 112.0}), "grass");
  EXPECT_EQ(material_at(scene, {-450.0, 100.0}), "grass");
}

/// Each carriageway of a motorway is a line of OpenStreetMap's, on which nobody comes the other way.
TEST(SceneFile, RoadsOfOneWayAreHalfAMotorwayAndAllGoThatWay) {
  const MadeUpPlace place;
  for (const auto& [way, eastwards, westwards] : {std::tuple("no", true, true),
                                                  {"yes", true, false},
                                                  {"-1", false, true},
                                                  {"reverse", false, true},
                                                  {"reversible", true, true},
                                                  {"alternating", true, true},
                                                  {"1.000", true, false},
                                                  {"f", true, true},
                                                  {"B", true, true},
                                                  {"F", true, false},
                                                  {"T", false, true}}) {
    std::string road = one_road;
    road.replace(road.find("\"primary\""), 9, fmt::format("\"motorway\",\"oneway\":\"{}\"", way));
    place.write("roads.geojson", road);
    const Scene scene = place.read(
        "cell_m = 1\n[[roads]]\nfile = \"roads.geojson\"\nclass_attribute = \"highway\"\n"
        "[roads.traffic]\nmoving_per_km = 60\n");
    EXPECT_EQ(material_at(scene, {0.0, 108.0}), eastwards && westwards ? "asphalt" : "grass") << way;
    EXPECT_EQ(material_at(scene, {0.0, 104.0}), "asphalt") << way;
    const auto goes = [&](double yaw_rad) {
      return std::ranges::any_of(scene.instances, [&](const Instance& vehicle) {
        return std::abs(std::remainder(static_cast<double>(vehicle.yaw_rad) - yaw_rad, 2.0 * pi)) < 0.1;
      });
    };
    EXPECT_EQ(goes(pi / 2.0), eastwards) << way;
    EXPECT_EQ(goes(-pi / 2.0), westwards) << way;
  }
}

TEST(SceneFile, OneWaysOfNoKnownMeaningAreTold) {
  const MadeUpPlace place;
  for (const auto& [way, told] : {std::pair{"sometimes", 1U}, {"2", 1U}, {"no", 0U}, {"False", 0U}, {"0", 0U}}) {
    std::string road = one_road;
    road.replace(road.find("\"primary\""), 9, fmt::format("\"motorway\",\"oneway\":\"{}\"", way));
    place.write("roads.geojson", road);
    const Scene scene = place.read("cell_m = 1\n[[roads]]\nfile = \"roads.geojson\"\nclass_attribute = \"highway\"\n");
    EXPECT_EQ(remark_count(scene, "roads whose oneway is of no known meaning, taken for both ways"), told) << way;
    EXPECT_EQ(material_at(scene, {0.0, 108.0}), "asphalt") << way;
  }
}

TEST(SceneFile, PlainWidthsOfRoadsAreInTheStatedUnit) {
  const MadeUpPlace place;
  std::string road = one_road;
  place.write("roads.geojson", road.replace(road.find("primary"), 7, "40"));
  const std::string section = "cell_m = 1\n[[roads]]\nfile = \"roads.geojson\"\nwidth_attribute = \"highway\"\n";
  EXPECT_EQ(material_at(place.read(section), {0.0, 115.0}), "asphalt");
  const Scene in_feet = place.read(section + "unit = \"ft\"\n");
  EXPECT_EQ(material_at(in_feet, {0.0, 105.0}), "asphalt");
  EXPECT_EQ(material_at(in_feet, {0.0, 108.0}), "grass");
}

TEST(SceneFile, RoadsInTunnelsAreNotPaved) {
  const MadeUpPlace place;
  for (const auto& [tunnel, material] : {std::pair{"yes", "grass"},
                                         {"building_passage", "grass"},
                                         {"no", "asphalt"},
                                         {"0.000000000000000", "asphalt"},
                                         {"1.000", "grass"}}) {
    std::string road = one_road;
    road.replace(road.find("\"primary\""), 9, std::string("\"primary\",\"tunnel\":\"") + tunnel + "\"");
    place.write("roads.geojson", road);
    const Scene scene = place.read("cell_m = 1\n[[roads]]\nfile = \"roads.geojson\"\nwidth_m = 20\n");
    EXPECT_EQ(material_at(scene, {0.0, 100.0}), material) << tunnel;
    EXPECT_EQ(remark_count(scene, "roads in tunnels"), material == std::string("grass") ? 1U : 0U) << tunnel;
    // Where all of them are, the file was hardly meant to be like that.
    EXPECT_EQ(warnings_of(scene).empty(), material == std::string("asphalt")) << tunnel;
  }
}

/// A list of a whole city: 3 % of it is without a place, and more than that than lies in the scene.
TEST(SceneFile, FeaturesWithoutAPlaceAreAShareOfTheWholeFile) {
  const MadeUpPlace place;
  std::string trees = "x,y,h\n";
  for (int i = 0; i < 20; ++i) trees += fmt::format("{},4795500,10\n", 501100 + 10 * i);
  for (int i = 0; i < 950; ++i) trees += "590000,4795500,10\n";
  for (int i = 0; i < 30; ++i) trees += ",,10\n";
  place.write("trees.csv", trees);
  const Scene scene = place.read(trees_section);
  EXPECT_EQ(scene.instances.size(), 20U);
  EXPECT_EQ(remark_count(scene, "features without usable coordinates"), 30U);
  EXPECT_NE(place.fault(trees_section + "max_flawed_share = 0.02\n"), "");
}

/// Codes of another table than ESA WorldCover's, whose water is water and whose other codes keep what is built in.
TEST(SceneFile, TablesOfLandCoverOfTheirOwnTellWhatIsWater) {
  const MadeUpPlace place;
  place.write("trees.csv", "x,y,h\n501100,4795500,10\n");
  const Scene scene =
      place.read("[land_cover.classes]\n30 = \"water\"\n80 = \"crops\"\n" + trees_section + "max_flawed_share = 1\n");
  EXPECT_EQ(scene.instances.size(), 0U);
  EXPECT_GT(remark_count(scene, "classes that [land_cover.classes] does not list"), 0U);
  EXPECT_EQ(remark_count(place.read(), "does not list"), 0U);
}

TEST(SceneFile, WaterOfAnyMaterialIsWater) {
  const MadeUpPlace place;
  place.write("trees.csv", "x,y,h\n501100,4795500,10\n501100,4795100,10\n");
  const auto is_water = [&](const std::string& material, const std::string& its_section = "") {
    const Scene scene = place.read("[land_cover.classes]\n80 = \"" + material + "\"\n" + trees_section + its_section);
    EXPECT_EQ(material_at(scene, {0.0, -350.0}), material);
    const bool levelled = scene.terrain.height_at({0.0, -350.0}) == 0.0;
    EXPECT_EQ(remark_count(scene, "trees standing in water"), levelled ? 1U : 0U) << material;
    return levelled;
  };
  EXPECT_TRUE(is_water("sea_water"));
  EXPECT_TRUE(is_water("fresh_water"));
  EXPECT_TRUE(is_water("calm", "[materials.calm]\nbase = \"water\"\ngamma_db = -45\n"));
  EXPECT_TRUE(is_water("salty", "[materials.salty]\nbase = \"fresh_water\"\nwater = {salinity_g_per_kg = 9}\n"));
  EXPECT_TRUE(is_water("own", "[materials.own]\nmodel = \"cook_torrance\"\nwater = {}\n"));
  EXPECT_FALSE(is_water("wet", "[materials.wet]\nmodel = \"cook_torrance\"\nsoil = {moisture = 0.4}\n"));
  EXPECT_FALSE(is_water("crops"));
}

TEST(SceneFile, RoadsUnderCoverAreNotPaved) {
  const MadeUpPlace place;
  for (const auto& [covered, material] : {std::pair{"yes", "grass"}, {"arcade", "grass"}, {"no", "asphalt"}}) {
    std::string road = one_road;
    road.replace(road.find("\"primary\""), 9, std::string("\"primary\",\"covered\":\"") + covered + "\"");
    place.write("roads.geojson", road);
    const Scene scene = place.read("cell_m = 1\n[[roads]]\nfile = \"roads.geojson\"\nwidth_m = 20\n");
    EXPECT_EQ(material_at(scene, {0.0, 100.0}), material) << covered;
    EXPECT_EQ(remark_count(scene, "roads under cover"), material == std::string("grass") ? 1U : 0U) << covered;
  }
}

TEST(SceneFile, RoadsOutsideTheSceneAreCounted) {
  const MadeUpPlace place;
  std::string two_roads = one_road;
  two_roads.insert(two_roads.rfind("]}"), R"(,{"type":"Feature","properties":{"highway":"primary"},"geometry":
    {"type":"LineString","coordinates":[[509000,4795500],[509500,4795500]]}})");
  place.write("roads.geojson", two_roads);
  const Scene scene = place.read("[[roads]]\nfile = \"roads.geojson\"\nwidth_m = 20\n");
  EXPECT_EQ(remark_count(scene, "roads outside the scene, left out"), 1U);
  EXPECT_EQ(remark_count(scene, "nothing of the file is used"), 0U);
}

TEST(SceneFile, FilesWhollyOutsideTheSceneMakeARemark) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(3000, 0, 3020, 20, R"("h":9)") + "," +
                     MadeUpPlace::house(4000, 0, 4020, 20, R"("h":9)"));
  place.write("trees.csv", "x,y,h\n509000,4795500,10\n");
  std::string road = one_road;
  road.replace(road.find("[[500700,4795500],[501500,4795500]]"), 35, "[[509000,4795500],[509500,4795500]]");
  place.write("roads.geojson", road);
  place.write("mast.obj", "v 0 0 0\nv 1 0 0\nv 0 0 9\nf 1 2 3\n");
  const Scene scene = place.read(houses_section + trees_section +
                                 "[[roads]]\nfile = \"roads.geojson\"\nwidth_m = 20\n"
                                 "[[meshes]]\nfile = \"mast.obj\"\nmaterial = \"metal\"\npositions_m = [[5000, 0]]\n");
  const std::string nothing = " outside the scene, left out, so that nothing of the file is used";
  EXPECT_EQ(remark_count(scene, "buildings" + nothing), 2U);
  EXPECT_EQ(remark_count(scene, "trees" + nothing), 1U);
  EXPECT_EQ(remark_count(scene, "roads" + nothing), 1U);
  EXPECT_EQ(remark_count(scene, "meshes" + nothing), 1U);
  EXPECT_TRUE(std::ranges::all_of(scene.remarks, &Remark::is_likely_a_mistake));
}

/// Two roads and a stream of OpenStreetMap through the middle of the place.
const char* const mapped_ways = R"(<osm version="0.6">
  <node id="1" lat="43.31143" lon="-2.990"/><node id="2" lat="43.31143" lon="-2.982"/>
  <way id="10"><nd ref="1"/><nd ref="2"/><tag k="highway" v="primary"/><tag k="lanes" v="2"/></way>
  <way id="11"><nd ref="1"/><nd ref="2"/><tag k="highway" v="service"/></way>
  <way id="12"><nd ref="1"/><nd ref="2"/><tag k="waterway" v="stream"/><tag k="location" v="underground"/></way></osm>)";

TEST(SceneFile, ConditionsOnTagsThatNothingCarriesMakeRemarks) {
  const MadeUpPlace place;
  place.write("roads.osm", mapped_ways);
  const auto scene_where = [&](const std::string& condition) {
    return place.read("[[roads]]\nfile = \"roads.osm\"\nwidth_m = 20\nwhere = '''" + condition + "'''\n");
  };
  const auto remark_on = [](const Scene& scene, const std::string& tag) {
    const auto found =
        std::ranges::find(scene.remarks, "conditions on the tag " + tag + ", which no feature carries", &Remark::what);
    if (found == scene.remarks.end()) return std::string();
    EXPECT_TRUE(found->is_likely_a_mistake);
    return found->first;
  };
  EXPECT_THAT(remark_on(scene_where(R"(highway = "primary")"), "primary"),
              HasSubstr(R"(roads.osm: where = "highway = "primary"" (a text stands in single quotes: 'primary'))"));
  EXPECT_THAT(remark_on(scene_where("highway = 'primary' OR highwy IS NULL"), "highwy"),
              HasSubstr("(did you mean highway?)"));
  const Scene overground = scene_where("location IS NULL OR location <> 'underground'");
  EXPECT_EQ(material_at(overground, {0.0, 0.0}), "asphalt") << "and no error";
  EXPECT_THAT(remark_on(overground, "location"), HasSubstr("roads.osm: where ="));
  EXPECT_TRUE(scene_where("highway = 'primary' AND lanes = '2'").remarks.empty());
}

TEST(SceneFile, FeaturesWithoutTheTagOfOthersMakeARemarkUnlessTheConditionTells) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(-20, 0, 20, 40, R"("h":12.5,"building":"yes")") + "," +
                     MadeUpPlace::house(100, 0, 140, 40, R"("h":12.5,"building":"no")") + "," +
                     MadeUpPlace::house(200, 0, 240, 40, R"("h":12.5,"landuse":"grass")"));
  const auto remark_on = [&](const std::string& more) {
    const Scene scene = place.read(houses_section + more);
    const auto found = std::ranges::find_if(scene.remarks, [](const Remark& remark) {
      return remark.what.starts_with("features without the tag building");
    });
    return found == scene.remarks.end() ? Remark{} : *found;
  };
  const Remark told = remark_on("");
  EXPECT_EQ(told.count, 2U);
  EXPECT_TRUE(told.is_likely_a_mistake);
  EXPECT_THAT(told.what, HasSubstr("(where = \"building <> '' AND building <> 'no'\" leaves them out)"));
  EXPECT_THAT(told.first, HasSubstr("houses.geojson: layer houses, feature 1"));
  EXPECT_EQ(remark_on("where = \"building <> '' AND building <> 'no'\"\n").count, 0U);
  EXPECT_EQ(place.read(houses_section + "where = \"building <> '' AND building <> 'no'\"\n").buildings.items.size(),
            1U);
  EXPECT_EQ(remark_on("where = \"building IS NULL OR h > 0\"\n").count, 0U) << "meant so";
}

TEST(SceneFile, LawnsOfAConvertedExtractAreNoBuildings) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(-20, 0, 20, 40, R"("osm_way_id":"1","h":12.5,"building":"yes")") + "," +
                     MadeUpPlace::house(-300, -300, 300, 300, R"("osm_way_id":"2","landuse":"grass")"));
  const Scene scene = place.read(houses_section + "default_height_m = 6\n");
  EXPECT_EQ(remark_count(scene, "features of OpenStreetMap without the tag building, left out"), 1U);
  EXPECT_TRUE(warnings_of(scene).empty());
  EXPECT_EQ(scene.buildings.items.size(), 1U);
}

TEST(SceneFile, FilesWithoutWhatIsAskedForMakeARemark) {
  const MadeUpPlace place;
  place.write_houses(MadeUpPlace::house(-20, 0, 20, 40, R"("h":12.5)"));
  const Scene scene = place.read(houses_section + "where = \"h > 100\"\n");
  ASSERT_EQ(remark_count(scene, "files without a feature that is asked for, of which nothing is used"), 1U);
  EXPECT_THAT(scene.remarks.back().first, HasSubstr("houses.geojson: none meets where = \"h > 100\""));
  EXPECT_EQ(remark_count(place.read(houses_section), "files without"), 0U);
}

TEST(SceneFile, RoadsStayNarrowWithoutLandCover) {
  const MadeUpPlace place;
  place.write("roads.geojson", one_road);
  const Scene scene =
      read_scene(place.write("bare.toml",
                             "[terrain]\nfile = \"heights.asc\"\ncrs = \"EPSG:25830\"\n[land_cover]\ncell_m = 2\n"
                             "[[roads]]\nfile = \"roads.geojson\"\nwidth_m = 8\n"));
  EXPECT_EQ(material_at(scene, {0.0, 100.0}), "asphalt");
  EXPECT_EQ(material_at(scene, {0.0, 110.0}), "grass");
}

TEST(SceneFile, TrafficHasTheStatedDensityAndKeepsToItsSide) {
  const MadeUpPlace place;
  place.write("roads.geojson", one_road);
  const std::string section =
      "[[roads]]\nfile = \"roads.geojson\"\nwidth_m = 12\n[roads.traffic]\nmoving_per_km = 60\nspeed_kmh = 36\n";
  const Scene scene = place.read(section);
  EXPECT_NEAR(static_cast<double>(scene.instances.size()), 60.0 * 0.8, 21.0);
  for (const Instance& vehicle : scene.instances) {
    const bool eastward = std::abs(vehicle.yaw_rad - 1.5708F) < 0.01F;
    // Driving on the right, eastward traffic keeps to the south of the middle line at y = 100 m.
    EXPECT_NEAR(static_cast<double>(vehicle.y_m), eastward ? 97.0 : 103.0, 0.5);
    EXPECT_FLOAT_EQ(vehicle.speed_mps, 10.0F);
  }
  EXPECT_EQ(scene_hash(scene), scene_hash(place.read(section)));
  EXPECT_NE(scene_hash(scene), scene_hash(place.read(section + "seed = 2\n")));
}

// On a road of six metres a lane and the cars along its kerb need the same room.
TEST(SceneFile, NoVehicleStandsWithinAnother) {
  const MadeUpPlace place;
  place.write("roads.geojson", one_road);
  const Scene scene = place.read(
      "[[roads]]\nfile = \"roads.geojson\"\nwidth_m = 6\n[roads.traffic]\nmoving_per_km = 60\nparked_per_km = 120\n");
  std::vector<radar::Rectangle> taken;  // the road runs from west to east
  std::size_t moving = 0;
  for (const Instance& vehicle : scene.instances) {
    float half_length_m = 0.0F, half_width_m = 0.0F;
    for (const Vec3f vertex : scene.prototypes[vehicle.prototype].vertices) {
      half_length_m = std::max(half_length_m, std::abs(vertex.y));
      half_width_m = std::max(half_width_m, std::abs(vertex.x));
    }
    taken.push_back({static_cast<double>(vehicle.x_m - half_length_m), static_cast<double>(vehicle.y_m - half_width_m),
                     static_cast<double>(vehicle.x_m + half_length_m),
                     static_cast<double>(vehicle.y_m + half_width_m)});
    moving += vehicle.speed_mps > 0.0F ? 1 : 0;
  }
  EXPECT_GT(moving, 10U);
  EXPECT_GT(taken.size() - moving, 50U);
  for (std::size_t a = 0; a < taken.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const bool apart = taken[a].east_m < taken[b].west_m || taken[b].east_m < taken[a].west_m ||
                         taken[a].north_m < taken[b].south_m || taken[b].north_m < taken[a].south_m;
      EXPECT_TRUE(apart) << "vehicles " << b << " and " << a;
    }
  }
}

TEST(SceneFile, AMaterialOfTheFileComesBeforeTheLibrarysOfAShorterName) {
  const MadeUpPlace place;
  place.write("mast.obj", "v 0 0 0\nv 1 0 0\nv 0 0 9\nusemtl itu_metal\nf 1 2 3\nusemtl itu_old\nf 1 3 2\n");
  const Scene scene = place.read(
      "[[meshes]]\nfile = \"mast.obj\"\npositions_m = [[10, 20]]\n[materials.itu_metal]\nbase = \"concrete\"\n"
      "[materials.itu_old]\nbase = \"brick\"\n");
  ASSERT_EQ(scene.instances.size(), 1U);
  const Mesh& mast = scene.prototypes[scene.instances[0].prototype];
  EXPECT_EQ(scene.materials[mast.materials[0]].name, "itu_metal");
  EXPECT_EQ(scene.materials[mast.materials[1]].name, "itu_old");
}

TEST(SceneFile, MeshesStandWhereTheyShouldWithTheirMaterials) {
  const MadeUpPlace place;
  place.write("mast.obj", "v 0 0 0\nv 1 0 0\nv 0 0 9\nusemtl itu_metal\nf 1 2 3\nusemtl paint\nf 1 3 2\n");
  const Scene scene = place.read(
      "[[meshes]]\nfile = \"mast.obj\"\nscale = 2\nyaw_deg = 90\npositions_m = [[10, 20], [5000, "
      "0]]\n[meshes.materials]\npaint = \"wood\"\n");
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_NEAR(static_cast<double>(scene.instances[0].yaw_rad), M_PI / 2.0, 1e-6);
  EXPECT_NEAR(tallest_object_m(scene), 18.0, 1e-5);
  const Mesh& mast = scene.prototypes[scene.instances[0].prototype];
  EXPECT_EQ(scene.materials[mast.materials[0]].name, "metal");
  EXPECT_EQ(scene.materials[mast.materials[1]].name, "wood");
  EXPECT_EQ(remark_count(scene, "meshes outside the scene"), 1U);
}

// A sheet is porous by its edges; what is stated counts instead, and is part of what the scene is.
TEST(SceneFile, MeshesAreSolidAsStated) {
  const MadeUpPlace place;
  place.write("roof.obj", "v -5 -5 4\nv 5 -5 4\nv 5 5 4\nv -5 5 4\nf 1 2 3 4\n");
  const std::string roof = "[[meshes]]\nfile = \"roof.obj\"\nmaterial = \"metal\"\npositions_m = [[0, 100]]\n";
  const Scene silent = place.read(roof), solid = place.read(roof + "solid = true\n"),
              porous = place.read(roof + "solid = false\n");
  EXPECT_EQ(silent.prototypes.back().is_solid, std::nullopt);
  EXPECT_EQ(solid.prototypes.back().is_solid, true);
  EXPECT_EQ(porous.prototypes.back().is_solid, false);
  EXPECT_NE(scene_hash(silent), scene_hash(solid));
  EXPECT_NE(scene_hash(porous), scene_hash(solid));
}

/// A village of which nobody has told the heights.
TEST(SceneFile, TagsOfOpenStreetMapThatNothingCarriesAreLikelyMistakes) {
  const MadeUpPlace place;
  place.write("roads.osm", mapped_ways);
  const Scene scene = place.read("[[roads]]\nfile = \"roads.osm\"\nwidth_m = 20\nwidth_attribute = \"width\"\n");
  EXPECT_THAT(warnings_of(scene), ElementsAre(AllOf(HasSubstr("tags that no feature carries"), HasSubstr("width"))));
  place.write("roads.geojson", one_road);
  EXPECT_THAT(place.fault("[[roads]]\nfile = \"roads.geojson\"\nwidth_m = 20\nwidth_attribute = \"width\"\n"),
              HasSubstr("has the attribute 'width'"));
}

/// Before the raster is opened, and whether a feature comes or not.
TEST(SceneFile, UnknownReferencesAreRefusedBeforeAnythingIsRead) {
  const MadeUpPlace place;
  place.write("heights.asc", "no raster");
  place.write("roads.geojson", one_road);
  EXPECT_THAT(place.fault("[[roads]]\nfile = \"roads.geojson\"\nwidth_m = 20\ncrs = \"EPSG:999999\"\n"),
              HasSubstr("roads[1].crs"));
}

TEST(SceneFile, MeshesWithoutUsableCoordinatesAreCounted) {
  const MadeUpPlace place;
  place.write("mast.obj", "v 0 0 0\nv 1 0 0\nv 0 0 9\nf 1 2 3\n");
  place.write("masts.csv", "x,y\n501100,4795500\n501200,4795500\n501150,inf\n");
  const std::string masts =
      "[[meshes]]\nfile = \"mast.obj\"\nmaterial = \"metal\"\n"
      "positions = {file = \"masts.csv\", crs = \"EPSG:25830\", x = \"x\", y = \"y\"}\n";
  const Scene scene = place.read(masts);
  EXPECT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(remark_count(scene, "features without usable coordinates"), 1U);
  EXPECT_THAT(place.fault(masts, "[scene]\nstrict = true\n"),
              AllOf(HasSubstr("masts.csv: layer masts, feature 3"), HasSubstr("features without usable coordinates")));
}

TEST(SceneFile, PositionsOfMeshesThatNothingMeetsMakeARemark) {
  const MadeUpPlace place;
  place.write("mast.obj", "v 0 0 0\nv 1 0 0\nv 0 0 9\nf 1 2 3\n");
  place.write("masts.csv", "x,y,kind\n501100,4795500,pole\n");
  const Scene scene = place.read(
      "[[meshes]]\nfile = \"mast.obj\"\nmaterial = \"metal\"\n"
      "positions = {file = \"masts.csv\", crs = \"EPSG:25830\", x = \"x\", y = \"y\", where = \"kind = 'mast'\"}\n");
  ASSERT_EQ(remark_count(scene, "files without a feature that is asked for"), 1U);
  EXPECT_THAT(scene.remarks.back().first, HasSubstr("masts.csv: none meets where"));
}

TEST(SceneFile, PointTargetsCarryTheirCrossSection) {
  const MadeUpPlace place;
  const Scene scene = place.read(
      "[[point_targets]]\nname = \"corner\"\nposition_m = [5, 6]\nheight_m = 2\nrcs_dbsm = 30\n"
      "[[point_targets]]\nposition_m = [0, 0]\nrcs_dbsm = {vv = 20, hh = 10}\nbounces = \"even\"\n");
  ASSERT_EQ(scene.point_targets.size(), 2U);
  EXPECT_FLOAT_EQ(scene.point_targets[0].rcs_m2.vv, 1000.0F);
  EXPECT_FLOAT_EQ(scene.point_targets[0].rcs_m2.re_vvhh, 1000.0F);
  EXPECT_FLOAT_EQ(scene.point_targets[1].rcs_m2.hh, 10.0F);
  EXPECT_FLOAT_EQ(scene.point_targets[1].rcs_m2.hv, 0.0F);
  EXPECT_NEAR(static_cast<double>(scene.point_targets[1].rcs_m2.re_vvhh), -std::sqrt(1000.0), 1e-3);
}

TEST(SceneFile, OwnMaterialsComeFromAModelOrALibraryName) {
  const MadeUpPlace place;
  const Scene scene = place.read(
      "[land_cover.classes]\n30 = \"heath\"\n10 = \"wet_wood\"\n[materials.heath]\nmodel = "
      "\"constant_gamma\"\ngamma_db = -13\n"
      "[materials.wet_wood]\nbase = \"wood\"\npermittivity = 12\n");
  const auto of = [&](const std::string& name) {
    return *std::ranges::find(scene.materials, name, &scatter::Material::name);
  };
  EXPECT_NEAR(std::get<scatter::ConstantGammaParameters>(of("heath").model).gamma, 0.0501, 1e-4);
  EXPECT_EQ(std::get<scatter::CookTorranceParameters>(of("wet_wood").model).permittivity.relative_at(10e9).real(),
            12.0);
}

}  // namespace
}  // namespace sigmascape::scene
