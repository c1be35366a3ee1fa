#include "sigmascape/base/units.h"

#include <gtest/gtest.h>

namespace sigmascape {
namespace {

TEST(Units, DegreesAndRadians) {
  EXPECT_DOUBLE_EQ(radians_from_deg(180.0), pi);
  EXPECT_DOUBLE_EQ(deg_from_radians(radians_from_deg(-37.5)), -37.5);
}

TEST(Units, DecibelsArePowerRatios) {
  EXPECT_DOUBLE_EQ(linear_from_db(10.0), 10.0);
  EXPECT_NEAR(db_from_linear(2.0), 3.0103, 1e-4);
  EXPECT_DOUBLE_EQ(linear_from_db(db_from_linear(0.037)), 0.037);
}

TEST(Units, WavelengthAtTenGigahertzIsThreeCentimetres) {
  EXPECT_DOUBLE_EQ(wavelength_m(10e9), 0.0299792458);
}

TEST(WrappedAzimuth, LiesInOneTurn) {
  EXPECT_DOUBLE_EQ(wrapped_azimuth(-pi / 2.0), 1.5 * pi);
  EXPECT_DOUBLE_EQ(wrapped_azimuth(5.0 * pi), pi);
  EXPECT_EQ(wrapped_azimuth(0.0), 0.0);
  EXPECT_EQ(wrapped_azimuth(2.0 * pi), 0.0);
}

// The least negative angles round to a full turn when one is added.
TEST(WrappedAzimuth, NeverIsAFullTurn) {
  for (const double angle : {-1e-16, -1e-20, -1e-300}) EXPECT_LT(wrapped_azimuth(angle), 2.0 * pi) << angle;
}

}  // namespace
}  // namespace sigmascape
