#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/scene/made_up_place.h"

#include "sigmascape/scene/scene_file.h"

namespace sigmascape::scene {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class BadInput : public ::testing::Test {
 protected:
  [[nodiscard]] std::string fault_of(const std::string& toml) const {
    return message_of_error([&] { static_cast<void>(read_scene(place_.write("bad.toml", toml))); });
  }
  MadeUpPlace place_;
};

TEST_F(BadInput, MissingSceneFileOrTerrain) {
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_scene(place_.folder.path("none.toml"))); }),
              HasSubstr("none.toml: the file does not exist"));
  EXPECT_THAT(fault_of("[scene]\nname = \"x\"\n"), HasSubstr("bad.toml: terrain: is missing"));
  EXPECT_THAT(fault_of("[terrain]\nfile = \"none.tif\"\n"),
              AllOf(HasSubstr("bad.toml: terrain.file"), HasSubstr("none.tif does not exist")));
}

TEST_F(BadInput, UnsetEnvironmentVariable) {
  unsetenv("SIGMASCAPE_TEST_UNSET");
  EXPECT_THAT(fault_of("[terrain]\nfile = \"${SIGMASCAPE_TEST_UNSET}/dem.tif\"\n"),
              HasSubstr("terrain.file: the environment variable SIGMASCAPE_TEST_UNSET is not set"));
}

TEST_F(BadInput, UnknownKeysAndSections) {
  EXPECT_THAT(place_.fault("[teraain]\n"), HasSubstr("teraain: is not a known key; did you mean terrain?"));
  EXPECT_THAT(place_.fault("cel_m = 5\n"), HasSubstr("land_cover.cel_m: is not a known key; did you mean cell_m?"));
  EXPECT_THAT(place_.fault("", "[scene]\nsrict = true\n"),
              HasSubstr("scene.srict: is not a known key; did you mean strict?"));
}

TEST_F(BadInput, KeysThatOthersCallFor) {
  EXPECT_THAT(fault_of("[terrain]\nfile = \"heights.asc\"\ncrs = \"EPSG:25830\"\n[land_cover]\nband = 1\n"),
              HasSubstr("bad.toml: land_cover.band: stands without file"));
  place_.write("trees.csv", "x,y\n501100,4795500\n");
  EXPECT_THAT(place_.fault("[[trees]]\nfile = \"trees.csv\"\ndefault_height_m = 5\ncrown_material = \"crown\"\n"),
              HasSubstr("trees[1].crown_material: stands without kind = \"crowns\""));
  place_.write_houses(MadeUpPlace::house(0, 0, 9, 9, "\"h\":5"));
  EXPECT_THAT(place_.fault(houses_section + "metres_per_level = 3\n"),
              HasSubstr("buildings[1].metres_per_level: stands without levels_attribute"));
}

TEST_F(BadInput, ExtentsAcrossTheAntimeridianAreCountedOn) {
  EXPECT_THAT(
      place_.fault("", "[scene]\nextent = {west_deg = 179.9, south_deg = 0, east_deg = -179.9, north_deg = 1}\n"),
      AllOf(HasSubstr("scene.extent: holds no area"), HasSubstr("across 180°, count on to 180.1")));
  EXPECT_THAT(place_.fault("", "[scene]\nextent = {west_m = 1, south_m = 0, east_m = 0, north_m = 1}\n"),
              Not(HasSubstr("180°")));
}

TEST_F(BadInput, LatitudesOfPointTargetsAndMeshes) {
  EXPECT_THAT(place_.fault("[[point_targets]]\nposition_lat_lon_deg = [200, 10]\nrcs_dbsm = 10\n"),
              HasSubstr("point_targets[1].position_lat_lon_deg: holds a latitude beyond 90°"));
  place_.write("hut.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(
      place_.fault("[[meshes]]\nfile = \"hut.obj\"\nmaterial = \"wood\"\npositions_lat_lon_deg = [[10, 400]]\n"),
      HasSubstr("meshes[1].positions_lat_lon_deg: holds a longitude beyond 360°"));
}

