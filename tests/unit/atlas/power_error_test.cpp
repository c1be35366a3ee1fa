#include "sigmascape/atlas/power_error.h"

#include <gtest/gtest.h>

namespace sigmascape::atlas {
namespace {

radar::Channels of_power(float power) {
  return {.vv = 0.25F * power, .hh = 0.25F * power, .hv = 0.25F * power};
}

/// A texel of power 8 that is sure to 1/8, one of 2 to 1/4, one of 1/4 that one stray path lit, and one in the dark.
PowerError of_four_texels(std::optional<double> relative_target) {
  Array2D<radar::Channels> texels(2, 2);
  Array2D<float> errors(2, 2);
  texels(0, 0) = of_power(8.0F), errors(0, 0) = 0.125F;
  texels(1, 0) = of_power(2.0F), errors(1, 0) = 0.25F;
  texels(0, 1) = of_power(0.25F), errors(0, 1) = 1.0F;
  return power_error(texels, errors, relative_target);
}

TEST(PowerError, WeighsTexelsByTheirPower) {
  const PowerError error = of_four_texels(0.2);
  EXPECT_EQ(error.power, 10.25 / 4);
  EXPECT_EQ(error.standard_error, (1.0 + 0.5 + 0.25) / 4);
  EXPECT_EQ(error.relative(), 1.75 / 10.25);
  EXPECT_EQ(error.part_above_target(), 2.25 / 10.25);
  EXPECT_EQ(of_four_texels(0.25).part_above_target(), 0.25 / 10.25) << "0.25 is not above 0.25";
  EXPECT_FALSE(of_four_texels({}).part_above_target());
}

TEST(PowerError, IsNoneWhereNothingReturns) {
  PowerError dark = power_error(Array2D<radar::Channels>(2, 2), Array2D<float>(2, 2), 0.1);
  EXPECT_FALSE(dark.relative() || dark.part_above_target() || dark.part_of_all());
  dark.ground_power = 0.5;
  EXPECT_EQ(dark.part_of_all(), 0.0);
}

TEST(PowerError, OfPatchesIsThatOfTheirPowerTogether) {
  PowerErrors errors;
  EXPECT_TRUE(errors.empty());
  errors.add(0, {.power = 3.0, .standard_error = 0.3, .above_target = 0.0, .ground_power = 1.0});
  errors.add(0, {.power = 1.0, .standard_error = 0.9, .above_target = 1.0, .ground_power = 3.0});
  errors.add(0, {.above_target = 0.0});
  EXPECT_EQ(errors.relative(), 1.2 / 4.0);
  EXPECT_EQ(errors.part_above_target(), 0.25);
  EXPECT_EQ(errors.part_of_all(), 0.5);
}

// A wall that flashes into one look is a thousand times as bright as all that the other has.
TEST(PowerError, OfLooksIsTheirMean) {
  PowerErrors errors;
  errors.add(3, {.power = 1000.0, .standard_error = 10.0, .above_target = 0.0});
  errors.add(7, {.power = 1.0, .standard_error = 0.25, .above_target = 1.0});
  errors.add(8, {.above_target = 0.0});
  EXPECT_DOUBLE_EQ(errors.relative().value(), 0.5 * (0.01 + 0.25));
  EXPECT_EQ(errors.part_above_target(), 0.5);
  EXPECT_EQ(errors.spread()->smallest, 0.01);
  EXPECT_EQ(errors.spread()->largest, 0.25);
}

}  // namespace
}  // namespace sigmascape::atlas
