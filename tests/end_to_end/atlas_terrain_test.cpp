#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "scratch_folder.h"
#include "unit/geo/ascii_grid.h"

#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/terrain/height_field_file.h"
#include "sigmascape/terrain/pyramid_files.h"

namespace sigmascape::end_to_end {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// `sigmascape atlas` on a small atlas near Bilbao, and terrain that reaches 4 km about it.
class AtlasTerrain : public ::testing::Test {
 protected:
  AtlasTerrain() {
    atlas::AtlasDescription description;
    description.name = "small";
    description.frame = geo::LocalFrame(43.312, -2.986);
    description.extent = {0.0, 0.0, 512.0, 512.0};
    description.patches = {2.0, 256};
    description.aspects.azimuths_rad = {0.0};
    description.aspects.elevations_rad = {0.3};
    description.aspects.frequencies_hz = {10e9};
    description.scene_hash = "none";
    const auto store = atlas::Store::create(atlas_, description);
    for (const atlas::Unit& unit : store.units()) {
      store.write(unit.patch, unit.look, Array2D<radar::Channels>(256, 256, {0.1F, 0.1F, 0.01F, 0.1F}), {});
    }
    atlas::Pyramid(store).make_above(store.units());
    const terrain::HeightField level{-1000.0, 2000.0, 1000.0, Array2D<float>(4, 4, 0.0F)};
    terrain::write_height_field(atlas_ / atlas::terrain_name, level, description.frame.proj());
    atlas::vouch_for_terrain(atlas::Store::open(atlas_));
  }

