#include "sigmascape/terrain/terrain_reader.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "peak_memory.h"
#include "scratch_folder.h"
#include "unit/geo/ascii_grid.h"

#include "sigmascape/base/machine_memory.h"
#include "sigmascape/terrain/pyramid_builder.h"
#include "sigmascape/terrain/pyramid_files.h"

namespace sigmascape::terrain {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr geo::AsciiGrid grid{500'600.0, 4'795'000.0, 10.0, 100, 80};
const geo::LocalFrame frame(43.312, -2.986);

class TerrainReader : public ::testing::Test {
 protected:
  template <typename Value>
  TerrainSource source(const Value& value) {
    TerrainSource result;
    result.raster = {folder_.write("heights.asc", grid.text(value)), 1, "EPSG:25830"};
    return result;
  }
  ScratchFolder folder_;
};

TEST_F(TerrainReader, CoversTheRasterByDefault) {
  const auto read = read_terrain(source([](double, double) { return 12.0; }), frame, std::nullopt);
  EXPECT_NEAR(read.field.extent().width_m(), 1000.0, 12.0);
  EXPECT_NEAR(read.field.extent().height_m(), 800.0, 12.0);
  EXPECT_NEAR(read.field.spacing_m, 10.0, 0.01);
  EXPECT_EQ(read.filled_nodes, 0U);
}

TEST_F(TerrainReader, FillsAHoleFromItsEdge) {
  const auto plane = [](double x, double y) { return 0.1 * (x - 500'600.0) + 0.05 * (y - 4'795'000.0); };
  const auto whole = read_terrain(source(plane), frame, std::nullopt);
  const auto holed =
      read_terrain(source([&](double x, double y) {
                     return std::hypot(x - 501'100.0, y - 4'795'400.0) < 60.0 ? std::nan("") : plane(x, y);
                   }),
                   frame, std::nullopt);
  EXPECT_NEAR(static_cast<double>(holed.filled_nodes), M_PI * 36.0, 12.0);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(holed.filled.values(), 1)), holed.filled_nodes);
  EXPECT_EQ(holed.filled(holed.filled.columns() / 2, holed.filled.rows() / 2), 1);
  for (std::size_t i = 0; i < whole.field.height_m.size(); ++i) {
    ASSERT_NEAR(static_cast<double>(holed.field.height_m.values()[i]),
                static_cast<double>(whole.field.height_m.values()[i]), 0.6);
  }
}

TEST_F(TerrainReader, MostlyMissingTerrainIsAnError) {
  const auto mostly = source([](double x, double) { return x < 500'800.0 ? 5.0 : std::nan(""); });
  EXPECT_THAT(
      message_of_error([&] { static_cast<void>(read_terrain(mostly, frame, std::nullopt)); }),
      AllOf(HasSubstr("% of the scene's terrain has no height between"), HasSubstr("or raise max_flawed_share")));
  const auto nowhere = source([](double, double) { return std::nan(""); });
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_terrain(nowhere, frame, std::nullopt)); }),
              AllOf(HasSubstr("100 % of the scene's terrain"), Not(HasSubstr("max_flawed_share"))));
}

TEST_F(TerrainReader, ImplausibleHeightsCountAsMissing) {
  const auto read = read_terrain(
      source([](double x, double y) { return x > 501'000 && x < 501'050 && y < 4'795'200 ? 25'000.0 : 40.0; }), frame,
      std::nullopt);
  EXPECT_GT(read.filled_nodes, 50U);
  EXPECT_NEAR(static_cast<double>(read.field.highest_m()), 40.0, 1e-3);
}

TEST_F(TerrainReader, ExtentWithoutOverlapIsAnErrorThatSaysWhereTheTerrainIs) {
  const auto flat = source([](double, double) { return 1.0; });
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(read_terrain(flat, frame, radar::Rectangle{90'000, 0, 91'000, 1'000}));
              }),
              HasSubstr("does not overlap the scene's extent; move the extent into"));
}

// Of cells between the poles, and of cells centred on them that repeats its first column, as global relief is stored.
TEST_F(TerrainReader, AGlobeIsTerrainOfAnyExtent) {
  for (const geo::AsciiGrid& globe : {geo::AsciiGrid{-180.0, -90.0, 1.0, 360, 180}, {-180.5, -90.5, 1.0, 361, 181}}) {
    TerrainSource whole;
    whole.raster = {folder_.write("globe.asc", globe.text([](double, double y) { return 10.0 * y; })), 1, "EPSG:4326"};
    whole.spacing_m = 1000.0;
    for (const double longitude_deg : {-180.0, -2.986, 91.0}) {
      const geo::LocalFrame there(43.312, longitude_deg);
      const auto read = read_terrain(whole, there, radar::Rectangle{-20e3, -20e3, 20e3, 20e3});
      EXPECT_EQ(read.filled_nodes, 0U);
      EXPECT_NEAR(static_cast<double>(read.field.height_m(20, 20)), 433.12, 0.1);
    }
    EXPECT_THAT(message_of_error([&] { static_cast<void>(read_terrain(whole, frame, std::nullopt)); }),
                HasSubstr("globe.asc: reaches too far for a scene of all of it; state the extent"));
  }
}

TEST_F(TerrainReader, MoreHeightsThanMemoryHoldsAreAnErrorThatSaysWhatSpacingWouldDo) {
  TerrainSource fine = source([](double, double) { return 1.0; });
  fine.spacing_m = 0.1;
  const radar::Rectangle wide{-100'000.0, -100'000.0, 100'000.0, 100'000.0};
  const std::string fault = message_of_error([&] { static_cast<void>(read_terrain(fine, frame, wide)); });
  EXPECT_THAT(fault, HasSubstr("heights.asc: heights every 0.1 m over 200000 × 200000 m are 2000001 × 2000001"));
  const std::string proposal = "choose a spacing of ";
  ASSERT_THAT(fault, HasSubstr(proposal));
  const double fitting_m = std::stod(fault.substr(fault.find(proposal) + proposal.size()));
  EXPECT_GT(fitting_m, 0.1);
  fine.spacing_m = 0.9 * fitting_m;
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_terrain(fine, frame, wide)); }), HasSubstr(proposal));
}

