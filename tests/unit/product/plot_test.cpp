#include "sigmascape/product/plot.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <utility>

#include "scratch_folder.h"

#include "sigmascape/product/bitmap_font.h"
#include "sigmascape/product/plot_file.h"

namespace sigmascape::product {
namespace {

template <typename Mark>
std::vector<Mark> marks_of(const Drawing& drawing) {
  std::vector<Mark> found;
  for (const auto& mark : drawing.marks) {
    if (const Mark* one = std::get_if<Mark>(&mark)) found.push_back(*one);
  }
  return found;
}

Plot with_points(std::vector<std::pair<double, double>> points) {
  Plot plot;
  plot.series = {{.name = "", .points = std::move(points), .joined = true}};
  return plot;
}

TEST(Plot, PlacesAreInProportionToNumbers) {
  const auto dots = marks_of<Dot>(drawing_of(with_points({{0.0, 0.0}, {5.0, 30.0}, {10.0, 40.0}})));
  ASSERT_EQ(dots.size(), 3U);
  EXPECT_NEAR(dots[1].centre.x, (dots[0].centre.x + dots[2].centre.x) / 2.0, 1e-9);
  EXPECT_NEAR(dots[0].centre.y - dots[1].centre.y, 0.75 * (dots[0].centre.y - dots[2].centre.y), 1e-9);
  EXPECT_LT(dots[2].centre.y, dots[0].centre.y) << "more is higher up";
}

TEST(Plot, LogarithmicAxesPutEqualRatiosAtEqualDistances) {
  Plot plot = with_points({{1.0, 0.01}, {10.0, 0.1}, {100.0, 1.0}});
  plot.x_is_logarithmic = plot.y_is_logarithmic = true;
  const auto dots = marks_of<Dot>(drawing_of(plot));
  EXPECT_NEAR(dots[1].centre.x - dots[0].centre.x, dots[2].centre.x - dots[1].centre.x, 1e-9);
  EXPECT_NEAR(dots[1].centre.y - dots[0].centre.y, dots[2].centre.y - dots[1].centre.y, 1e-9);
}

TEST(Plot, AxesOfDecibelsNeedNotHoldZero) {
  const auto zero_y = [](const Plot& plot) {
    for (const Words& words : marks_of<Words>(drawing_of(plot))) {
      if (words.text == "0" && words.anchor == Anchor::End) return true;
    }
    return false;
  };
  Plot plot = with_points({{1.0, 20.0}, {2.0, 25.0}});
  EXPECT_TRUE(zero_y(plot));
  plot.y_from_zero = false;
  EXPECT_FALSE(zero_y(plot));
  EXPECT_FALSE(zero_y(with_points({{1.0, -20.0}, {2.0, -25.0}})));
}

TEST(Plot, MarksHaveDigitsThatTellThemApart) {
  for (const auto& [low, high] :
       {std::pair(28.3001, 28.3042), {1000.0, 1010.0}, {0.0, 1.0}, {-13.0, 12.0}, {0.0, 3e7}}) {
    Plot plot = with_points({{0.0, low}, {1.0, high}});
    plot.y_from_zero = false;
    std::set<std::string> texts;
    std::size_t marks = 0;
    for (const Words& words : marks_of<Words>(drawing_of(plot))) {
      if (words.anchor != Anchor::End) continue;
      ++marks;
      texts.insert(words.text);
      EXPECT_NEAR(std::stod(words.text), (low + high) / 2.0, 0.6 * (high - low));
    }
    EXPECT_GE(marks, 3U) << low;
    EXPECT_EQ(texts.size(), marks) << low;
  }
}

TEST(Plot, NamesOfAnyNumberOfSeriesStandWithinTheFrame) {
  for (const std::size_t count : {1UL, 8UL, 36UL, 400UL}) {
    Plot plot;
    for (std::size_t i = 0; i < count; ++i)
      plot.series.push_back({.name = fmt::format("azimuth {}", i),
                             .points = {{0.0, 1.0 * static_cast<double>(i)}, {1.0, 2.0}},
                             .joined = true});
    const Drawing drawing = drawing_of(plot);
    std::set<std::pair<double, double>> places;
    std::set<std::string> names;
    for (const Words& words : marks_of<Words>(drawing)) {
      if (!words.text.starts_with("azimuth")) continue;
      names.insert(words.text);
      places.insert({words.at.x, words.at.y});
      EXPECT_GE(words.at.y, 30.0);
      EXPECT_LE(words.at.y, drawing.height - 50.0);
      EXPECT_GE(words.at.x, 60.0);
      EXPECT_LE(words.at.x, drawing.width - 60.0);
    }
    EXPECT_EQ(places.size(), names.size()) << "none over another";
    EXPECT_GE(names.size(), std::min<std::size_t>(count, 36U));
  }
}

// Steps so small that a mark and the next are the same number would be marked without end.
TEST(Plot, ALineIsLevelWhereItsNumbersDifferByTheirRoundingAlone) {
  for (const double level : {0.3, -13.0, 1e17}) {
    const double next = std::nextafter(level, 1e30);
    const auto dots = marks_of<Dot>(drawing_of(with_points({{0.0, level}, {1.0, next}, {2.0, level}})));
    ASSERT_EQ(dots.size(), 3U) << level;
    EXPECT_NEAR(dots[0].centre.y, dots[1].centre.y, 1.0) << level;
    EXPECT_LT(marks_of<Words>(drawing_of(with_points({{0.0, level}, {1.0, next}}))).size(), 60U) << level;
  }
}

TEST(Plot, NumbersThatAreNotFiniteBreakTheLine) {
  Plot plot = with_points({{0.0, 1.0}, {1.0, 2.0}, {2.0, std::nan("")}, {3.0, 2.0}, {4.0, 1.0}});
  plot.series[0].dots = false;
  std::size_t curves = 0;
  for (const Stroke& stroke : marks_of<Stroke>(drawing_of(plot))) curves += stroke.width > 1.0 ? 1 : 0;
  EXPECT_EQ(curves, 2U);
}

// Between which there is no finite difference.
TEST(Plot, NumbersThatNoAxisHasRoomForBreakTheLine) {
  for (const double large : {1e308, 1.7e308}) {
    Plot plot = with_points({{-large, 1.0}, {0.0, 1.0}, {1.0, 2.0}, {2.0, -large}, {3.0, large}});
    EXPECT_EQ(marks_of<Dot>(drawing_of(plot)).size(), 2U) << large;
  }
}

TEST(Plot, WhatLiesBelowTheFloorIsLeftOutAndBreaksTheLine) {
  Plot plot = with_points({{0.0, -10.0}, {1.0, 0.0}, {2.0, -300.0}, {3.0, -5.0}, {4.0, -10.0}});
  plot.y_floor = -80.0;
  const Drawing drawing = drawing_of(plot);
  EXPECT_EQ(marks_of<Dot>(drawing).size(), 4U);
  std::size_t curves = 0;
  for (const Stroke& stroke : marks_of<Stroke>(drawing)) curves += stroke.width > 1.0 ? 1 : 0;
  EXPECT_EQ(curves, 2U);
  for (const Words& words : marks_of<Words>(drawing)) EXPECT_NE(words.text, "-100") << "the axis ends above it";
}

TEST(Plot, TheAxisReachesAsFarAsAskedWhereverPointsAre) {
  Plot plot = with_points({{100.0, 1.0}, {120.0, 2.0}, {360.0, std::nan("")}});
  plot.x_from_zero = false;
  plot.x_ends = {0.0, 360.0};
  std::set<std::string> marks;
  for (const Words& words : marks_of<Words>(drawing_of(plot))) {
    if (words.anchor == Anchor::Middle) marks.insert(words.text);
  }
  EXPECT_TRUE(marks.contains("0"));
  EXPECT_TRUE(marks.contains("300"));
}

TEST(Plot, NamesStandOnPaperOfTheirOwn) {
  Plot plot = with_points({{0.0, 0.0}, {1.0, 1.0}});
  plot.series[0].name = "diagonal";
  const Drawing drawing = drawing_of(plot);
  const auto patches = marks_of<Patch>(drawing);
  ASSERT_EQ(patches.size(), 1U);
  const Vec2d end = patches[0].corner + patches[0].size;
  for (const Words& words : marks_of<Words>(drawing)) {
    if (words.text != "diagonal") continue;
    EXPECT_GT(words.at.x, patches[0].corner.x);
    EXPECT_LT(words.at.x, end.x);
    EXPECT_GT(words.at.y, patches[0].corner.y);
    EXPECT_LT(words.at.y, end.y);
  }
  EXPECT_TRUE(std::holds_alternative<Words>(drawing.marks.back())) << "and not beneath it";
}

TEST(Plot, LabelsStandBesideTheirPointsWithinThePicture) {
  Plot plot = with_points({{1.0, 1.0}, {2.0, 2.0}, {3.0, 3.0}});
  plot.series[0].labels = {"first", "second", "the very last one"};
  const Drawing drawing = drawing_of(plot);
  const auto dots = marks_of<Dot>(drawing);
  const auto label = [&](const std::string& text) {
    const auto words = marks_of<Words>(drawing);
    return *std::ranges::find(words, text, &Words::text);
  };
  for (const auto& [text, i] : {std::pair("first", 0U), {"second", 1U}, {"the very last one", 2U}}) {
    const Words words = label(text);
    const double width = 6.5 * static_cast<double>(words.text.size());
    EXPECT_NEAR(words.at.y, dots[i].centre.y, 16.0) << text;
    EXPECT_LT(words.at.x, dots[i].centre.x + 10.0) << text;
    EXPECT_GT(words.at.x + width, dots[i].centre.x - 10.0) << text;
    EXPECT_LT(words.at.x + width, drawing.width) << text;
  }
}

// A level line has two points, and all that is between is hidden as well.
TEST(Plot, NamesHideNoLineWhereAnotherPlaceIsFree) {
  Plot plot = with_points({{1.0, 6.0}, {4.0, 5.0}, {10.0, 4.0}});
  plot.series[0].name = "falling";
  plot.series.push_back({.name = "high", .points = {{1.0, 6.3}, {10.0, 6.3}}, .joined = true, .dots = false});
  plot.series.push_back({.name = "level", .points = {{1.0, 1.0}, {10.0, 1.0}}, .joined = true, .dots = false});
  const Drawing drawing = drawing_of(plot);
  const Patch names = marks_of<Patch>(drawing).at(0);
  int lines = 0;
  for (const Stroke& stroke : marks_of<Stroke>(drawing)) {
    if (stroke.width != 1.5) continue;  // marks of the axes
    ++lines;
    for (std::size_t i = 1; i < stroke.points.size(); ++i) {
      for (int part = 0; part <= 100; ++part) {
        const Vec2d from =
            stroke.points[i - 1] + (stroke.points[i] - stroke.points[i - 1]) * (part / 100.0) - names.corner;
        EXPECT_FALSE(from.x > 0.0 && from.y > 0.0 && from.x < names.size.x && from.y < names.size.y);
      }
    }
  }
  EXPECT_EQ(lines, 3);
}

TEST(Drawing, PatchesCoverAsMuchAsTheirAlphaSays) {
  Drawing drawing{.width = 20.0, .height = 10.0, .marks = {}};
  drawing.marks.emplace_back(Patch{{5.0, 2.0}, {10.0, 6.0}, {0, 0, 0, 255}});
  drawing.marks.emplace_back(Patch{{5.0, 2.0}, {5.0, 6.0}, {255, 255, 255, 51}});
  const Picture picture = picture_of(drawing, 1);
  EXPECT_EQ(picture.pixels(4, 5).red, 255);
  EXPECT_EQ(picture.pixels(5, 5).red, 51);
  EXPECT_EQ(picture.pixels(12, 5).red, 0);
  EXPECT_EQ(picture.pixels(12, 8).red, 255);
  EXPECT_NE(svg_of(drawing).find("width=\"5.0\" height=\"6.0\" fill=\"#ffffff\" fill-opacity=\"0.20\""),
            std::string::npos);
}

TEST(Drawing, ShowsInkWhereAMarkIsAndPaperElsewhere) {
  Drawing drawing{.width = 40.0, .height = 20.0, .marks = {}};
  const Rgba ink{200, 0, 0, 255}, white{255, 255, 255, 255};
  drawing.marks.emplace_back(Stroke{{{5.0, 10.0}, {35.0, 10.0}}, ink, 2.0});
  const Picture picture = picture_of(drawing, 2);
  ASSERT_EQ(picture.pixels.columns(), 80U);
  EXPECT_EQ(picture.pixels(40, 20), ink);
  EXPECT_EQ(picture.pixels(40, 25), white);
  EXPECT_EQ(picture.pixels(40, 14), white);
  EXPECT_EQ(picture.pixels(2, 20), white);
}

TEST(Drawing, WordsStandWhereTheirAnchorSays) {
  // The columns that have ink, of "H" written about x = 20 of 40.
  const auto columns_with_ink = [](Anchor anchor) {
    Drawing drawing{.width = 40.0, .height = 20.0, .marks = {}};
    drawing.marks.emplace_back(Words{{20.0, 15.0}, anchor, "H", false});
    const Picture picture = picture_of(drawing, 1);
    std::pair<std::size_t, std::size_t> found{99, 0};
    for (std::size_t column = 0; column < 40; ++column) {
      for (std::size_t row = 0; row < 20; ++row) {
        if (picture.pixels(column, row).red > 100) continue;
        found = {std::min(found.first, column), std::max(found.second, column)};
      }
    }
    return found;
  };
  EXPECT_EQ(columns_with_ink(Anchor::Start), std::pair(std::size_t{20}, std::size_t{24}));
  EXPECT_EQ(columns_with_ink(Anchor::End), std::pair(std::size_t{15}, std::size_t{19}));
}

TEST(BitmapFont, HasEveryLetterThatPlotsUse) {
  const std::string words = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-.,:/()[]_=*%'|<>";
  for (const char letter : words) {
    Array2D<Rgba> pixels(5, 7, {255, 255, 255, 255});
    draw_text(pixels, 0, 0, std::string(1, letter), 1, {0, 0, 0, 255});
    const auto inked = std::ranges::count_if(pixels.values(), [](Rgba pixel) { return pixel.red == 0; });
    EXPECT_GT(inked, 1) << letter;
  }
  EXPECT_EQ(text_width("σ0 [°]", 1), text_width("s0 [o]", 1)) << "letters, not bytes, take room";
}

TEST(BitmapFont, SmallLettersWithATailHangBelowTheBaseLineAndAreNotCapitals) {
  const auto drawn = [](char letter) {
    Array2D<Rgba> pixels(5, glyph_height + glyph_depth, {255, 255, 255, 255});
    draw_text(pixels, 0, 0, std::string(1, letter), 1, {0, 0, 0, 255});
    return pixels;
  };
  const auto ink_in_rows = [](const Array2D<Rgba>& pixels, std::size_t first, std::size_t end) {
    int ink = 0;
    for (std::size_t row = first; row < end; ++row) {
      for (std::size_t column = 0; column < pixels.columns(); ++column) ink += pixels(column, row).red == 0 ? 1 : 0;
    }
    return ink;
  };
  for (const char letter : {'g', 'p', 'q', 'y'}) {
    EXPECT_EQ(ink_in_rows(drawn(letter), 0, 2), 0) << letter << " begins where x does";
    EXPECT_GT(ink_in_rows(drawn(letter), glyph_height, glyph_height + glyph_depth), 1) << letter;
  }
  for (const char letter : {'P', 'x', '9'})
    EXPECT_EQ(ink_in_rows(drawn(letter), glyph_height, glyph_height + glyph_depth), 0) << letter;
}

TEST(PlotFile, IsSvgOrPngByItsName) {
  const ScratchFolder folder;
  const Plot plot = with_points({{0.0, 1.0}, {1.0, 2.0}});
  write_plot(folder.path("a.svg"), plot);
  write_plot(folder.path("a.png"), plot);
  const auto files = files_of(folder.path(""));
  EXPECT_EQ(files.at("a.svg").substr(0, 4), "<svg");
  EXPECT_EQ(files.at("a.png").substr(1, 3), "PNG");
  EXPECT_NE(message_of_error([&] { write_plot(folder.path("a.pdf"), plot); }).find(".svg or .png"), std::string::npos);
}

}  // namespace
}  // namespace sigmascape::product
