#include "sigmascape/radar/azimuth_span.h"

#include <gtest/gtest.h>

namespace sigmascape::radar {
namespace {

constexpr Rectangle area{-100.0, -100.0, 100.0, 100.0};

TEST(AzimuthSpan, ReachesFromCornerToCornerAlsoThroughSouth) {
  const AzimuthSpan from_south = azimuths_of(area, {0.0, -200.0});
  EXPECT_NEAR(from_south.middle_rad, 0.0, 1e-12);
  EXPECT_NEAR(from_south.left_rad, -pi / 4.0, 1e-12);
  EXPECT_NEAR(from_south.right_rad, pi / 4.0, 1e-12);
  const AzimuthSpan from_north = azimuths_of(area, {0.0, 200.0});
  EXPECT_NEAR(std::abs(from_north.middle_rad), pi, 1e-12);
  EXPECT_NEAR(from_north.left_rad, -pi / 4.0, 1e-12);
  EXPECT_NEAR(from_north.right_rad, pi / 4.0, 1e-12);
}

// From the south-west the corners beside the middle are seen 45° off it at most, and unequally from elsewhere.
TEST(AzimuthSpan, NeedNotBeTheSameToBothSides) {
  const AzimuthSpan span = azimuths_of(area, {-150.0, -200.0});
  EXPECT_NEAR(span.middle_rad + span.left_rad, std::atan2(50.0, 300.0), 1e-12);
  EXPECT_NEAR(span.middle_rad + span.right_rad, std::atan2(250.0, 100.0), 1e-12);
}

TEST(AzimuthSpan, IsAllRoundFromWithin) {
  const AzimuthSpan span = azimuths_of(area, {99.0, 0.0});
  EXPECT_EQ(span.left_rad, -pi);
  EXPECT_EQ(span.right_rad, pi);
}

TEST(RectangleCorners, StandAtAHeight) {
  const auto corners = corners_of(area, 7.0);
  for (const Vec3d corner : corners) EXPECT_EQ(corner.z, 7.0);
  EXPECT_EQ(corners.front(), (Vec3d{-100.0, -100.0, 7.0}));
  EXPECT_EQ(corners.back(), (Vec3d{100.0, 100.0, 7.0}));
}

TEST(RectangleDistances, AreFromThePlaceItselfWithin) {
  EXPECT_EQ(nearest_point(area, {5.0, -300.0}), (Vec2d{5.0, -100.0}));
  EXPECT_EQ(nearest_point(area, {5.0, 6.0}), (Vec2d{5.0, 6.0}));
  EXPECT_EQ(nearest_m(area, {103.0, 104.0}), 5.0);
  EXPECT_EQ(nearest_m(area, {5.0, 6.0}), 0.0);
}

}  // namespace
}  // namespace sigmascape::radar
