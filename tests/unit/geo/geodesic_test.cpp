#include "sigmascape/geo/geodesic.h"

#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::geo {
namespace {

double degrees(double whole, double minutes, double seconds) {
  return whole + minutes / 60.0 + seconds / 3600.0;
}

double azimuth_deg(const Geodesic& way) {
  return deg_from_radians(wrapped_azimuth(way.azimuth_rad));
}

// From Flinders Peak to Buninyong, the worked example of the Geocentric Datum of Australia Technical Manual (ICSM, on
// GRS 80, whose axes are those of WGS 84 to 0.1 mm), as Vincenty's formulae have it.
TEST(Geodesic, IsThatOfTheWorkedExampleOfAustralia) {
  const GeographicPosition flinders{-degrees(37, 57, 3.72030), degrees(144, 25, 29.52440)},
      buninyong{-degrees(37, 39, 10.15610), degrees(143, 55, 35.38390)};
  const Geodesic there = geodesic_between(flinders, buninyong), back = geodesic_between(buninyong, flinders);
  EXPECT_NEAR(there.length_m, 54'972.271, 1e-3);
  EXPECT_NEAR(back.length_m, 54'972.271, 1e-3);
  EXPECT_NEAR(azimuth_deg(there), degrees(306, 52, 5.37), 0.01 / 3600.0);
  EXPECT_NEAR(azimuth_deg(back), degrees(127, 10, 25.07), 0.01 / 3600.0);
}

// Along the equator a degree is a 360th of the circle of the semi-major axis.
TEST(Geodesic, FollowsTheEquatorAndMeridians) {
  const Geodesic east = geodesic_between({0.0, 179.5}, {0.0, -179.5});
  EXPECT_NEAR(east.length_m, 6'378'137.0 * pi / 180.0, 1e-3);
  EXPECT_NEAR(azimuth_deg(east), 90.0, 1e-9);
  EXPECT_NEAR(azimuth_deg(geodesic_between({50.0, 10.0}, {40.0, 10.0})), 180.0, 1e-9);
  EXPECT_EQ(geodesic_between({50.0, 10.0}, {50.0, 10.0}).length_m, 0.0);
}

}  // namespace
}  // namespace sigmascape::geo