  /// A plane that rises to the east, in UTM zone 30 north.
  [[nodiscard]] std::string raster(double west, const std::string& name) const {
    const geo::AsciiGrid grid{west, 4'792'000.0, 20.0, 400, 400};
    return folder_.write(name, grid.text([](double x, double) { return 0.01 * (x - 400'000.0); })).string();
  }
  [[nodiscard]] int run(const std::string& arguments) const {
    const int status = std::system(fmt::format("'{}' {} > '{}' 2> '{}'", SIGMASCAPE_CLI, arguments,
                                               folder_.path("printed").string(), folder_.path("warned").string())
                                       .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] int add_terrain(const std::string& raster, const std::string& more = {}) const {
    return run(fmt::format("atlas terrain '{}' '{}' --crs EPSG:25830 {} --json", atlas_.string(), raster, more));
  }
  [[nodiscard]] int verify() const { return run(fmt::format("atlas verify '{}' --json", atlas_.string())); }
  [[nodiscard]] std::string printed() const { return text_of("printed"); }
  /// And what went to standard error.
  [[nodiscard]] std::string told() const { return printed() + text_of("warned"); }

  [[nodiscard]] std::string text_of(const char* file) const {
    std::ifstream stream(folder_.path(file));
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  ScratchFolder folder_;
  std::filesystem::path atlas_ = folder_.path("atlas");
};

TEST_F(AtlasTerrain, IsMadeVerifiedAndMended) {
  const std::string heights = raster(497'000.0, "heights.asc");
  ASSERT_EQ(add_terrain(heights), 0) << told();
  const Json made = Json::parse(printed());
  const std::size_t tiles = made.at("written");
  EXPECT_GT(tiles, 4U);
  const Json& extent = made.at("extent_m");
  EXPECT_NEAR(extent.at(2).get<double>() - extent.at(0).get<double>(), 8000.0, 300.0) << "no tile ends there";
  ASSERT_EQ(verify(), 0) << told();

  ASSERT_EQ(add_terrain(heights), 0) << told();
  EXPECT_EQ(Json::parse(printed()).at("written"), 0);

  std::filesystem::remove(atlas_ / "terrain" / "level_0" / "1_1.tif");
  std::filesystem::resize_file(atlas_ / "terrain" / "level_1" / "0_0.tif", 500);
  EXPECT_EQ(verify(), 1);
  const Json faults = Json::parse(printed()).at("faults");
  ASSERT_EQ(faults.size(), 2U) << told();
  EXPECT_EQ(faults[0].at("file"), "terrain/level_0/1_1.tif");
  EXPECT_EQ(faults[0].at("fault"), "is missing");
  EXPECT_EQ(faults[1].at("file"), "terrain/level_1/0_0.tif");
  ASSERT_EQ(add_terrain(heights), 0) << told();
  EXPECT_EQ(Json::parse(printed()).at("written"), 2);
  EXPECT_EQ(verify(), 0) << told();
}

// The largest rectangle in a raster of Europe lies hundreds of kilometres north of Bilbao.
TEST_F(AtlasTerrain, MayComeFromARasterOfAContinentOrTheGlobe) {
  const auto level = [](double, double) { return 100.0; };
  const std::string europe =
      folder_.write("europe.asc", geo::AsciiGrid{-25.0, 34.0, 0.5, 140, 76}.text(level)).string();
  const double half_turn_m = 6378137.0 * M_PI;
  const std::string globe =
      folder_
          .write("globe.asc",
                 geo::AsciiGrid{-half_turn_m, -0.5 * half_turn_m, half_turn_m / 100.0, 200, 100}.text(level))
          .string();
  for (const std::string& raster : {europe + "' --crs 'EPSG:4326", globe + "' --crs 'EPSG:3857"}) {
    ASSERT_EQ(run(fmt::format("atlas terrain '{}' '{}' --spacing 20000 --json", atlas_.string(), raster)), 0) << told();
    const Json made = Json::parse(printed());
    EXPECT_EQ(made.at("nodes_without_height"), 0);
    for (const std::size_t west_or_south : {0, 1}) {
      EXPECT_LT(made.at("extent_m").at(west_or_south), -300e3);
      EXPECT_GT(made.at("extent_m").at(west_or_south + 2), 300e3);
    }
  }
}

// Of a raster of degrees that reaches far to the south: there its cells are wider by the ratio of the cosines of
// latitude, in the middle of what it reaches by a fifth. The place's cell is 0.05° by N cos φ, N = a / √(1 − e² sin²
// φ).
TEST_F(AtlasTerrain, IsAsFineAsTheRasterIsInTheAtlas) {
  const std::string south =
      folder_.write("south.asc", geo::AsciiGrid{-6.0, 15.0, 0.05, 120, 600}.text([](double, double) { return 100.0; }))
          .string();
  ASSERT_EQ(run(fmt::format("atlas terrain '{}' '{}' --crs EPSG:4326 --json", atlas_.string(), south)), 0) << told();
  const Json made = Json::parse(printed());
  EXPECT_LT(made.at("extent_m").at(1), -2000e3) << "or there is nothing to tell apart";
  const double latitude_rad = 43.312 * M_PI / 180.0, sine = std::sin(latitude_rad);
  const double expected_m =
      0.05 * M_PI / 180.0 * 6378137.0 * std::cos(latitude_rad) / std::sqrt(1.0 - 0.00669438 * sine * sine);
  EXPECT_NEAR(made.at("spacing_m").get<double>(), expected_m, 2e-3 * expected_m);
}

TEST_F(AtlasTerrain, OneIsCountedAsOne) {
  const std::string heights = raster(497'000.0, "heights.asc");
  const auto said_at = [&](int spacing_m) {
    EXPECT_EQ(
        run(fmt::format("atlas terrain '{}' '{}' --crs EPSG:25830 --spacing {}", atlas_.string(), heights, spacing_m)),
        0);
    return told();
  };
  // 8 km are 80 of the 256 cells of a tile, or 800.
  EXPECT_THAT(said_at(100), testing::AllOf(testing::StartsWith("1 level, "), HasSubstr("; 1 tile written")));
  EXPECT_THAT(said_at(10), testing::AllOf(HasSubstr(" levels, "), HasSubstr(" tiles written")));
}

TEST_F(AtlasTerrain, HeightsWithoutAUnitOnAMapInFeetAreMetresWithAWarning) {
  constexpr double feet_per_m = 3937.0 / 1200.0;
  const geo::AsciiGrid grid{497'000.0 * feet_per_m, 4'792'000.0 * feet_per_m, 66.0, 400, 400};
  const std::string in_feet = folder_.write("feet.asc", grid.text([](double, double) { return 100.0; })).string();
  const auto height_m = [&](const std::string& unit) {
    const std::string crs = "+proj=utm +zone=30 +ellps=GRS80 +units=us-ft";
    EXPECT_EQ(run(fmt::format("atlas terrain '{}' '{}' --crs '{}' {}", atlas_.string(), in_feet, crs, unit)), 0)
        << told();
    return terrain::open_pyramid(atlas_ / atlas::terrain_pyramid_name, 0).summary({0, 0, 0}).highest_m;
  };
  const std::string warning = "feet.asc: states no unit of heights on a map in feet, taken to be in metres";
  EXPECT_FLOAT_EQ(height_m(""), 100.0F);
  EXPECT_THAT(told(), HasSubstr("warning: "));
  EXPECT_THAT(told(), HasSubstr(warning));
  EXPECT_FLOAT_EQ(height_m("--unit us-ft"), 30.480061F);
  EXPECT_THAT(told(), Not(HasSubstr(warning)));
  EXPECT_FLOAT_EQ(height_m("--unit m"), 100.0F);
  EXPECT_THAT(told(), Not(HasSubstr(warning)));
}

/// The atlas' own heights are 0. A plane of one height is that much above them everywhere, whatever the spacing.
TEST_F(AtlasTerrain, WarnsOfHeightsThatAreMoreThanATexelFromThoseOfTheScene) {
  const auto said_of_height = [&](double height_m) {
    const geo::AsciiGrid grid{497'000.0, 4'792'000.0, 20.0, 400, 400};
    const std::string level = folder_.write("level.asc", grid.text([&](double, double) { return height_m; })).string();
    EXPECT_EQ(add_terrain(level), 0) << told();
    return told();
  };
  EXPECT_THAT(said_of_height(1.5), Not(HasSubstr("warning")));
  EXPECT_THAT(said_of_height(-7.5),
              HasSubstr("level.asc: lies up to 7.5 m above or below the heights that the atlas was baked on, 7.5 m in "
                        "the median"));
  std::filesystem::remove(atlas_ / atlas::terrain_name);
  EXPECT_THAT(said_of_height(9.0), Not(HasSubstr("warning"))) << "nobody knows what it was baked on";
}

TEST_F(AtlasTerrain, RefusesInOneSentence) {
  const std::string far = raster(700'000.0, "far.asc"), near = raster(497'000.0, "near.asc");
  const auto message = [&](const std::string& raster, const std::string& more) {
    EXPECT_NE(add_terrain(raster, more), 0);
    std::string text = told();
    if (const auto hint = text.find("Run with --help"); hint != std::string::npos) text.erase(hint);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    return text;
  };
  EXPECT_THAT(message(far, ""), HasSubstr("nowhere over the atlas"));
  EXPECT_THAT(message(near, "--spacing 1e-8"), HasSubstr("0.01 to 100000"));
  EXPECT_THAT(message("/nowhere.tif", ""), HasSubstr("/nowhere.tif"));
  EXPECT_THAT(message(near, "--band 3"), HasSubstr("band 3"));
  EXPECT_THAT(message(near, "--unit fathom"), HasSubstr("--unit: is fathom; choose among cm, ft, m, us-ft"));
  EXPECT_THAT(message(near, "--no-data-height nan"), HasSubstr("--no-data-height"));
  EXPECT_FALSE(std::filesystem::exists(atlas_ / "terrain"));
  std::ofstream(atlas_ / "collection.json") << "{";
  EXPECT_THAT(message(near, ""), HasSubstr("collection.json"));
}

}  // namespace
}  // namespace sigmascape::end_to_end
