// How far rasters reach, what they are of, and what roads paint.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include "unit/scene/made_up_place.h"

#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/scene/scene_warnings.h"

namespace sigmascape::scene {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// The file of heights of a place, or that of its land cover, as another raster: with another transform from pixels,
/// and its band as a colour if that is named.
std::string vrt_of(const std::string& file, const std::string& from_pixel, const std::string& colour) {
  constexpr geo::AsciiGrid grid = MadeUpPlace::grid;
  return fmt::format(
      R"(<VRTDataset rasterXSize="{}" rasterYSize="{}"><SRS>EPSG:25830</SRS><GeoTransform>{}</GeoTransform>
<VRTRasterBand dataType="Float32" band="1"><ColorInterp>{}</ColorInterp><SimpleSource><SourceFilename relativeToVRT="1">{}</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>)",
      grid.columns, grid.rows, from_pixel, colour, file);
}
const std::string as_it_lies = "500600, 10, 0, 4795800, 0, -10";

TEST(SceneFileGround, LandCoverOfAPartOfTheSceneIsLikelyAMistake) {
  const MadeUpPlace place;
  const auto warnings_with = [&](int columns) {
    geo::AsciiGrid part = MadeUpPlace::grid;
    part.columns = columns;
    place.write("cover.asc", part.text([](double, double) { return 30.0; }));
    return warnings_of(place.read());
  };
  const auto told = HasSubstr("land cover that does not reach over");
  EXPECT_THAT(warnings_with(98), Not(Contains(told)));
  EXPECT_THAT(warnings_with(60), Contains(AllOf(told, AnyOf(HasSubstr("39 % of"), HasSubstr("40 % of")))));
}

TEST(SceneFileGround, CellsOfLandCoverThatTheSceneHasNoRoomForAreRefused) {
  const MadeUpPlace place;
  EXPECT_THAT(place.fault("cell_m = 2000\n"),
              AllOf(HasSubstr("land_cover.cell_m: is 2000 m in a scene of"), Not(HasSubstr("holds no class"))));
}

TEST(SceneFileGround, ColoursOfAPictureAreNoClasses) {
  const MadeUpPlace place;
  for (const char* const colour : {"Red", "Green", "Blue"}) {
    place.write("picture.vrt", vrt_of("cover.asc", as_it_lies, colour));
    EXPECT_THAT(
        message_of_error([&] {
          static_cast<void>(read_scene(place.write(
              "picture.toml",
              "[terrain]\nfile = \"heights.asc\"\ncrs = \"EPSG:25830\"\n[land_cover]\nfile = \"picture.vrt\"\n")));
        }),
        HasSubstr("picture.vrt, band 1: is the "));
  }
  place.write("picture.vrt", vrt_of("cover.asc", as_it_lies, "Gray"));
  EXPECT_NO_THROW(static_cast<void>(read_scene(place.folder.path("picture.toml"))));
}

TEST(SceneFileGround, FilesThatOnlyGdalFindsAreRead) {
  const MadeUpPlace place;
  const std::string heights = place.folder.path("heights.asc").string();
  const Scene scene = read_scene(place.write(
      "virtual.toml", fmt::format("[terrain]\nfile = \"/vsisubfile/0,{}\"\ncrs = \"EPSG:25830\"\n", heights)));
  EXPECT_NEAR(scene.extent.width_m(), 1000.0, 12.0);
}