TEST_F(BadInput, FootprintsInAnotherReferenceThanTheirFileSays) {
  place_.write("houses.geojson",
               R"({"type":"FeatureCollection","features":[)" + MadeUpPlace::house(0, 0, 20, 20, "\"h\":5") + "]}");
  EXPECT_THAT(
      place_.fault(houses_section),
      HasSubstr("feature 0 (at 501100, 4795400, which has no place in the scene's frame: the key crs can state"));
  EXPECT_EQ(place_.fault(houses_section + "crs = \"EPSG:25830\"\n"), "");
}

TEST_F(BadInput, ValuesOutOfRange) {
  EXPECT_THAT(fault_of("[terrain]\nfile = \"heights.asc\"\nspacing_m = -5\n"),
              HasSubstr("terrain.spacing_m: is -5; give a number from"));
  place_.write_houses(MadeUpPlace::house(0, 0, 9, 9, "\"h\":5"));
  EXPECT_THAT(place_.fault(houses_section + "default_height_m = -3\n"),
              HasSubstr("buildings[1].default_height_m: is -3"));
  EXPECT_THAT(place_.fault("[materials.m]\nmodel = \"lambert\"\nalbedo = 1.5\n"),
              HasSubstr("materials.m.albedo: is 1.5"));
}

TEST_F(BadInput, UnitOfHeightsIsOneOfThree) {
  EXPECT_THAT(fault_of("[terrain]\nfile = \"heights.asc\"\nunit = \"feet\"\n"),
              HasSubstr("bad.toml: terrain.unit: is \"feet\"; choose among m, cm, ft, us-ft"));
}

TEST_F(BadInput, UnitsOfAttributesAreKnownAndHaveAnAttribute) {
  place_.write_houses(MadeUpPlace::house(0, 0, 9, 9, "\"h\":5,\"n\":2"));
  place_.write("trees.csv", "x,y\n501100,4795500\n");
  EXPECT_THAT(place_.fault(houses_section + "unit = \"fathom\"\n"),
              HasSubstr("place.toml: buildings[1].unit: is \"fathom\"; choose among m, cm, ft, us-ft"));
  EXPECT_THAT(place_.fault("[[buildings]]\nfile = \"houses.geojson\"\nlevels_attribute = \"n\"\nunit = \"ft\"\n"),
              HasSubstr("buildings[1].unit: stands without height_attribute; add height_attribute or remove it"));
  EXPECT_THAT(place_.fault("[[trees]]\nfile = \"trees.csv\"\ndefault_height_m = 5\nunit = \"ft\"\n"),
              HasSubstr("trees[1].unit: stands without height_attribute or crown_radius_attribute"));
}

// 4 × 10¹² heights are more than any machine holds.
TEST_F(BadInput, SpacingThatMakesMoreHeightsThanMemoryHolds) {
  const std::string scene =
      "[scene]\nextent = {west_m = -100000, south_m = -100000, east_m = 100000, north_m = 100000}\n"
      "[terrain]\nfile = \"heights.asc\"\ncrs = \"EPSG:25830\"\n";
  EXPECT_THAT(fault_of(scene + "spacing_m = 0.1\n"),
              AllOf(HasSubstr("bad.toml: terrain.spacing_m: heights every 0.1 m over 200000 × 200000 m are 2000001 × "
                              "2000001, which take 4.8e+04 GB of memory to read"),
                    HasSubstr("choose a spacing of ")));
}

TEST_F(BadInput, LeavesThatMixMirrorsOrAreNoneMakeNoCrowns) {
  place_.write("trees.csv", "x,y,h\n501100,4795500,12\n");
  const std::string trees =
      "[[trees]]\nfile = \"trees.csv\"\ncrs = \"EPSG:25830\"\nx = \"x\"\ny = \"y\"\nheight_attribute = \"h\"\n"
      "leaf_material = \"grass\"\n";
  EXPECT_THAT(place_.fault(trees + "kind = \"crowns\"\n"),
              AllOf(HasSubstr("place.toml: trees[1].leaf_material: 'grass' is of no leaves that crowns can be made of"),
                    HasSubstr("name a crown_material")));
  const std::string mixed = trees.substr(0, trees.find("leaf_material")) +
                            "kind = \"crowns\"\nleaf_material = \"wet\"\n"
                            "[materials.wet]\nbase = \"leaf\"\nscattering_coefficient = 0.5\n";
  EXPECT_THAT(place_.fault(mixed), HasSubstr("'wet' is of no leaves that crowns can be made of"));
  EXPECT_EQ(place_.fault(trees), "") << "of leaves as triangles";
}

