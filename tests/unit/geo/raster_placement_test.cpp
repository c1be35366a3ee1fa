#include "sigmascape/geo/raster_placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/geo/local_frame.h"

namespace sigmascape::geo {
namespace {

TEST(RasterPlacement, GeographicCornersLieAroundTheOriginOfTheFrame) {
  // One minute of arc along the equator is 1855.3 m, along the meridian there 1842.9 m, on WGS 84.
  const auto corners = geographic_corners({-1855.3248, 1842.9046, 10.0, LocalFrame(0.0, 10.0).proj()}, 200, 100);
  EXPECT_NEAR(corners[3].x, 10.0 - 1.0 / 60.0, 1e-7);
  EXPECT_NEAR(corners[3].y, 1.0 / 60.0, 1e-7);
  EXPECT_LT(corners[0].y, corners[3].y);
  EXPECT_LT(corners[0].x, corners[1].x);
  EXPECT_NEAR(corners[2].y, corners[3].y, 1e-7);
}

TEST(RasterPlacement, WhatReachesBeyondTheCrsIsToldByHowFar) {
  const std::string crs = LocalFrame(43.0, -3.0).proj();
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(geographic_corners({0.0, 2.56e8, 1e6, crs}, 256, 256));
              }),
              testing::AllOf(testing::HasSubstr("raster: reaches from 0 to 2.56e+08 east and 0 to 2.56e+08 north"),
                             testing::HasSubstr("use smaller cells")));
}

}  // namespace
}  // namespace sigmascape::geo
