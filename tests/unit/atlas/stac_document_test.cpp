#include "sigmascape/atlas/stac_document.h"

#include <gtest/gtest.h>

namespace sigmascape::atlas {
namespace {

/// Of 20 km by 10 km about a place.
Footprint footprint_about(double latitude_deg, double longitude_deg) {
  AtlasDescription description;
  description.frame = geo::LocalFrame(latitude_deg, longitude_deg);
  return {description, radar::GroundGrid{-10e3, 5e3, 10.0, 2000, 1000}};
}

double number(const Json& json, std::size_t i) {
  return json.at(i).get<double>();
}

TEST(Footprint, IsOneRingWhereLongitudesRunOn) {
  const Footprint footprint = footprint_about(43.0, -3.0);
  EXPECT_EQ(footprint.polygon["type"], "Polygon");
  const Json& ring = footprint.polygon["coordinates"][0];
  ASSERT_EQ(ring.size(), 5U);
  EXPECT_EQ(ring[0], ring[4]);
  EXPECT_LT(number(footprint.box, 0), -3.0);
  EXPECT_GT(number(footprint.box, 2), -3.0);
  EXPECT_NEAR(number(footprint.box, 2) - number(footprint.box, 0), 20.0 / (111.3 * std::cos(43.0 * pi / 180.0)), 0.01);
}

// RFC 7946, 3.1.9 and 5.2, whichever side the middle lies on.
TEST(Footprint, IsTwoRingsAcrossTheAntimeridian) {
  for (const double longitude_deg : {179.99, -179.97}) {
    const Footprint footprint = footprint_about(-45.0, longitude_deg);
    ASSERT_EQ(footprint.polygon["type"], "MultiPolygon") << longitude_deg;
    const double west = number(footprint.box, 0), east = number(footprint.box, 2);
    EXPECT_GT(west, 179.8);
    EXPECT_LT(east, -179.8);
    EXPECT_NEAR(east + 360.0 - west, 20.0 / (111.3 * std::cos(pi / 4.0)), 0.01);
    ASSERT_EQ(footprint.polygon["coordinates"].size(), 2U);
    for (const Json& polygon : footprint.polygon["coordinates"]) {
      const Json& ring = polygon[0];
      EXPECT_EQ(ring.front(), ring.back());
      const double side = number(ring[0], 0);
      for (const Json& place : ring) {
        EXPECT_GT(number(place, 0) * side, 0.0) << "a ring keeps to one side";
        EXPECT_LE(std::abs(number(place, 0)), 180.0);
      }
    }
  }
}

}  // namespace
}  // namespace sigmascape::atlas
