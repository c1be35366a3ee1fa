#include "sigmascape/geo/raster.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "peak_memory.h"
#include "scratch_folder.h"
#include "unit/geo/ascii_grid.h"
#include "unit/geo/example_frame.h"

namespace sigmascape::geo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr AsciiGrid utm{500'600.0, 4'795'000.0, 10.0, 100, 80};

Vec2d utm_position(Vec2d in_frame) {
  static const CoordinateTransform transform("EPSG:25830", example_frame, "test");
  transform.to_crs({&in_frame, 1});
  return in_frame;
}

Lattice lattice_inside(const Raster& raster, double spacing_m) {
  const Extent extent = raster.outline_in(example_frame).extent_inside();
  return {extent.west_m, extent.north_m, spacing_m,
          static_cast<std::size_t>((extent.east_m - extent.west_m) / spacing_m),
          static_cast<std::size_t>((extent.north_m - extent.south_m) / spacing_m)};
}

TEST(Raster, BilinearHeightsReproduceAPlaneExactly) {
  const ScratchFolder folder;
  const auto plane = [](double x, double y) { return 0.02 * (x - 501'000.0) - 0.05 * (y - 4'795'400.0); };
  const Raster raster({folder.write("plane.asc", utm.text(plane)), 1, "EPSG:25830"});
  const Lattice lattice = lattice_inside(raster, 7.0);
  const auto heights = raster.heights_on(lattice, example_frame);
  for (std::size_t row = 2; row + 2 < lattice.rows; ++row) {
    for (std::size_t column = 2; column + 2 < lattice.columns; ++column) {
      const Vec2d p = utm_position(
          {lattice.west_m + 7.0 * static_cast<double>(column), lattice.north_m - 7.0 * static_cast<double>(row)});
      ASSERT_NEAR(static_cast<double>(heights(column, row)), plane(p.x, p.y), 1e-3) << column << " " << row;
    }
  }
}

// Whatever lattice a place belongs to, the mean about it takes in the same cells: where tiles meet, so do their
// heights.
TEST(Raster, MeansOverCoarseCellsAreTheSameWhereverTheLatticeBegins) {
  const ScratchFolder folder;
  const auto plane = [](double x, double y) { return 0.3 * (x - 501'000.0) - 0.2 * (y - 4'795'400.0); };
  const Raster raster({folder.write("plane.asc", utm.text(plane)), 1, "EPSG:25830"});
  const Extent extent = raster.outline_in(example_frame).extent_inside();
  const Lattice whole{extent.west_m + 10.0, extent.north_m - 10.0, 80.0, 9, 7};
  const Lattice part{whole.west_m + 3.0 * 80.0, whole.north_m - 2.0 * 80.0, 80.0, 4, 4};
  const auto in_whole = raster.heights_on(whole, example_frame), in_part = raster.heights_on(part, example_frame);
  for (std::size_t row = 0; row < part.rows; ++row) {
    for (std::size_t column = 0; column < part.columns; ++column) {
      const Vec2d p = utm_position(
          {part.west_m + 80.0 * static_cast<double>(column), part.north_m - 80.0 * static_cast<double>(row)});
      EXPECT_NEAR(static_cast<double>(in_part(column, row)), plane(p.x, p.y), 0.01) << column << " " << row;
      EXPECT_NEAR(in_part(column, row), in_whole(column + 3, row + 2), 1e-3F) << column << " " << row;
    }
  }
}

// Numbers of one system under the name of another.
TEST(Raster, WhatTheFrameDoesNotReachHasNoCells) {
  const ScratchFolder folder;
  const AsciiGrid mercator{-13'600'000.0, 4'500'000.0, 10.0, 4, 4};
  const Raster raster({folder.write("far.asc", mercator.text([](double, double) { return 1.0; })), 1, "EPSG:3035"});
  EXPECT_THAT(message_of_error([&] { static_cast<void>(raster.cell_m(example_frame, {})); }),
              AllOf(HasSubstr("far.asc"), HasSubstr("lies where the scene's frame does not reach")));
}

TEST(Raster, GeographicRasterIsNotTransposed) {
  const ScratchFolder folder;
  const AsciiGrid degrees{-3.0, 43.3, 0.0002, 120, 150};
  const Raster raster({folder.write("degrees.asc", degrees.text([](double longitude, double latitude) {
                         return 1e5 * (longitude + 2.99) + 10.0 * 1e5 * (latitude - 43.31);
                       })),
                       1, "EPSG:4326"});
  const Vec2d point{-100.0, 250.0};
  const auto height = raster.heights_on({point.x, point.y, 1.0, 1, 1}, example_frame)(0, 0);
  const auto place = place_on_globe(example_frame, point);
  EXPECT_NEAR(static_cast<double>(height), 1e5 * (place.longitude_deg + 2.99) + 1e6 * (place.latitude_deg - 43.31),
              0.1);
  EXPECT_NEAR(raster.centre().latitude_deg, 43.315, 1e-6);
  EXPECT_NEAR(raster.centre().longitude_deg, -2.988, 1e-6);
  // 0.0002° is 22.2 m northward and cos 43.3° of that eastward.
  EXPECT_NEAR(raster.cell_m(example_frame, {0.0, 300.0}), 22.26 * std::cos(43.315 * M_PI / 180.0), 0.05);
}

/// Heights of a raster in degrees that rise eastward and northward, about a frame's origin.
void expect_slope_across(double longitude_deg, double west_deg) {
  const ScratchFolder folder;
  const LocalFrame there(50.0, longitude_deg);
  const AsciiGrid degrees{west_deg, 49.99, 0.0002, 100, 100};
  const Raster raster({folder.write("degrees.asc", degrees.text([&](double x, double y) {
                         return 1e5 * (x - west_deg) + 1e5 * (y - 49.99);
                       })),
                       1, "EPSG:4326"});
  const Extent extent = raster.outline_in(there).extent_inside();
  EXPECT_NEAR(extent.west_m, -717.0, 3.0);  // 0.01° of 71.7 km
  EXPECT_NEAR(extent.east_m, 717.0, 3.0);
  const auto heights = raster.heights_on({-600.0, 600.0, 10.0, 121, 121}, there);
  const auto classes = raster.classes_on({-600.0, 600.0, 10.0, 121, 121}, there);
  for (std::size_t row = 0; row < 121; row += 20) {
    for (std::size_t column = 0; column < 121; column += 20) {
      const auto place =
          place_on_globe(there, {-600.0 + 10.0 * static_cast<double>(column), 600.0 - 10.0 * static_cast<double>(row)});
      double east_deg = place.longitude_deg - west_deg;
      east_deg -= 360.0 * std::round(east_deg / 360.0);
      EXPECT_NEAR(static_cast<double>(heights(column, row)), 1e5 * east_deg + 1e5 * (place.latitude_deg - 49.99), 0.1);
      EXPECT_NE(classes(column, row), no_class);
    }
  }
}

TEST(Raster, LongitudesMayBeCountedFromAnywhere) {
  expect_slope_across(180.0, 179.99);
  expect_slope_across(-180.0, -180.01);
  expect_slope_across(-10.0, 349.99);
  expect_slope_across(0.0, -0.01);
}

// Its seam lies where its longitudes begin, and a place across it is a place like others.
TEST(Raster, ThatGoesRoundTheGlobeHasNoSeam) {
  const ScratchFolder folder;
  // One of cells between the poles, and one of cells centred on them that repeats its first column as its last.
  for (const AsciiGrid& globe : {AsciiGrid{-180.0, -90.0, 0.5, 720, 360}, {-180.25, -90.25, 0.5, 721, 361}}) {
    const Raster raster({folder.write("globe.asc", globe.text([](double x, double y) {
                           return 100.0 * std::cos(x * M_PI / 180.0) + y;
                         })),
                         1, "EPSG:4326"});
    for (const double longitude_deg : {180.0, 179.9, 0.0}) {
      const LocalFrame there(10.0, longitude_deg);
      EXPECT_TRUE(raster.outline_in(there).empty());
      const auto heights = raster.heights_on({-60e3, 60e3, 2000.0, 61, 61}, there);
      const auto classes = raster.classes_on({-60e3, 60e3, 2000.0, 61, 61}, there);
      for (std::size_t i = 0; i < 61; ++i) {
        const auto place = place_on_globe(there, {-60e3 + 2000.0 * static_cast<double>(i), 0.0});
        EXPECT_NEAR(heights(i, 30), 100.0 * std::cos(place.longitude_deg * M_PI / 180.0) + place.latitude_deg, 0.1);
        EXPECT_NE(classes(i, 30), no_class);
      }
    }
  }
}

/// Half the globe's girth in web Mercator, EPSG:3857: π of the semi-major axis.
constexpr double half_turn_m = 6378137.0 * M_PI;

TEST(Raster, ThatGoesRoundTheGlobeInMercatorHasNoSeamEither) {
  const ScratchFolder folder;
  const AsciiGrid globe{-half_turn_m, -0.5 * half_turn_m, half_turn_m / 200.0, 400, 200};
  const Raster raster(
      {folder.write("globe.asc", globe.text([](double x, double) { return 400.0 * std::cos(x / half_turn_m * M_PI); })),
       1, "EPSG:3857"});
  for (const double longitude_deg : {180.0, -179.9, 90.0}) {
    const LocalFrame there(10.0, longitude_deg);
    EXPECT_TRUE(raster.outline_in(there).empty());
    const Lattice across{-3e3, 3e3, 10.0, 601, 3};
    const auto heights = raster.heights_on(across, there);
    const auto classes = raster.classes_on(across, there);
    for (std::size_t i = 0; i < across.columns; ++i) {
      const auto place = place_on_globe(there, {-3e3 + 10.0 * static_cast<double>(i), 3e3});
      // A chord of 1.8° lies less than 1 - cos 0.9° below the curve.
      ASSERT_NEAR(heights(i, 0), 400.0 * std::cos(place.longitude_deg * M_PI / 180.0), 0.1);
      ASSERT_NE(classes(i, 0), no_class);
    }
  }
}

TEST(Raster, MercatorMayBeCountedOnBeyondTheGlobe) {
  const ScratchFolder folder;
  const LocalFrame there(10.0, 180.0);
  const AsciiGrid counted_on{half_turn_m - 50e3, 1.0e6, 1000.0, 100, 300};
  const Raster raster(
      {folder.write("on.asc", counted_on.text([](double x, double) { return 0.01 * (x - half_turn_m); })), 1,
       "EPSG:3857"});
  const Lattice across{-40e3, 0.0, 1000.0, 81, 1};
  const auto heights = raster.heights_on(across, there);
  for (std::size_t i = 0; i < across.columns; ++i) {
    double east_deg = place_on_globe(there, {-40e3 + 1000.0 * static_cast<double>(i), 0.0}).longitude_deg - 180.0;
    east_deg -= 360.0 * std::round(east_deg / 360.0);
    EXPECT_NEAR(heights(i, 0), 0.01 * east_deg / 180.0 * half_turn_m, 0.1) << i;
  }
}

// Its two ends meet at 180° of longitude, but x is not the same at both for any turn: between knots on both sides of it
// there is nothing to interpolate. Of a point on it the mean over 1 km lies 250 m of x lower than the ridge there.
TEST(Raster, MapsThatEndAtAMeridianAreReadOnBothSidesOfIt) {
  const ScratchFolder folder;
  const std::string sinusoidal = "+proj=sinu +lon_0=0 +R=6371007.181 +units=m +no_defs";
  const AsciiGrid globe{-20.1e6, -10.05e6, 100e3, 402, 201};
  const Raster raster(
      {folder.write("globe.asc", globe.text([](double x, double) { return 1e-4 * std::abs(x); })), 1, sinusoidal});
  const LocalFrame there(10.0, 180.0);
  const CoordinateTransform transform(sinusoidal, there, "test");
  for (const Lattice& across :
       {Lattice{-250.0, 50.0, 10.0, 51, 11}, {-25.0, 0.0, 3.0, 17, 1}, {-3e3, 2e3, 1e3, 7, 5}}) {
    const auto heights = raster.heights_on(across, there);
    const auto classes = raster.classes_on(across, there);
    for (std::size_t row = 0; row < across.rows; ++row) {
      for (std::size_t column = 0; column < across.columns; ++column) {
        Vec2d place{across.west_m + across.spacing_m * static_cast<double>(column),
                    across.north_m - across.spacing_m * static_cast<double>(row)};
        transform.to_crs({&place, 1});
        ASSERT_NEAR(heights(column, row), 1e-4 * std::abs(place.x), 0.03) << column << " " << row;
        ASSERT_NEAR(classes(column, row), 1e-4 * std::abs(place.x), 5.1) << column << " " << row;
      }
    }
  }
}

TEST(Raster, AnswersInWhateverFrameItIsAskedIn) {
  const ScratchFolder folder;
  const auto file = folder.write("slope.asc", utm.text([](double x, double y) { return 0.1 * (x - 5e5) + 1e-5 * y; }));
  const Raster raster({file, 1, "EPSG:25830"});
  const Lattice lattice{100.0, -100.0, 10.0, 20, 20};
  for (const LocalFrame& asked :
       {example_frame, LocalFrame(43.311, -2.987), example_frame, LocalFrame(43.312, -2.987)}) {
    const auto heights = raster.heights_on(lattice, asked),
               afresh = Raster({file, 1, "EPSG:25830"}).heights_on(lattice, asked);
    EXPECT_TRUE(std::ranges::equal(heights.values(), afresh.values()));
    EXPECT_FALSE(std::isnan(heights(10, 10)));
  }
}

// A web-Mercator cell is M cos φ / a of its size northward and N cos φ / a eastward, where M and N are the radii of
// curvature along the meridian and across it.
TEST(Raster, CellsAreAsLargeAsTheyAreWhereTheyAreRead) {
  const ScratchFolder folder;
  const AsciiGrid strip{-5e3, 0.0, 1000.0, 10, 9000};
  const auto stripes = [](double, double y) { return std::fmod(std::floor(y / 1000.0), 2.0) == 0.0 ? 0.0 : 40.0; };
  const Raster raster({folder.write("strip.asc", strip.text(stripes)), 1, "EPSG:3857"});
  const double a = 6378137.0, e2 = 0.00669437999;
  for (const double latitude_deg : {1.0, 35.0, 60.0}) {
    const double phi = latitude_deg * M_PI / 180.0;
    const double meridian = a * (1.0 - e2) / std::pow(1.0 - e2 * std::sin(phi) * std::sin(phi), 1.5);
    EXPECT_NEAR(raster.cell_m(LocalFrame(latitude_deg, 0.0), {}), 1000.0 * meridian * std::cos(phi) / a, 0.2);
    // The same place from a frame elsewhere, whose lengths are longer there by x²/2R², 0.03 %.
    const LocalFrame aside(latitude_deg, 2.0 / std::cos(phi));
    EXPECT_NEAR(raster.cell_m(aside, position_in_frame(aside, {latitude_deg, 0.0})),
                1000.0 * meridian * std::cos(phi) / a, 1.0);
  }
  // Two cells of 500 m to a step of 1 km at 60 N, and one to a step at the equator.
  const auto range_of = [&](double latitude_deg) {
    const auto heights = raster.heights_on({0.0, 8e3, 1000.0, 1, 17}, LocalFrame(latitude_deg, 0.0));
    const auto [lowest, highest] = std::ranges::minmax(heights.values());
    return highest - lowest;
  };
  EXPECT_LT(range_of(60.0), 3.0F);
  EXPECT_GT(range_of(1.0), 10.0F);
}

// 36 million cells of 1 m, which took 180 MB at once, as they are commonly stored and turned by 45°.
TEST(Raster, FineCellsUnderACoarseLatticeAreReadPieceByPiece) {
  const ScratchFolder folder;
  folder.write("coarse.asc", AsciiGrid{0.0, 0.0, 1.0, 15, 15}.text(
                                 [](double x, double y) { return std::floor(x) + 100 * std::floor(y); }));
  const Vec2d middle = utm_position({137.0, 71.0});
  for (const Vec2d east : {Vec2d{1.0, 0.0}, Vec2d{std::sqrt(0.5), std::sqrt(0.5)}}) {
    const Vec2d corner = middle - Vec2d{east.x + east.y, east.y - east.x} * 3000.0;
    const std::string placed =
        fmt::format("{}, {}, {}, {}, {}, {}", corner.x, east.x, east.y, corner.y, east.y, -east.x);
    const auto file = folder.write("fine.vrt", R"(<VRTDataset rasterXSize="6000" rasterYSize="6000">
      <SRS>EPSG:25830</SRS><GeoTransform>)" + placed +
                                                   R"(</GeoTransform>
      <VRTRasterBand dataType="Float32" band="1"><SimpleSource>
      <SourceFilename relativeToVRT="1">coarse.asc</SourceFilename><SourceBand>1</SourceBand>
      <SrcRect xOff="0" yOff="0" xSize="15" ySize="15"/><DstRect xOff="0" yOff="0" xSize="6000" ySize="6000"/>
      </SimpleSource></VRTRasterBand></VRTDataset>)");
    const Raster raster({file, 1, ""});
    const Lattice lattice{-3000.0, 3000.0, 300.0, 21, 21};
    const long before_kib = peak_memory_kib();
    const auto classes = raster.classes_on(lattice, example_frame);
    const auto heights = raster.heights_on(lattice, example_frame);
    EXPECT_TRUE(!memory_is_ours || peak_memory_kib() - before_kib < 100'000);
    std::size_t covered = 0;
    for (std::size_t row = 0; row < lattice.rows; ++row) {
      for (std::size_t column = 0; column < lattice.columns; ++column) {
        const Vec2d point{lattice.west_m + 300.0 * static_cast<double>(column),
                          lattice.north_m - 300.0 * static_cast<double>(row)};
        const Vec2d away = utm_position(point) - corner;
        const double right = (away.x * east.x + away.y * east.y) / 400.0,
                     down = (away.x * east.y - away.y * east.x) / 400.0;
        if (std::min(right, down) < 0.0 || std::max(right, down) > 15.0) {
          EXPECT_EQ(classes(column, row), no_class);
          continue;
        }
        ++covered;
        EXPECT_EQ(classes(column, row), static_cast<int>(right) + 100 * (14 - static_cast<int>(down)));
        if ((row + column) % 10 != 0) continue;
        const double alone = raster.heights_on({point.x, point.y, 300.0, 1, 1}, example_frame)(0, 0);
        EXPECT_NEAR(heights(column, row), alone, 1e-3 * alone + 0.01);
      }
    }
    EXPECT_GT(covered, 300U);
  }
}

/// A plain at 100 of that unit, which is empty where the band states none.
std::filesystem::path plain_at_100(const ScratchFolder& folder, const std::string& crs, const std::string& unit) {
  folder.write("plane.asc", utm.text([](double, double) { return 100.0; }));
  return folder.write("unit.vrt", R"(<VRTDataset rasterXSize="100" rasterYSize="80"><SRS>)" + crs + R"(</SRS>
      <GeoTransform>500600, 10, 0, 4795800, 0, -10</GeoTransform><VRTRasterBand dataType="Float32" band="1"><UnitType>)" +
                                      unit + R"(</UnitType><SimpleSource><SourceFilename relativeToVRT="1"
      >plane.asc</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>)");
}

float height_on(const Raster& raster) {
  const Extent extent = raster.outline_in(example_frame).extent_inside();
  return raster.heights_on({extent.west_m + 100.0, extent.north_m - 100.0, 10.0, 1, 1}, example_frame)(0, 0);
}

TEST(Raster, UnitsOfHeightsAreThoseOfTheBand) {
  const ScratchFolder folder;
  const auto height_in = [&](const std::string& unit) {
    return height_on(Raster({plain_at_100(folder, "EPSG:25830", unit), 1, ""}));
  };
  for (const char* metre : {"", "m", "Metre", "meters"}) EXPECT_FLOAT_EQ(height_in(metre), 100.0F) << metre;
  for (const char* foot : {"ft", "Feet", "foot"}) EXPECT_FLOAT_EQ(height_in(foot), 30.48F) << foot;
  for (const char* foot : {"us-ft", "US survey foot", "Foot_US"}) EXPECT_FLOAT_EQ(height_in(foot), 30.480061F) << foot;
  EXPECT_FLOAT_EQ(height_in("cm"), 1.0F);
  for (const char* unknown : {"0.1 m", "'", "%"})
    EXPECT_THAT(message_of_error([&] { static_cast<void>(height_in(unknown)); }), HasSubstr("is no known unit"))
        << unknown;
  EXPECT_THAT(message_of_error([&] { static_cast<void>(height_in("fathom")); }),
              AllOf(HasSubstr("unit.vrt: counts heights in 'fathom', which is no known unit; convert it to metres"),
                    HasSubstr("unit in a scene's [terrain]"), HasSubstr("--unit of 'atlas terrain'")));
}

TEST(Raster, UnitsOfHeightsAreThoseOfTheVerticalAxisWhereTheBandStatesNone) {
  const ScratchFolder folder;
  const std::string in_us_feet = "EPSG:25830+6360", in_feet = "EPSG:25830+8228", in_metres = "EPSG:25830+5773";
  const auto height_in = [&](const std::string& crs, const std::string& unit, const std::string& stated_crs) {
    return height_on(Raster({plain_at_100(folder, crs, unit), 1, stated_crs}));
  };
  EXPECT_FLOAT_EQ(height_in(in_us_feet, "", ""), 30.480061F);
  EXPECT_FLOAT_EQ(height_in(in_feet, "", ""), 30.48F);
  EXPECT_FLOAT_EQ(height_in(in_metres, "", ""), 100.0F);
  EXPECT_FLOAT_EQ(height_in(in_feet, "m", ""), 100.0F) << "the band is nearer to its heights";
  EXPECT_FLOAT_EQ(height_in("EPSG:25830", "", in_feet), 30.48F);
  EXPECT_FLOAT_EQ(height_in(in_feet, "", in_metres), 100.0F);
  EXPECT_FLOAT_EQ(height_in(in_feet, "", "EPSG:25830"), 30.48F) << "the one stated is of places alone";
}

TEST(Raster, StatedUnitOfHeightsOverridesTheFile) {
  const ScratchFolder folder;
  const auto file = plain_at_100(folder, "EPSG:25830+8228", "fathom");
  EXPECT_FLOAT_EQ(height_on(Raster({file, 1, "", "m"})), 100.0F);
  EXPECT_FLOAT_EQ(height_on(Raster({file, 1, "", "ft"})), 30.48F);
  EXPECT_FLOAT_EQ(height_on(Raster({file, 1, "", "us-ft"})), 30.480061F);
}

// Most of such rasters hold metres, or say what they hold.
TEST(Raster, MapsInFeetAloneMakeHeightsInMetresThatAreAGuess) {
  const ScratchFolder folder;
  const auto unit_of = [&](const std::string& crs, const std::string& unit, const std::string& stated) {
    return Raster({plain_at_100(folder, crs, unit), 1, "", stated}).height_unit();
  };
  for (const char* in_feet : {"EPSG:2263", "EPSG:2222"}) {
    EXPECT_EQ(unit_of(in_feet, "", "").metres, 1.0) << in_feet;
    EXPECT_TRUE(unit_of(in_feet, "", "").is_guess) << in_feet;
    EXPECT_FALSE(unit_of(in_feet, "m", "").is_guess) << in_feet;
    EXPECT_FALSE(unit_of(in_feet, "", "m").is_guess) << in_feet;
  }
  EXPECT_FALSE(unit_of("EPSG:2263+6360", "", "").is_guess);
  EXPECT_FALSE(unit_of("EPSG:25830", "", "").is_guess);
}

TEST(Raster, CoarseLatticeTakesTheMeanOfItsCell) {
  const ScratchFolder folder;
  const auto stripes = [](double x, double) { return std::fmod(std::floor(x / 10.0), 2.0) == 0.0 ? 0.0 : 4.0; };
  const Raster raster({folder.write("stripes.asc", utm.text(stripes)), 1, "EPSG:25830"});
  const Lattice lattice = lattice_inside(raster, 40.0);
  const auto heights = raster.heights_on(lattice, example_frame);
  EXPECT_NEAR(static_cast<double>(heights(5, 5)), 2.0, 0.3);
  EXPECT_NEAR(static_cast<double>(heights(8, 9)), 2.0, 0.3);
}

TEST(Raster, NoDataReadsAsNaNAndSpoilsNoNeighbour) {
  const ScratchFolder folder;
  const auto holed = [](double x, double y) { return x > 501'000.0 && y > 4'795'400.0 ? std::nan("") : 50.0; };
  const Raster raster({folder.write("holed.asc", utm.text(holed)), 1, "EPSG:25830"});
  const auto heights = raster.heights_on(lattice_inside(raster, 10.0), example_frame);
  std::size_t holes = 0;
  for (const float height : heights.values()) {
    if (std::isnan(height)) {
      ++holes;
    } else {
      ASSERT_NEAR(static_cast<double>(height), 50.0, 1e-4);
    }
  }
  EXPECT_NEAR(static_cast<double>(holes), 60.0 * 40.0, 110.0);
}

TEST(Raster, OutsideIsNaNAndNoClass) {
  const ScratchFolder folder;
  const Raster raster({folder.write("flat.asc", utm.text([](double, double) { return 7.0; })), 1, "EPSG:25830"});
  const Lattice far_away{90'000.0, 90'000.0, 10.0, 3, 3};
  EXPECT_TRUE(std::isnan(raster.heights_on(far_away, example_frame)(1, 1)));
  EXPECT_EQ(raster.classes_on(far_away, example_frame)(1, 1), no_class);
}

TEST(Raster, ClassesAreThoseOfTheNearestCell) {
  const ScratchFolder folder;
  const auto classes = [](double x, double y) { return y > 4'795'400.0 ? (x > 501'000.0 ? 10.0 : 30.0) : 80.0; };
  const Raster raster({folder.write("classes.asc", utm.text(classes)), 1, "EPSG:25830"});
  const Lattice lattice = lattice_inside(raster, 3.0);
  const auto read = raster.classes_on(lattice, example_frame);
  for (std::size_t row = 0; row < lattice.rows; ++row) {
    for (std::size_t column = 0; column < lattice.columns; ++column) {
      const Vec2d p = utm_position(
          {lattice.west_m + 3.0 * static_cast<double>(column), lattice.north_m - 3.0 * static_cast<double>(row)});
      if (std::abs(p.x - 501'000.0) < 0.01 || std::abs(p.y - 4'795'400.0) < 0.01) continue;
      ASSERT_EQ(read(column, row), static_cast<std::int32_t>(classes(p.x, p.y)));
    }
  }
}

TEST(Raster, WithoutCrsIsAnErrorThatSaysHowToStateIt) {
  const ScratchFolder folder;
  const auto file = folder.write("lost.asc", utm.text([](double, double) { return 1.0; }));
  const std::string message = message_of_error([&] { Raster({file, 1, ""}); });
  EXPECT_NE(message.find("lost.asc: carries no coordinate reference system"), std::string::npos) << message;
  EXPECT_NE(message.find("with the key crs or the option --crs"), std::string::npos) << message;
}

TEST(Raster, CrsThatIsNotKnownIsLaidToTheKeyThatStatesIt) {
  const ScratchFolder folder;
  const auto file = folder.write("flat.asc", utm.text([](double, double) { return 7.0; }));
  for (const char* unknown : {"hello", "EPSG:99999999"}) {
    const std::string message = message_of_error([&] { Raster({file, 1, unknown}); });
    EXPECT_NE(message.find("flat.asc: crs: the coordinate reference system '" + std::string(unknown)),
              std::string::npos)
        << message;
  }
}

TEST(Raster, NumbersThatAreNoDegreesAreNotLaidToTheFrame) {
  const ScratchFolder folder;
  constexpr AsciiGrid in_metres{501'000.0, 4'790'550.0, 10.0, 4, 5};
  const auto file = folder.write("m.asc", in_metres.text([](double, double) { return 1.0; }));
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(Raster({file, 1, "EPSG:4326"}));
              }),
              AllOf(HasSubstr("m.asc: crs: 'EPSG:4326' counts in degrees"),
                    HasSubstr("rows lie at 4790550 to 4790600, which are none"), HasSubstr("EPSG:25830 for metres")));
  // Of the whole globe, with cells centred on the poles.
  constexpr AsciiGrid globe{-180.5, -90.5, 1.0, 361, 181};
  const auto whole = folder.write("globe.asc", globe.text([](double, double) { return 1.0; }));
  EXPECT_NO_THROW(Raster({whole, 1, "EPSG:4326"}));
}

TEST(Raster, MissingFileWrongFormatAndWrongBandAreErrors) {
  const ScratchFolder folder;
  EXPECT_NE(message_of_error([&] {
              Raster({folder.path("none.tif"), 1, ""});
            }).find("does not exist"),
            std::string::npos);
  const auto loop = folder.path("loop.tif");
  std::filesystem::create_symlink(loop, loop);
  EXPECT_NE(message_of_error([&] { Raster({loop, 1, ""}); }).find("loop.tif: is not a raster"), std::string::npos);
  const auto text = folder.write("notes.txt", "no raster");
  EXPECT_NE(message_of_error([&] { Raster({text, 1, ""}); }).find("is not a raster"), std::string::npos);
  const auto one_band = folder.write("flat.asc", utm.text([](double, double) { return 7.0; }));
  EXPECT_NE(message_of_error([&] { Raster({one_band, 2, "EPSG:25830"}); }).find("has no band 2"), std::string::npos);
}

// A mosaic names its tiles, and not what lies beside them.
TEST(Raster, DigestsAreOfAllThatTheTilesOfAMosaicAreReadFrom) {
  const ScratchFolder folder;
  folder.write("tile.asc", utm.text([](double, double) { return 7.0; }));
  const auto mosaic = folder.write("mosaic.vrt", R"(<VRTDataset rasterXSize="100" rasterYSize="80"><SRS>EPSG:25830</SRS>
      <GeoTransform>500600, 10, 0, 4795800, 0, -10</GeoTransform><VRTRasterBand dataType="Float32" band="1"><SimpleSource>
      <SourceFilename relativeToVRT="1">tile.asc</SourceFilename><SourceBand>1</SourceBand>
      </SimpleSource></VRTRasterBand></VRTDataset>)");
  EXPECT_EQ(Raster({mosaic, 1, ""}).digests().size(), 2U);
  folder.write("tile.prj", "Projection UTM\nZone 30\nDatum WGS84\nUnits METERS\n");
  EXPECT_EQ(Raster({mosaic, 1, ""}).digests().size(), 3U);
}

}  // namespace
}  // namespace sigmascape::geo
