#include "sigmascape/geo/coordinate_reference_system.h"

#include <gtest/gtest.h>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/local_frame.h"

namespace sigmascape::geo {
namespace {

TEST(CoordinateReferenceSystem, TellsDegreesFromMetres) {
  EXPECT_TRUE(is_in_degrees("EPSG:4326"));
  EXPECT_FALSE(is_in_degrees("EPSG:25830"));
  EXPECT_FALSE(is_in_degrees(LocalFrame(43.26, -2.93).proj()));
}

TEST(CoordinateReferenceSystem, WhatIsNoneIsRefused) {
  EXPECT_THROW(static_cast<void>(wkt2_from("+proj=nonsense")), Error);
  EXPECT_THROW(static_cast<void>(wkt2_from("")), Error);
  EXPECT_THROW(static_cast<void>(is_in_degrees("somewhere")), Error);
}

}  // namespace
}  // namespace sigmascape::geo
