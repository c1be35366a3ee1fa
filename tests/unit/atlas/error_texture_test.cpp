#include "sigmascape/atlas/error_texture.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::atlas {
namespace {

TEST(ErrorTexture, StepsAreAFifthOfADecibelAndRoundingIsToTheNearest) {
  for (float error = 0.0011F; error < 100.0F; error *= 1.013F) {
    const float stored = error_of(error_code(error, true));
    EXPECT_LE(std::abs(db_from_linear(static_cast<double>(stored / error))), 0.1001) << error;
  }
  EXPECT_NEAR(db_from_linear(static_cast<double>(error_of(101) / error_of(100))), 0.2, 1e-5);
}

TEST(ErrorTexture, DarkIsToldFromExact) {
  EXPECT_EQ(error_code(0.0F, false), 0);
  EXPECT_EQ(error_of(0), 0.0F);
  EXPECT_EQ(error_code(0.0F, true), 1);
  EXPECT_FLOAT_EQ(error_of(1), 1e-3F);
}

TEST(ErrorTexture, EndsAreHeld) {
  EXPECT_EQ(error_code(1e-9F, true), 1);
  EXPECT_EQ(error_code(1e9F, true), 255);
}

}  // namespace
}  // namespace sigmascape::atlas