TEST_F(BadInput, RasterWithoutCrs) {
  EXPECT_THAT(fault_of("[terrain]\nfile = \"heights.asc\"\n"),
              HasSubstr("heights.asc: carries no coordinate reference system"));
}

TEST_F(BadInput, RastersWithoutOverlap) {
  const std::string terrain = "[terrain]\nfile = \"heights.asc\"\ncrs = \"EPSG:25830\"\n";
  EXPECT_THAT(
      fault_of("[scene]\nextent = {west_deg = 10, south_deg = 50, east_deg = 10.01, north_deg = 50.01}\n" + terrain),
      HasSubstr("heights.asc: does not overlap the scene's extent"));
  constexpr geo::AsciiGrid elsewhere{600'000.0, 4'795'000.0, 10.0, 10, 10};
  place_.write("far.asc", elsewhere.text([](double, double) { return 30.0; }));
  EXPECT_THAT(fault_of(terrain + "[land_cover]\nfile = \"far.asc\"\ncrs = \"EPSG:25830\"\n"),
              HasSubstr("far.asc: holds no class anywhere in the scene's extent"));
}

TEST_F(BadInput, HolesInTheTerrainAreFilledAndToldButNotWhenMostIsMissing) {
  const auto holed = [](double x_to) {
    return MadeUpPlace::grid.text([x_to](double x, double) { return x < x_to ? std::nan("") : 30.0; });
  };
  place_.write("heights.asc", holed(500'700.0));
  EXPECT_GT(remark_count(place_.read(), "terrain nodes without data"), 500U);
  EXPECT_THAT(place_.fault("", "[scene]\nstrict = true\n"),
              HasSubstr("terrain nodes without data or with implausible heights"));
  place_.write("heights.asc", holed(501'500.0));
  EXPECT_THAT(place_.fault(""), AllOf(HasSubstr("% of the scene's terrain has no height between -500 and 9000 m"),
                                      HasSubstr("raise max_flawed_share")));
  EXPECT_EQ(place_.fault("", "[scene]\nmax_flawed_share = 1\n"), "");
}

TEST_F(BadInput, PlausibleHeightsRunUpwards) {
  EXPECT_THAT(fault_of("[terrain]\nfile = \"heights.asc\"\nlowest_plausible_m = 100\nhighest_plausible_m = 0\n"),
              HasSubstr("terrain.lowest_plausible_m: is not below highest_plausible_m"));
}

TEST_F(BadInput, NegativeBuildingHeightNamesFileAndFeature) {
  place_.write_houses(MadeUpPlace::house(0, 0, 9, 9, "\"h\":5") + "," + MadeUpPlace::house(20, 0, 29, 9, "\"h\":-4.5"));
  EXPECT_THAT(place_.fault(houses_section),
              AllOf(HasSubstr("houses.geojson"), HasSubstr("feature 1: its h is -4.5"), HasSubstr("where")));
}

TEST_F(BadInput, NegativeHeightsAreToldAsTheFileHasThem) {
  place_.write_houses(MadeUpPlace::house(0, 0, 9, 9, "\"h\":-4.5"));
  EXPECT_THAT(place_.fault(houses_section + "unit = \"ft\"\n"), HasSubstr("its h is -4.5"));
}

TEST_F(BadInput, NegativeTreeHeightNamesFileAndFeature) {
  place_.write("trees.csv", "x,y,h\n501100,4795500,-2\n");
  EXPECT_THAT(
      place_.fault(
          "[[trees]]\nfile = \"trees.csv\"\ncrs = \"EPSG:25830\"\nx = \"x\"\ny = \"y\"\nheight_attribute = \"h\"\n"),
      AllOf(HasSubstr("trees.csv"), HasSubstr("its h is -2")));
}

TEST_F(BadInput, MisspeltAttributeSuggestsTheRightOne) {
  place_.write_houses(MadeUpPlace::house(0, 0, 9, 9, "\"height_m\":5"));
  EXPECT_THAT(place_.fault("[[buildings]]\nfile = \"houses.geojson\"\nheight_attribute = \"hieght_m\"\n"),
              HasSubstr("buildings[1].height_attribute: no feature of houses.geojson has the attribute 'hieght_m'; did "
                        "you mean height_m?"));
}

TEST_F(BadInput, UnknownMaterialSuggestsTheNearest) {
  place_.write_houses(MadeUpPlace::house(0, 0, 9, 9, "\"h\":5"));
  EXPECT_THAT(place_.fault(houses_section + "wall_material = \"concret\"\n"),
              HasSubstr("buildings[1].wall_material: the material 'concret' is not known; did you mean concrete?"));
}

TEST_F(BadInput, BasesAreMaterialsOfTheLibrary) {
  const std::string own = "[materials.b]\nmodel = \"lambert\"\nalbedo = 0.5\n[materials.a]\nbase = \"b\"\n";
  EXPECT_THAT(place_.fault(own), AllOf(HasSubstr("materials.a.base: names 'b' of the same file"),
                                       HasSubstr("takes names of the library only")));
  EXPECT_THAT(place_.fault("[materials.a]\nbase = \"concret\"\n"), HasSubstr("did you mean concrete?"));
  EXPECT_EQ(place_.fault("[materials.concrete]\nbase = \"concrete\"\n"), "") << "a change of the library's own";
}

TEST_F(BadInput, NamesOfScenesAreOneLineOfText) {
  EXPECT_THAT(place_.fault("", "[scene]\nname = \"\"\n"), HasSubstr("scene.name: is empty; give a name"));
  EXPECT_THAT(place_.fault("", "[scene]\nname = \"two\\nlines\"\n"), HasSubstr("scene.name: holds a line break"));
  EXPECT_EQ(place_.fault("", "[scene]\nname = \"Bilbão\"\n"), "");
}

TEST_F(BadInput, MeshWithoutFacesOrMaterials) {
  place_.write("points.obj", "v 0 0 0\nv 1 0 0\n");
  EXPECT_THAT(place_.fault("[[meshes]]\nfile = \"points.obj\"\npositions_m = [[0, 0]]\n"),
              HasSubstr("points.obj: has no faces"));
  place_.write("torn.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  EXPECT_THAT(place_.fault("[[meshes]]\nfile = \"torn.obj\"\npositions_m = [[0, 0]]\n"),
              HasSubstr("torn.obj: face 1 names vertex 9 of 3"));
  place_.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nusemtl metal\nf 1 2 3\n");
  EXPECT_THAT(place_.fault("[[meshes]]\nfile = \"line.obj\"\npositions_m = [[0, 0]]\n"),
              HasSubstr("line.obj: has no face with an area"));
  place_.write("hut.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl chewing_gum\nf 1 2 3\n");
  EXPECT_THAT(place_.fault("[[meshes]]\nfile = \"hut.obj\"\npositions_m = [[0, 0]]\n"),
              HasSubstr("the material 'chewing_gum' of"));
  EXPECT_THAT(place_.fault("[[meshes]]\nfile = \"hut.obj\"\nmaterial = \"metal\"\n"),
              HasSubstr("does not say where the mesh stands"));
}

TEST_F(BadInput, MeshesInOtherUnitsOrFarFromTheirOrigin) {
  const std::string section = "[[meshes]]\nfile = \"m.obj\"\nmaterial = \"metal\"\npositions_m = [[0, 0]]\n";
  place_.write("m.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3\n");
  EXPECT_THAT(place_.fault(section), AllOf(HasSubstr("m.obj: vertex 2 lies 1e+30 m from the mesh's origin"),
                                           HasSubstr("within 50 km: state scale, such as 0.001")));
  place_.write("m.obj", "v 0 0 0\nv 60000 0 0\nv 0 0 60000\nf 1 2 3\n");
  EXPECT_THAT(place_.fault(section), HasSubstr("vertex 2 lies 60000 m"));
  EXPECT_EQ(place_.fault(section + "scale = 0.001\n"), "");
}

TEST_F(BadInput, FlawsAreMendedCountedAndNamedButNotWhenStrictOrCommon) {
  const std::string bow_tie =
      R"({"type":"Feature","properties":{"h":5},"geometry":{"type":"Polygon","coordinates":[[[501100,4795400],[501120,4795420],[501120,4795400],[501100,4795420],[501100,4795400]]]}})";
  place_.write_houses(MadeUpPlace::house(40, 0, 49, 9, "\"h\":5") + "," + MadeUpPlace::house(60, 0, 69, 9, "\"h\":5") +
                      "," + bow_tie);
  const Scene scene = place_.read(houses_section);
  EXPECT_EQ(scene.buildings.items.size(), 4U);
  ASSERT_EQ(remark_count(scene, "self-crossing footprints"), 1U);
  EXPECT_THAT(scene.remarks.back().first, HasSubstr("houses.geojson: layer houses, feature 2"));
  EXPECT_THAT(
      place_.fault(houses_section, "[scene]\nstrict = true\n"),
      AllOf(HasSubstr("feature 2: the first of 1 self-crossing"), HasSubstr("set strict = false to put up with them")));
  EXPECT_THAT(place_.fault(houses_section + "max_flawed_share = 0.3\n"), HasSubstr("raise max_flawed_share"));
}

// What a file states for those that lack it is meant to be so, even of most; what nobody states is made up.
TEST_F(BadInput, HeightsAndCrownsThatAreMissingAreFlawsWhereNothingIsStatedInstead) {
  place_.write_houses(MadeUpPlace::house(0, 0, 9, 9, "\"h\":null") + "," +
                      MadeUpPlace::house(20, 0, 29, 9, "\"h\":null") + "," +
                      MadeUpPlace::house(40, 0, 49, 9, "\"h\":5"));
  EXPECT_THAT(place_.fault(houses_section), HasSubstr("the first of 2 buildings without a height, left out"));
  EXPECT_EQ(place_.fault(houses_section + "default_height_m = 6\n", "[scene]\nstrict = true\n"), "");
  EXPECT_EQ(remark_count(place_.read(houses_section + "default_height_m = 6\n"), "without a height, given 6 m"), 2U);

  place_.write("trees.csv", "x,y,h,r\n501100,4795500,,\n501200,4795500,,\n501300,4795500,9,3\n");
  const std::string trees =
      "[[trees]]\nfile = \"trees.csv\"\ncrs = \"EPSG:25830\"\nx = \"x\"\ny = \"y\"\nheight_attribute = \"h\"\n";
  const std::string with_crowns = trees + "default_height_m = 8\ncrown_radius_attribute = \"r\"\n";
  EXPECT_THAT(place_.fault(trees), HasSubstr("the first of 2 trees without a height, left out"));
  EXPECT_THAT(place_.fault(with_crowns),
              AllOf(HasSubstr("the first of 2 trees without a crown radius, given the usual one"),
                    HasSubstr("raise max_flawed_share to put up with them")));
  EXPECT_EQ(place_.fault(with_crowns + "crown_radius_per_height = 0.2\n", "[scene]\nstrict = true\n"), "");
  const Scene scene = place_.read(with_crowns + "crown_radius_per_height = 0.2\n");
  EXPECT_EQ(remark_count(scene, "trees without a height, given 8 m"), 2U);
  EXPECT_EQ(remark_count(scene, "trees without a crown radius, given 0.2 of their height"), 2U);
}

// 300 km and more away nothing has its true size, whatever the distance is counted from.
TEST_F(BadInput, ExtentsInMetresFarFromTheirOrigin) {
  const std::string extent = "extent = {west_m = 850000, south_m = 0, east_m = 852000, north_m = 2000}\n";
  const auto remedy = AllOf(HasSubstr("state it in metres from an origin_lat_deg and origin_lon_deg within 300 km"),
                            HasSubstr("or in degrees without an origin"));
  EXPECT_THAT(
      place_.fault("", "[scene]\n" + extent),
      AllOf(HasSubstr("scene.extent: has its middle 851 km from the origin, which is the middle of the terrain"),
            remedy));
  EXPECT_THAT(place_.fault("", "[scene]\norigin_lat_deg = 43.3\norigin_lon_deg = -2.9\n" + extent),
              AllOf(HasSubstr("scene.extent: has its middle 851 km from the origin, where"), remedy));
}

TEST_F(BadInput, PointTargetOutsideTheScene) {
  EXPECT_THAT(place_.fault("[[point_targets]]\nposition_m = [9000, 0]\nrcs_dbsm = 10\n"),
              HasSubstr("point_targets[1]: stands at (9000.0, 0.0) m, outside"));
}

}  // namespace
}  // namespace sigmascape::scene
