#include "sigmascape/product/picture.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>

#include "unit/product/made_up_map.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/product/described_map.h"
#include "sigmascape/product/legend.h"

namespace sigmascape::product {
namespace {

using radar::GroundMap;
using radar::Polarization;

/// One row of cells at −50, −40, … 0 dB.
GroundMap ramp() {
  return map_of(6, 1, [](auto c, auto) { return std::pow(10.0, static_cast<double>(c) - 5.0); });
}

TEST(Picture, SpanAndTopSetTheGreyLevels) {
  const Picture picture = picture_of(ramp(), {.span_db = 50.0, .top_db = 0.0});
  const int levels[] = {0, 51, 102, 153, 204, 255};
  for (std::size_t column = 0; column < 6; ++column) EXPECT_EQ(picture.pixels(column, 0).red, levels[column]);
  EXPECT_EQ(picture.bottom_db, -50.0);
  EXPECT_EQ(picture.top_db, 0.0);
}

TEST(Picture, WhatLiesOutsideTheSpanTakesItsEnds) {
  const Picture picture = picture_of(ramp(), {.span_db = 25.0, .top_db = -10.0});
  const int levels[] = {0, 0, 51, 153, 255, 255};
  for (std::size_t column = 0; column < 6; ++column) EXPECT_EQ(picture.pixels(column, 0).red, levels[column]);
}

TEST(Picture, TopIsThePercentileOfTheCellsWithPower) {
  GroundMap map = map_of(102, 1, [](auto c, auto) { return std::pow(10.0, static_cast<double>(c) / 100.0); });
  map.sigma0(100, 0).vv = 0.0F;
  map.sigma0(101, 0).vv = unseen_power;
  // 100 cells at 0.0, 0.1, … 9.9 dB.
  EXPECT_NEAR(percentile_top_db(map, {.top_percentile = 100.0}), 9.9, 1e-5);
  EXPECT_NEAR(percentile_top_db(map, {.top_percentile = 50.0}), 4.9, 1e-5);
  EXPECT_NEAR(picture_of(map, {.top_percentile = 90.0}).top_db, 8.9, 1e-5);
}

TEST(Picture, UnseenIsDarkBlueOrTransparentAndPowerlessIsBlack) {
  GroundMap map = ramp();
  map.sigma0(2, 0).vv = unseen_power;
  map.sigma0(3, 0).vv = 0.0F;
  const Picture opaque = picture_of(map, {.top_db = 0.0});
  EXPECT_EQ(opaque.pixels(2, 0), unseen_colour);
  EXPECT_EQ(opaque.pixels(3, 0), (Rgba{0, 0, 0, 255}));
  const Picture clear = picture_of(map, {.top_db = 0.0, .transparent_unseen = true});
  EXPECT_EQ(clear.pixels(2, 0).alpha, 0);
  EXPECT_EQ(clear.pixels(3, 0).alpha, 255);
}

TEST(Picture, PolarizationIsChosen) {
  GroundMap map = map_of(1, 1, [](auto, auto) { return 1.0; });
  map.sigma0(0, 0).hv = 0.1F;
  const auto grey = [&](Polarization p) {
    return picture_of(map, {.polarization = p, .span_db = 51.0, .top_db = 1.0}).pixels(0, 0).red;
  };
  EXPECT_EQ(grey(Polarization::VV), 250);
  EXPECT_EQ(grey(Polarization::HV), 200);
  EXPECT_EQ(grey(Polarization::HH), 0);
  EXPECT_EQ(grey(Polarization::Sum), 254);
}

TEST(Picture, ScopeLookMakesAPointBloom) {
  const GroundMap point = map_of(21, 21, [](auto c, auto r) { return c == 10 && r == 10 ? 1.0 : 1e-6; });
  PictureOptions options = scope_look();
  options.top_db = 0.0;
  const Picture bloomed = picture_of(point, options);
  EXPECT_GT(bloomed.pixels(11, 10).green, 100);
  EXPECT_GT(bloomed.pixels(11, 10).green, bloomed.pixels(11, 10).red);
  options.low_pass_cells = 0.0;
  EXPECT_EQ(picture_of(point, options).pixels(11, 10).green, 0);
}

TEST(Picture, MagnifiedCellsKeepTheirPlace) {
  const Picture picture = picture_of(ramp(), {.span_db = 50.0, .top_db = 0.0, .magnification = 3});
  ASSERT_EQ(picture.pixels.columns(), 18U);
  ASSERT_EQ(picture.pixels.rows(), 3U);
  EXPECT_EQ(picture.pixels(5, 2).red, 51);
  EXPECT_EQ(picture.pixels(6, 0).red, 102);
  EXPECT_EQ(picture.grid.extent(), ramp().grid.extent());
}

TEST(Picture, DifferenceIsZeroInTheMiddleRedAboveBlueBelow) {
  const GroundMap truth = map_of(4, 1, [](auto, auto) { return 0.1; });
  GroundMap tested = map_of(4, 1, [](auto c, auto) { return c == 0 ? 0.1 : c == 1 ? 1.0 : 0.01; });
  tested.sigma0(3, 0).vv = unseen_power;
  const Picture picture = difference_picture(tested, truth, {.span_db = 20.0});
  EXPECT_EQ(picture.pixels(0, 0), colour_at(ColourScale::Diverging, 0.5));
  EXPECT_EQ(picture.pixels(1, 0), colour_at(ColourScale::Diverging, 1.0));
  EXPECT_EQ(picture.pixels(2, 0), colour_at(ColourScale::Diverging, 0.0));
  EXPECT_EQ(picture.pixels(3, 0), unseen_colour);
}

TEST(Picture, BelowTheFloorNothingDiffers) {
  const GroundMap dark = map_of(1, 1, [](auto, auto) { return 0.0; });
  const GroundMap darker = map_of(1, 1, [](auto, auto) { return 1e-5; });
  EXPECT_EQ(difference_picture(dark, darker).pixels(0, 0), colour_at(ColourScale::Diverging, 0.5));
}

TEST(Picture, OptionsThatCannotBeAreRefused) {
  EXPECT_THROW((void)picture_of(ramp(), {.span_db = 0.0}), Error);
  EXPECT_THROW((void)picture_of(ramp(), {.top_percentile = 101.0}), Error);
  EXPECT_THROW((void)picture_of(ramp(), {.low_pass_cells = -1.0}), Error);
  EXPECT_THROW((void)picture_of(ramp(), {.magnification = 0}), Error);
  EXPECT_THROW((void)picture_of(ramp(), {.span_db = HUGE_VAL}), Error);
  EXPECT_THROW((void)picture_of(ramp(), {.top_db = NAN}), Error);
  EXPECT_THROW((void)picture_of(GroundMap{}), Error);
  EXPECT_THROW((void)difference_picture(ramp(), map_of(3, 3, [](auto, auto) { return 1.0; })), Error);
}

TEST(Legend, StandsBelowTheGroundAndChangesNoneOfIt) {
  const GroundMap map = map_of(300, 40, [](auto c, auto) { return static_cast<double>(c + 1); });
  const Picture plain = picture_of(map);
  const Picture framed = with_legend(plain);
  EXPECT_EQ(framed.pixels.columns(), 300U);
  EXPECT_GT(framed.pixels.rows(), 50U);
  EXPECT_EQ(framed.grid, plain.grid);
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
    ASSERT_EQ(framed.pixels.values()[i], plain.pixels.values()[i]);
  }
}

/// The longest run of ink between the colours and the arrow below a picture of 4 rows.
std::size_t scale_bar_of(const Picture& framed) {
  std::size_t longest = 0;
  for (std::size_t row = 4; row < framed.pixels.rows(); ++row) {
    std::size_t run = 0;
    for (std::size_t column = 120; column < 280; ++column) {
      run = framed.pixels(column, row).red > 200 ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  }
  return longest;
}

TEST(Legend, ScaleBarHasItsRoundLength) {
  // 300 cells of 2 m: a quarter is 150 m, the bar 100 m = 50 pixels of solid ink in one row.
  const Picture framed = with_legend(picture_of(map_of(300, 4, [](auto, auto) { return 1.0; })));
  EXPECT_EQ(scale_bar_of(framed), 50U);
}

TEST(Legend, ScaleBarIsOfTheGroundInAnyCoordinateSystem) {
  // Cells of 2e-5°, of which at 60° north 1.116 m go eastward: a quarter of 300 is 84 m, the bar 50 m = 45 pixels.
  GroundMap map = map_of(300, 4, [](auto, auto) { return 1.0; });
  map.grid.west_m = 10.0;
  map.grid.north_m = 60.0;
  map.grid.cell_m = 2e-5;
  map.crs = "EPSG:4326";
  const Picture framed = with_legend(picture_of(map));
  EXPECT_EQ(scale_bar_of(framed), 45U);
}

TEST(Legend, LeavesOutWhatWouldLie) {
  // The arrow stands at the right, the bar between it and the colours.
  const auto has_ink = [](const Picture& framed, std::size_t first, std::size_t last) {
    for (std::size_t row = 4; row < framed.pixels.rows(); ++row) {
      for (std::size_t column = first; column < last; ++column)
        if (framed.pixels(column, row).red > 200) return true;
    }
    return false;
  };
  const Picture plain = picture_of(map_of(300, 4, [](auto, auto) { return 1.0; }));
  const Picture turned = with_legend(plain, {.north_arrow = false}),
                drawn_out = with_legend(plain, {.scale_bar = false}),
                coloured_at_will = with_legend(plain, {.colour_scale = false});
  EXPECT_TRUE(has_ink(turned, 120, 280));
  EXPECT_FALSE(has_ink(turned, 285, 300));
  EXPECT_FALSE(has_ink(drawn_out, 120, 280));
  EXPECT_TRUE(has_ink(drawn_out, 285, 300));
  EXPECT_TRUE(has_ink(turned, 80, 116)) << "the end of the colours";
  EXPECT_FALSE(has_ink(coloured_at_will, 80, 116));
  EXPECT_TRUE(has_ink(coloured_at_will, 6, 56)) << "the scale bar in their place";
}

TEST(Legend, NamesTheMiddleOfDifferences) {
  // The colours end at 116 pixels; the numbers of their ends leave room between them.
  const auto has_ink_between_the_ends = [](const Picture& framed) {
    for (std::size_t row = framed.pixels.rows() - 13; row < framed.pixels.rows(); ++row) {
      for (std::size_t column = 50; column < 70; ++column)
        if (framed.pixels(column, row).red > 200) return true;
    }
    return false;
  };
  const GroundMap map = map_of(300, 4, [](auto, auto) { return 1.0; });
  EXPECT_TRUE(has_ink_between_the_ends(with_legend(difference_picture(map, map))));
  EXPECT_FALSE(has_ink_between_the_ends(with_legend(picture_of(map))));
}

/// Pixels of ink in the squares of the arrow that says whence the radar looks: [top, bottom][left, right].
std::array<std::array<int, 2>, 2> ink_of_look_arrow(const std::string& radar_azimuth_deg,
                                                    const GroundMap& map = map_of(300, 4,
                                                                                  [](auto, auto) { return 1.0; })) {
  Picture picture = picture_of(map);
  if (!radar_azimuth_deg.empty()) picture.metadata[radar_azimuth_key] = radar_azimuth_deg;
  const Picture framed = with_legend(picture);
  std::array<std::array<int, 2>, 2> ink{};
  for (std::size_t y = 0; y < 13; ++y) {
    for (std::size_t x = 0; x < 13; ++x) {
      if (x != 6 && y != 6 && framed.pixels(255 + x, 6 + y).red > 200) ++ink[y / 7][x / 7];
    }
  }
  return ink;
}

TEST(Legend, AnArrowPointsAwayFromTheRadar) {
  // Its head has more ink than its tail.
  const auto east = ink_of_look_arrow("90.00"), north = ink_of_look_arrow("0.00"),
             south_east = ink_of_look_arrow("135.00");
  EXPECT_GT(east[0][0] + east[1][0], 2 * (east[0][1] + east[1][1]));
  EXPECT_GT(north[1][0] + north[1][1], 2 * (north[0][0] + north[0][1]));
  EXPECT_GT(south_east[0][0], south_east[1][1]);
  for (const char* none : {"", "above", "nan"}) EXPECT_EQ(ink_of_look_arrow(none)[0][0], 0) << none;
}

/// A map about the west's end of the 60th parallel of a frame: true north lies 14° from the frame's, tan 60° tanh(x/R).
GroundMap map_of_turned_north() {
  GroundMap map = map_of(300, 4, [](auto, auto) { return 1.0; });
  map.crs = geo::LocalFrame(60.0, 0.0).proj();
  map.grid.west_m = 900e3;
  map.grid.north_m = 0.0;
  return map;
}

// That is stated in the frame, whose north need not be the true one.
TEST(Legend, TheArrowAwayFromTheRadarIsAsTheFrameHasIt) {
  const auto upright = ink_of_look_arrow("0.00");
  EXPECT_EQ(upright[1][0], upright[1][1]);
  EXPECT_EQ(ink_of_look_arrow("0.00", map_of_turned_north()), upright);
}

// In a map in another system, a frame about its own middle, that is turned back by what true north is turned there.
TEST(Legend, TheArrowAwayFromTheRadarIsTurnedWithTheMap) {
  const GroundMap in_frame = map_of_turned_north();
  const geo::GeographicPosition middle = geo::place_on_globe(in_frame.crs, in_frame.grid.extent().centre(), "map");
  GroundMap map = map_of(300, 4, [](auto, auto) { return 1.0; });
  map.crs = geo::LocalFrame(middle.latitude_deg, middle.longitude_deg).proj();
  map.grid.west_m = -300.0;
  map.grid.north_m = 4.0;
  map.metadata[local_frame_key] = in_frame.crs;
  const double turned_deg = deg_from_radians(std::atan(std::tan(radians_from_deg(60.0)) * std::tanh(900.3 / 6371.0)));
  EXPECT_NE(ink_of_look_arrow("0.00", map), ink_of_look_arrow("0.00"));
  EXPECT_EQ(ink_of_look_arrow(fmt::format("{}", 90.0 - turned_deg), map), ink_of_look_arrow("90.00"));
}

// Of a polar map, on its axis of x: north, where the pole is, lies to the left.
TEST(Legend, NorthIsWhereTheCoordinateSystemHasIt) {
  GroundMap map = map_of(300, 4, [](auto, auto) { return 1.0; });
  const auto ink = [&] {
    const Picture framed = with_legend(picture_of(map));
    std::array<int, 2> halves{};
    for (std::size_t y = 10; y < 18; ++y) {
      for (std::size_t x = 0; x < 9; ++x)
        if (x != 4 && framed.pixels(285 + x, y).red > 200) ++halves.at(x > 4 ? 1 : 0);
    }
    return halves;
  };
  const auto upright = ink();
  EXPECT_GT(upright[0], 4);
  EXPECT_EQ(upright[0], upright[1]);
  map.crs = "EPSG:3413";
  map.grid.west_m = 1e6;
  map.grid.north_m = 0.0;
  const auto turned = ink();
  EXPECT_GT(turned[0], 2);
  EXPECT_GT(turned[1], 2 * turned[0]) << "the tip is on the left";
}

TEST(Legend, RoundLengthsAreOneTwoAndFive) {
  EXPECT_DOUBLE_EQ(round_length_m(150.0), 100.0);
  EXPECT_DOUBLE_EQ(round_length_m(499.0), 200.0);
  EXPECT_DOUBLE_EQ(round_length_m(500.0), 500.0);
  EXPECT_DOUBLE_EQ(round_length_m(1000.0), 1000.0);
  EXPECT_DOUBLE_EQ(round_length_m(0.3), 0.2);
}

TEST(Legend, PicturesTooNarrowForItStayAsTheyAre) {
  EXPECT_EQ(with_legend(picture_of(ramp())).pixels.rows(), 1U);
}

}  // namespace
}  // namespace sigmascape::product
