#include "sigmascape/radar/azimuth_text.h"

#include <gtest/gtest.h>

namespace sigmascape::radar {
namespace {

TEST(AzimuthText, StaysBelowTheFullTurn) {
  EXPECT_EQ(azimuth_text_deg(0.0, 2), "0.00");
  EXPECT_EQ(azimuth_text_deg(radians_from_deg(130.004), 2), "130.00");
  EXPECT_EQ(azimuth_text_deg(radians_from_deg(-90.0), 3), "270.000");
  EXPECT_EQ(azimuth_text_deg(radians_from_deg(359.994), 2), "359.99");
  EXPECT_EQ(azimuth_text_deg(radians_from_deg(359.996), 2), "0.00");
  EXPECT_EQ(azimuth_text_deg(-2e-16, 3), "0.000");
}

}  // namespace
}  // namespace sigmascape::radar
