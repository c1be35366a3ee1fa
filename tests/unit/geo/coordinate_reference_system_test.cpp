#include "sigmascape/geo/coordinate_reference_system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "scratch_folder.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/axis_units.h"
#include "sigmascape/geo/foot.h"
#include "sigmascape/geo/local_frame.h"

namespace sigmascape::geo {
namespace {

using ::testing::StartsWith;

TEST(CoordinateReferenceSystem, TellsDegreesFromMetres) {
  EXPECT_TRUE(is_in_degrees("EPSG:4326"));
  EXPECT_FALSE(is_in_degrees("EPSG:25830"));
  EXPECT_FALSE(is_in_degrees(LocalFrame(43.26, -2.93).proj()));
}

TEST(CoordinateReferenceSystem, MayCountHeightsInAUnitOfTheirOwn) {
  EXPECT_DOUBLE_EQ(metres_per_vertical_unit("EPSG:2263+6360").value(), us_survey_foot_m);
  EXPECT_DOUBLE_EQ(metres_per_vertical_unit("EPSG:4326+8228").value(), foot_m);
  EXPECT_DOUBLE_EQ(metres_per_vertical_unit("EPSG:2263+5703").value(), 1.0);
  EXPECT_DOUBLE_EQ(metres_per_vertical_unit("EPSG:4979").value(), 1.0);
  for (const char* without : {"EPSG:2263", "EPSG:4326", "EPSG:4978", "somewhere", ""})
    EXPECT_FALSE(metres_per_vertical_unit(without).has_value()) << without;
}

// In a polar stereographic system the pole is in the origin, and north is there from everywhere.
TEST(CoordinateReferenceSystem, HasNorthSomewhere) {
  for (const Vec2d place : {Vec2d{1e6, 0.0}, Vec2d{-2e6, 1.5e6}}) {
    const Vec2d north = way_at_azimuth("EPSG:3413", place, 0.0), east = way_at_azimuth("EPSG:3413", place, pi / 2.0);
    EXPECT_NEAR(north.x, -place.x / length(place), 1e-4);
    EXPECT_NEAR(north.y, -place.y / length(place), 1e-4);
    EXPECT_NEAR(dot(north, east), 0.0, 1e-4);
    EXPECT_NEAR(north.x * east.y - north.y * east.x, -1.0, 1e-4);
  }
  // At 60° north a degree of longitude is half as long as one of latitude.
  const Vec2d north_east = way_at_azimuth("EPSG:4326", {180.0, 60.0}, pi / 4.0);
  EXPECT_NEAR(north_east.x / north_east.y, 2.0, 0.01);
  EXPECT_NEAR(way_at_azimuth("somewhere", {}, pi / 2.0).x, 1.0, 1e-12);
}

// Mercator's x is the semi-major axis times the longitude, an equirectangular one's that of its true parallel as well;
// on a globe of 1000 m so is Miller's. Where meridians are bent, or parallels are as long as they are, there is no such
// turn.
TEST(CoordinateReferenceSystem, TurnsRoundAnUprightCylinderInX) {
  constexpr double equator_m = 2.0 * pi * 6378137.0;
  for (const char* mercator : {"EPSG:3857", "EPSG:3395", "+proj=merc +lon_0=150 +datum=WGS84"})
    EXPECT_NEAR(turn_of_x(mercator), equator_m, 1e-3) << mercator;
  EXPECT_NEAR(turn_of_x("+proj=merc +lon_0=-100 +datum=WGS84 +units=us-ft"), equator_m / us_survey_foot_m, 1e-2);
  EXPECT_NEAR(turn_of_x("+proj=eqc +lat_ts=60 +R=1000"), pi * 1000.0, 1e-6);
  EXPECT_NEAR(turn_of_x("+proj=mill +R=1000"), 2.0 * pi * 1000.0, 1e-6);
  EXPECT_NEAR(turn_of_x("EPSG:4326"), 360.0, 1e-9);
  for (const char* another : {"EPSG:25830", "EPSG:3413", "+proj=sinu +R=6371007.181", "+proj=robin", "somewhere"})
    EXPECT_EQ(turn_of_x(another), 0.0) << another;
}

TEST(CoordinateReferenceSystem, ALocalFrameHasAName) {
  const LocalFrame frame(43.26, -2.93);
  EXPECT_EQ(frame.title(), "Sigmascape local transverse Mercator at 43.26 N, 2.93 W");
  EXPECT_THAT(wkt2_from(frame.proj()), StartsWith("PROJCRS[\"" + frame.title() + "\""));
  const LocalFrame southern(-33.448912, 151.2);
  EXPECT_THAT(wkt2_from(southern.proj()),
              StartsWith("PROJCRS[\"Sigmascape local transverse Mercator at 33.448912 S, 151.2 E\""));
}

TEST(CoordinateReferenceSystem, AnotherOfTheKindDoesNot) {
  EXPECT_THAT(wkt2_from("+proj=tmerc +lat_0=43.26 +lon_0=-2.93 +k=0.9996 +x_0=0 +y_0=0 +datum=WGS84"),
              StartsWith("PROJCRS[\"unknown\""));
  EXPECT_THAT(wkt2_from("EPSG:25830"), StartsWith("PROJCRS[\"ETRS89 / UTM zone 30N\""));
}

TEST(CoordinateReferenceSystem, IsTheSameUnderAnotherName) {
  const std::string frame = LocalFrame(43.26, -2.93).proj(), named = wkt2_from(frame);
  std::string unnamed = named;
  unnamed.replace(unnamed.find("Sigmascape"), LocalFrame(43.26, -2.93).title().size(), "unknown");
  EXPECT_TRUE(is_same_crs(frame, named));
  EXPECT_TRUE(is_same_crs(named, unnamed));
  EXPECT_FALSE(is_same_crs(named, LocalFrame(43.27, -2.93).proj()));
  EXPECT_FALSE(is_same_crs(named, "EPSG:25830"));
  EXPECT_TRUE(is_same_crs("somewhere", "somewhere"));
  EXPECT_FALSE(is_same_crs("somewhere", "elsewhere"));
}

// The keys of GeoTIFF name a zone of UTM and no axes: a map whose x counts westward would lie in another ocean.
TEST(CoordinateReferenceSystem, OneThatAGeotiffDoesNotTellIsRefused) {
  for (const char* lost :
       {"+proj=utm +zone=30 +south +datum=WGS84 +axis=wsu", "+proj=utm +zone=30 +datum=WGS84 +axis=neu"})
    EXPECT_THAT(message_of_error([&] { require_geotiff_keys(lost, "--crs"); }),
                ::testing::AllOf(StartsWith("--crs: "), ::testing::HasSubstr(lost), ::testing::HasSubstr("axes")));
  const std::string frame = LocalFrame(43.26, -2.93).proj();
  for (const std::string kept : {"EPSG:25830", "EPSG:2048", "EPSG:4326", "EPSG:2263", "EPSG:3413", "EPSG:2193",
                                 "EPSG:4266", "+proj=tmerc +lat_0=43 +lon_0=-3 +datum=WGS84 +axis=wsu", frame.c_str()})
    EXPECT_NO_THROW(require_geotiff_keys(kept, "--crs")) << kept;
}

TEST(CoordinateReferenceSystem, WhatIsNoneIsRefused) {
  EXPECT_THROW(static_cast<void>(wkt2_from("+proj=nonsense")), Error);
  EXPECT_THROW(static_cast<void>(wkt2_from("")), Error);
  EXPECT_THROW(static_cast<void>(is_in_degrees("somewhere")), Error);
}

}  // namespace
}  // namespace sigmascape::geo