// Maps from an atlas need the heights alone, not what rays need over them, which is three times as much.
TEST_F(TerrainReader, RoomForReadingIsEnough) {
  TerrainSource fine = source([](double, double) { return 1.0; });
  fine.raster.unit = "fathom";  // refused before a height is read
  const auto fault_at = [&](double bytes_a_height) {
    const double side_m = std::sqrt(machine_memory_bytes() / bytes_a_height) * 0.01;
    fine.spacing_m = 0.01;
    return message_of_error([&] {
      static_cast<void>(read_terrain(fine, frame, radar::Rectangle{0.0, 0.0, side_m, side_m}));
    });
  };
  EXPECT_THAT(fault_at(15.0), HasSubstr("counts heights in 'fathom'"));
  EXPECT_THAT(fault_at(10.0), HasSubstr("GB of memory to read"));
}

// A list of holes took 16 bytes and more for each, which were not reckoned with.
TEST_F(TerrainReader, FillingTakesNoMoreMemoryWhereMostIsMissing) {
  const long before_kib = peak_memory_kib();
  Array2D<float> heights(2000, 2000, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t row = 0; row < heights.rows(); ++row) {
    for (std::size_t column = 0; column < heights.columns(); column += 10) heights(column, row) = 100.0F;
  }
  EXPECT_EQ(fill_holes(heights), heights.size() / 10 * 9);
  EXPECT_TRUE(std::ranges::all_of(heights.values(), [](float height) { return std::abs(height - 100.0F) < 1e-3F; }));
  EXPECT_TRUE(!memory_is_ours || peak_memory_kib() - before_kib < 4'000'000L * 12 / 1024);
}

// A web-Mercator cell of 1 km is M cos φ / a of that northward: 500.4 m at 60 N, whatever it is where the raster has
// its middle.
TEST_F(TerrainReader, SpacingIsTheCellOfWhereItReads) {
  TerrainSource strip;
  const geo::AsciiGrid mercator{-10e3, 0.0, 1000.0, 20, 9000};
  strip.raster = {folder_.write("strip.asc", mercator.text([](double, double y) { return 1e-4 * y; })), 1, "EPSG:3857"};
  const geo::LocalFrame there(60.0, 0.0);
  const radar::Rectangle wanted{-4e3, -4e3, 4e3, 4e3};
  EXPECT_NEAR(read_terrain(strip, there, wanted).field.spacing_m, 500.4, 0.2);
  build_pyramid(folder_.path("pyramid"), strip, there, wanted);
  EXPECT_NEAR(open_pyramid(folder_.path("pyramid"), 0).layout().spacing_m, 500.4, 0.2);
}

TEST_F(TerrainReader, PyramidsOfHeightsInAnotherUnitAreMadeAnew) {
  TerrainSource level = source([](double, double) { return 100.0; });
  level.spacing_m = 20.0;
  const radar::Rectangle extent = read_terrain(level, frame, std::nullopt).field.extent();
  const auto tiles_written = [&] { return build_pyramid(folder_.path("pyramid"), level, frame, extent).tiles_written; };
  EXPECT_GT(tiles_written(), 0U);
  EXPECT_EQ(tiles_written(), 0U);
  level.raster.unit = "ft";
  EXPECT_GT(tiles_written(), 0U);
}

/// Whole-metre heights of a slope of 3 %, as rounding leaves them.
Array2D<float> terraces() {
  Array2D<float> heights(200, 40);
  for (std::size_t row = 0; row < 40; ++row) {
    for (std::size_t column = 0; column < 200; ++column)
      heights(column, row) = std::round(0.15F * static_cast<float>(column));
  }
  return heights;
}

TEST(SmoothWithin, TurnsTerracesIntoTheSlopeTheyCameFrom) {
  Array2D<float> heights = terraces();
  smooth_within(heights, 0.5);
  for (std::size_t column = 20; column < 180; ++column) {
    const float step = heights(column + 1, 20) - heights(column, 20);
    EXPECT_NEAR(static_cast<double>(step), 0.15, 0.03) << column;
  }
}

TEST(SmoothWithin, MovesNoHeightFurtherThanTheTolerance) {
  const Array2D<float> before = terraces();
  Array2D<float> after = before;
  smooth_within(after, 0.3);
  double furthest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    furthest =
        std::max(furthest, std::abs(static_cast<double>(after.values()[i]) - static_cast<double>(before.values()[i])));
  }
  EXPECT_LE(furthest, 0.3 + 1e-5);
  EXPECT_GT(furthest, 0.2);
}

}  // namespace
}  // namespace sigmascape::terrain
