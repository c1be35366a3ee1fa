#include "sigmascape/base/vec.h"

#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/sobol.h"
#include "sigmascape/base/units.h"

namespace sigmascape {
namespace {

TEST(Vec2, CrossIsPositiveCounterClockwise) {
  EXPECT_GT(cross(Vec2d{1, 0}, Vec2d{0, 1}), 0.0);
  EXPECT_EQ(dot(Vec2d{1, 2}, Vec2d{3, 4}), 11.0);
  EXPECT_EQ(length(Vec2d{3, 4}), 5.0);
}

TEST(Vec3, CrossIsRightHanded) {
  EXPECT_EQ(cross(Vec3d{1, 0, 0}, Vec3d{0, 1, 0}), (Vec3d{0, 0, 1}));
  EXPECT_EQ(cross(Vec3d{0, 1, 0}, Vec3d{0, 0, 1}), (Vec3d{1, 0, 0}));
  EXPECT_DOUBLE_EQ(length(normalized(Vec3d{3, -4, 12})), 1.0);
}

void expect_right_handed(const Vec3f normal) {
  const Basis basis(normal);
  SCOPED_TRACE(testing::Message() << normal.x << " " << normal.y << " " << normal.z);
  EXPECT_NEAR(length(basis.tangent), 1.0F, 2e-6F);
  EXPECT_NEAR(length(basis.bitangent), 1.0F, 2e-6F);
  EXPECT_NEAR(dot(basis.tangent, basis.bitangent), 0.0F, 2e-6F);
  EXPECT_NEAR(dot(basis.tangent, normal), 0.0F, 2e-6F);
  EXPECT_NEAR(dot(basis.bitangent, normal), 0.0F, 2e-6F);
  EXPECT_NEAR(dot(cross(basis.tangent, basis.bitangent), normal), 1.0F, 4e-6F);
}

TEST(Basis, IsOrthonormalAndRightHanded) {
  for (std::uint32_t index = 0; index < 4096; ++index) {
    const Vec2f u = SobolPoint(1, index).pair(0);
    const double z = 2.0 * u.x - 1.0, azimuth = 2.0 * pi * u.y, across = std::sqrt(1.0 - z * z);
    expect_right_handed(Vec3d{across * std::cos(azimuth), across * std::sin(azimuth), z}.to<float>());
  }
}

TEST(Basis, HoldsAtThePolesAndTheEquator) {
  for (const Vec3f normal : {Vec3f{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1, 0, -0.0F}, {0.6F, 0.8F, 0}}) {
    expect_right_handed(normal);
  }
  for (const double tilt : {1e-3, 1e-5, 1e-7}) {
    for (const double z : {1.0, -1.0}) {
      expect_right_handed(normalized(Vec3d{tilt, -0.5 * tilt, z}).to<float>());
    }
  }
}

TEST(Basis, LocalAndWorldAreInverse) {
  const Basis basis(normalized(Vec3f{0.3F, -0.5F, -0.8F}));
  const Vec3f w{1.0F, 2.0F, -3.0F};
  const Vec3f back = basis.world_from_local(basis.local_from_world(w));
  EXPECT_NEAR(length(back - w), 0.0F, 2e-6F);
  EXPECT_NEAR(basis.local_from_world(basis.normal).z, 1.0F, 1e-6F);
}

}  // namespace
}  // namespace sigmascape
