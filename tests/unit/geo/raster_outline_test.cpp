#include "sigmascape/geo/raster_outline.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace sigmascape::geo {
namespace {

constexpr double half_m = 500.0;  // of the raster's side

/// A square about the origin, turned counter-clockwise.
RasterOutline turned_square(double angle_rad) {
  const auto turned = [&](double x, double y) {
    return Vec2d{x * std::cos(angle_rad) - y * std::sin(angle_rad), x * std::sin(angle_rad) + y * std::cos(angle_rad)};
  };
  std::vector<Vec2d> left, right, bottom, top;
  for (int i = -128; i <= 128; ++i) {
    const double t = half_m * i / 128.0;
    left.push_back(turned(-half_m, t));
    right.push_back(turned(half_m, t));
    bottom.push_back(turned(t, -half_m));
    top.push_back(turned(t, half_m));
  }
  return RasterOutline::of(left, right, bottom, top);
}

// A square in a square turned by θ has the side 1 / (|cos θ| + |sin θ|), and the one around it that many times it.
TEST(RasterOutline, SquareHoweverItIsTurned) {
  for (int deg = 0; deg < 360; deg += 15) {
    const double angle_rad = deg * std::numbers::pi / 180.0;
    const double cosine = std::cos(angle_rad), sine = std::sin(angle_rad);
    const double wider = std::abs(cosine) + std::abs(sine);
    const RasterOutline outline = turned_square(angle_rad);
    const Extent inside = outline.extent_inside(), around = outline.extent_around();
    const double side_m = 2.0 * half_m / wider;
    EXPECT_NEAR((inside.east_m - inside.west_m) * (inside.north_m - inside.south_m), side_m * side_m,
                0.02 * side_m * side_m)
        << deg;
    for (const double x : {inside.west_m, inside.east_m}) {
      for (const double y : {inside.south_m, inside.north_m}) {
        EXPECT_LT(std::abs(x * cosine + y * sine), half_m + 1e-6) << deg;
        EXPECT_LT(std::abs(y * cosine - x * sine), half_m + 1e-6) << deg;
      }
    }
    for (const double reach_m : {-around.west_m, -around.south_m, around.east_m, around.north_m})
      EXPECT_NEAR(reach_m, half_m * wider, 1e-6) << deg;
  }
}

}  // namespace
}  // namespace sigmascape::geo
