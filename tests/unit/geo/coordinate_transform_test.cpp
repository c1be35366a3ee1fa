#include "sigmascape/geo/coordinate_transform.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "scratch_folder.h"

namespace sigmascape::geo {
namespace {

TEST(CoordinateTransform, OriginOfFrameIsItsPlaceOnTheGlobe) {
  const Vec2d origin = position_in_frame(LocalFrame(43.3, -3.0), {43.3, -3.0});
  EXPECT_NEAR(origin.x, 0.0, 1e-6);
  EXPECT_NEAR(origin.y, 0.0, 1e-6);
}

TEST(CoordinateTransform, LongitudeGoesEastAndLatitudeNorthAtTrueScale) {
  // Radii of curvature of the WGS 84 ellipsoid at 45°: M along the meridian, N across it.
  const double a = 6378137.0, e2 = 0.00669437999014, s = std::sin(M_PI / 4.0), w = 1.0 - e2 * s * s;
  const double m = a * (1.0 - e2) / std::pow(w, 1.5), n = a / std::sqrt(w);
  const double step_rad = 0.001 * M_PI / 180.0;
  const Vec2d p = position_in_frame(LocalFrame(45.0, 7.0), {45.001, 7.001});
  EXPECT_NEAR(p.y, m * step_rad, 0.01);
  EXPECT_NEAR(p.x, n * std::cos(M_PI / 4.0) * step_rad, 0.01);
}

TEST(CoordinateTransform, GeographicCrsIsReadLongitudeFirst) {
  std::array place{Vec2d{7.001, 45.0}};
  CoordinateTransform("EPSG:4326", LocalFrame(45.0, 7.0), "test").to_frame(place);
  EXPECT_GT(place[0].x, 70.0);
  EXPECT_NEAR(place[0].y, 0.0, 0.1);
}

TEST(CoordinateTransform, ThereAndBackIsWhereItBegan) {
  const CoordinateTransform transform("EPSG:25830", LocalFrame(43.312, -2.986), "test");
  std::array place{Vec2d{500'100.0, 4'795'000.0}};
  transform.to_frame(place);
  transform.to_crs(place);
  EXPECT_NEAR(place[0].x, 500'100.0, 1e-4);
  EXPECT_NEAR(place[0].y, 4'795'000.0, 1e-4);
}

TEST(CoordinateTransform, UnknownCrsIsAnError) {
  const std::string message = message_of_error([] { CoordinateTransform("EPSG:abc", LocalFrame(), "roads.csv"); });
  EXPECT_NE(message.find("roads.csv: the coordinate reference system 'EPSG:abc' is not known"), std::string::npos)
      << message;
}

// The first two of its three numbers would put everything somewhere else.
TEST(CoordinateTransform, CrsWithoutPlacesOnTheGroundIsAnError) {
  const auto said_of = [](const char* crs) {
    testing::internal::CaptureStderr();
    const std::string message = message_of_error([&] { CoordinateTransform(crs, LocalFrame(), "roads.csv"); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "GDAL has no say beside the message";
    return message;
  };
  EXPECT_EQ(said_of("EPSG:4978"),
            "roads.csv: 'EPSG:4978' counts places from the middle of the Earth, and none along the ground; choose a "
            "system of places on the ground, such as EPSG:25830 or EPSG:4326");
  EXPECT_EQ(said_of("EPSG:5773"),
            "roads.csv: 'EPSG:5773' counts heights and no places; choose a system of places on the ground, such as "
            "EPSG:25830 or EPSG:4326");
  // The Moon's latitudes.
  EXPECT_NE(said_of("IAU_2015:30100").find("no transformation is known from 'IAU_2015:30100'"), std::string::npos);
  EXPECT_NO_THROW(CoordinateTransform("EPSG:4979", LocalFrame(), "roads.csv")) << "latitude, longitude and height";
  EXPECT_NO_THROW(CoordinateTransform("EPSG:4326+5773", LocalFrame(), "roads.csv"));
}

}  // namespace
}  // namespace sigmascape::geo
