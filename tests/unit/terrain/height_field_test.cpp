#include "sigmascape/terrain/height_field.h"

#include <gtest/gtest.h>

namespace sigmascape::terrain {
namespace {

/// Nodes of a function of the plane, 5 m apart.
template <typename Height>
HeightField sampled(const Height& height) {
  HeightField field{.west_m = -20.0, .north_m = 30.0, .spacing_m = 5.0, .height_m = Array2D<float>(9, 13)};
  for (std::size_t row = 0; row < 13; ++row) {
    for (std::size_t column = 0; column < 9; ++column) {
      field.height_m(column, row) =
          static_cast<float>(height(-20.0 + 5.0 * static_cast<double>(column), 30.0 - 5.0 * static_cast<double>(row)));
    }
  }
  return field;
}

TEST(HeightField, ExtentReachesFromFirstToLastNode) {
  EXPECT_EQ(sampled([](double, double) { return 0.0; }).extent(), (radar::Rectangle{-20.0, -30.0, 20.0, 30.0}));
}

TEST(HeightField, APlaneIsReturnedExactly) {
  const auto plane = [](double x, double y) { return 100.0 + 0.25 * x - 0.5 * y; };
  const HeightField field = sampled(plane);
  for (const Vec2d p : {Vec2d{0, 0}, {-20, 30}, {20, -30}, {-20, -30}, {20, 30}, {1.25, -7.5}, {19.99, 29.99}}) {
    EXPECT_NEAR(field.height_at(p), plane(p.x, p.y), 1e-4) << p.x << " " << p.y;
    const Vec3d expected = normalized(Vec3d{-0.25, 0.5, 1.0});
    EXPECT_NEAR(length(field.normal_at(p) - expected), 0.0, 1e-6) << p.x << " " << p.y;
  }
  EXPECT_FLOAT_EQ(field.lowest_m(), 80.0F);
  EXPECT_FLOAT_EQ(field.highest_m(), 120.0F);
}

TEST(HeightField, IsBilinearWithinACell) {
  HeightField field{.west_m = 0.0, .north_m = 10.0, .spacing_m = 10.0, .height_m = Array2D<float>(2, 2)};
  field.height_m(1, 0) = 8.0F;  // the north-eastern node
  EXPECT_DOUBLE_EQ(field.height_at({10.0, 10.0}), 8.0);
  EXPECT_DOUBLE_EQ(field.height_at({5.0, 5.0}), 2.0);
  EXPECT_DOUBLE_EQ(field.height_at({7.5, 2.5}), 1.5);
  EXPECT_DOUBLE_EQ(field.height_at({0.0, 10.0}), 0.0);
}

TEST(HeightField, NormalIsThatOfTheBilinearSurface) {
  const HeightField field = sampled([](double x, double y) { return 0.02 * x * y + 0.1 * x; });
  constexpr double step = 1e-3;
  for (const Vec2d p : {Vec2d{1.3, 2.7}, {-13.0, 22.0}, {17.2, -18.1}}) {
    const double east = (field.height_at({p.x + step, p.y}) - field.height_at({p.x - step, p.y})) / (2.0 * step);
    const double north = (field.height_at({p.x, p.y + step}) - field.height_at({p.x, p.y - step})) / (2.0 * step);
    EXPECT_NEAR(length(field.normal_at(p) - normalized(Vec3d{-east, -north, 1.0})), 0.0, 1e-6);
  }
}

TEST(HeightField, OutsideIsTheNearestEdge) {
  const HeightField field = sampled([](double x, double y) { return x + 10.0 * y; });
  EXPECT_DOUBLE_EQ(field.height_at({1000.0, 2.0}), field.height_at({20.0, 2.0}));
  EXPECT_DOUBLE_EQ(field.height_at({3.0, -1e9}), field.height_at({3.0, -30.0}));
  EXPECT_EQ(field.normal_at({-1e9, 1e9}), field.normal_at({-20.0, 30.0}));
}

}  // namespace
}  // namespace sigmascape::terrain