// Turned by 45°, of a square the largest upright rectangle is half.
TEST(SceneFileGround, WhatAScenesOwnExtentLeavesOfARasterIsTold) {
  const MadeUpPlace place;
  geo::AsciiGrid grid = MadeUpPlace::grid;
  grid.rows = grid.columns;
  place.write("heights.asc", grid.text([](double, double) { return 40.0; }));
  const std::string told = "of which the scene, without an extent the largest upright rectangle within, leaves out ";
  const auto read = [&](const std::string& extent) {
    return read_scene(place.write("aslant.toml", extent + "[terrain]\nfile = \"aslant.vrt\"\n"));
  };
  std::string vrt = vrt_of("heights.asc", "500600, 7, 7, 4795800, 7, -7", "Gray");
  vrt.replace(vrt.find("rasterYSize=\"80\""), 16, "rasterYSize=\"100\"");
  place.write("aslant.vrt", vrt);
  EXPECT_EQ(remark_count(read(""), told + "50 %"), 1U);
  EXPECT_EQ(
      remark_count(read("[scene]\nextent = {west_m = -100, south_m = -100, east_m = 100, north_m = 100}\n"), told), 0U);
  EXPECT_EQ(remark_count(place.read(), told), 0U) << "which lies nearly along the frame";
}

double distance_m(Vec2d point, Vec2d from, Vec2d to) {
  const double t = std::clamp(dot(point - from, to - from) / dot(to - from, to - from), 0.0, 1.0);
  return length(point - (from + (to - from) * t));
}

std::string road_through(const std::vector<Vec2d>& corners) {
  std::string text;
  for (const Vec2d& corner : corners) text += fmt::format("{}[{},{}]", text.empty() ? "" : ",", corner.x, corner.y);
  return R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25830"}},"features":[
  {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[)" +
         text + "]}}]}";
}

const std::string no_water = "water_classes = []\n";

TEST(SceneFileGround, RoadsPaintTheCellsWithinHalfTheirWidth) {
  const MadeUpPlace place;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> east(500'500.0, 501'700.0), north(4'794'900.0, 4'795'900.0);
  for (int run = 0; run < 20; ++run) {
    std::vector<Vec2d> corners{{east(random), north(random)}, {east(random), north(random)}};
    if (run == 0) corners[1].y = corners[0].y;
    if (run == 1) corners[1].x = corners[0].x;
    place.write("road.geojson", road_through(corners));
    const Scene scene = place.read(no_water + "cell_m = 3\n[[roads]]\nfile = \"road.geojson\"\nwidth_m = 17\n");
    geo::CoordinateTransform("EPSG:25830", scene.frame, "test").to_frame(corners);
    const radar::GroundGrid& grid = scene.ground.grid;
    for (std::size_t row = 0; row < grid.rows; ++row) {
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const double away_m = distance_m(grid.centre_of(column, row), corners[0], corners[1]);
        if (std::abs(away_m - 8.5) < 1e-3) continue;
        const bool is_paved = scene.materials[scene.ground.material(column, row)].name == "asphalt";
        ASSERT_EQ(is_paved, away_m < 8.5) << run << ": " << column << " " << row;
      }
    }
  }
}

TEST(SceneFileGround, LongRoadsAcrossTheRowsLookAtTheCellsBesideThem) {
  const MadeUpPlace place;
  std::vector<Vec2d> zigzag;
  // Boxes about its legs hold 1.9e11 cells: to look at all of them takes longer than a test may.
  for (int i = 0; i < 60'000; ++i)
    zigzag.push_back({i % 2 == 0 ? 500'610.0 : 501'590.0, i % 2 == 0 ? 4'795'010.0 : 4'795'790.0});
  place.write("road.geojson", road_through(zigzag));
  const Scene scene = place.read(no_water + "cell_m = 0.5\n[[roads]]\nfile = \"road.geojson\"\nwidth_m = 0.5\n");
  double paved_m2 = 0.0;
  for (std::size_t row = 0; row < scene.ground.grid.rows; ++row) {
    for (std::size_t column = 0; column < scene.ground.grid.columns; ++column)
      if (scene.materials[scene.ground.material(column, row)].name == "asphalt") paved_m2 += 0.25;
  }
  EXPECT_NEAR(paved_m2, 0.5 * std::hypot(980.0, 780.0), 10.0);
}

}  // namespace
}  // namespace sigmascape::scene
