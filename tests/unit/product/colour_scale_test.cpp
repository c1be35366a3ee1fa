#include "sigmascape/product/colour_scale.h"

#include <cmath>
#include <gtest/gtest.h>

namespace sigmascape::product {
namespace {

double light(std::uint8_t code) {
  const double unit = code / 255.0;
  return unit <= 0.04045 ? unit / 12.92 : std::pow((unit + 0.055) / 1.055, 2.4);
}

/// CIE 1976 lightness of an sRGB colour, 0 to 100: an independent measure of how bright it looks.
double cie_lightness(Rgba colour) {
  const double y = 0.2126 * light(colour.red) + 0.7152 * light(colour.green) + 0.0722 * light(colour.blue);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(ColourScale, GreyIsLinearInTheCodeValue) {
  EXPECT_EQ(colour_at(ColourScale::Grey, 0.0), (Rgba{0, 0, 0, 255}));
  EXPECT_EQ(colour_at(ColourScale::Grey, 0.2), (Rgba{51, 51, 51, 255}));
  EXPECT_EQ(colour_at(ColourScale::Grey, 1.0), (Rgba{255, 255, 255, 255}));
}

TEST(ColourScale, BeyondTheEndsIsTheEnd) {
  for (const ColourScale scale : {ColourScale::Grey, ColourScale::Scope, ColourScale::Diverging}) {
    EXPECT_EQ(colour_at(scale, -3.0), colour_at(scale, 0.0));
    EXPECT_EQ(colour_at(scale, 7.0), colour_at(scale, 1.0));
  }
}

TEST(ColourScale, ScopeGrowsLighterFromBlackOverGreenToPale) {
  EXPECT_LT(cie_lightness(colour_at(ColourScale::Scope, 0.0)), 1.0);
  EXPECT_GT(cie_lightness(colour_at(ColourScale::Scope, 1.0)), 94.0);
  double last = -1.0;
  for (int step = 0; step <= 20; ++step) {
    const double now = cie_lightness(colour_at(ColourScale::Scope, step / 20.0));
    EXPECT_GT(now, last);
    last = now;
  }
  const Rgba middle = colour_at(ColourScale::Scope, 0.6);
  EXPECT_GT(middle.green, 2 * middle.red);
  EXPECT_GT(middle.green, middle.blue + 50);
}

TEST(ColourScale, DivergingIsLightInTheMiddleAndEquallyDarkAtBlueAndRed) {
  const Rgba blue = colour_at(ColourScale::Diverging, 0.0);
  const Rgba middle = colour_at(ColourScale::Diverging, 0.5);
  const Rgba red = colour_at(ColourScale::Diverging, 1.0);
  EXPECT_GT(blue.blue, blue.red + 80);
  EXPECT_GT(red.red, red.blue + 80);
  EXPECT_EQ(middle.red, middle.blue);
  EXPECT_GT(cie_lightness(middle), 94.0);
  EXPECT_NEAR(cie_lightness(blue), cie_lightness(red), 7.0);
}

TEST(ColourScale, EqualStepsOfDivergingLookEqual) {
  for (const double side : {-1.0, 1.0}) {
    for (int step = 1; step < 10; ++step) {
      const auto lightness = [&](int s) {
        return cie_lightness(colour_at(ColourScale::Diverging, 0.5 + side * s / 20.0));
      };
      EXPECT_NEAR(lightness(step) - lightness(step + 1), (lightness(0) - lightness(10)) / 10.0, 1.0);
    }
  }
}

TEST(ColourScale, NoScaleContainsTheColourOfTheUnseen) {
  for (const ColourScale scale : {ColourScale::Grey, ColourScale::Scope, ColourScale::Diverging}) {
    for (int step = 0; step <= 1000; ++step) {
      const Rgba colour = colour_at(scale, step / 1000.0);
      const int distance = std::abs(colour.red - unseen_colour.red) + std::abs(colour.green - unseen_colour.green) +
                           std::abs(colour.blue - unseen_colour.blue);
      EXPECT_GT(distance, 20) << step;
    }
  }
}

}  // namespace
}  // namespace sigmascape::product
