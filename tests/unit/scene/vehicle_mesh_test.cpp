#include "sigmascape/scene/vehicle_mesh.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "closed_mesh.h"

#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::scene {
namespace {

class VehicleMesh : public testing::TestWithParam<VehicleKind> {
 protected:
  Mesh vehicle = vehicle_mesh(GetParam(), 3);
  VehicleSize size = vehicle_size(GetParam());
};

TEST_P(VehicleMesh, FillsItsSizeAndStandsOnTheGround) {
  Vec3f low{1e9F, 1e9F, 1e9F}, high{-1e9F, -1e9F, -1e9F};
  for (const Vec3f& v : vehicle.vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  EXPECT_NEAR(low.x, -size.width_m / 2.0F, 1e-5F);
  EXPECT_NEAR(high.x, size.width_m / 2.0F, 1e-5F);
  EXPECT_NEAR(low.y, -size.length_m / 2.0F, 1e-5F);
  EXPECT_NEAR(high.y, size.length_m / 2.0F, 1e-5F);
  EXPECT_NEAR(low.z, 0.0F, 0.05F);
  EXPECT_GE(low.z, 0.0F);
  EXPECT_NEAR(high.z, size.height_m, 1e-5F);
}

TEST_P(VehicleMesh, IsClosedWithNormalsOutward) {
  EXPECT_TRUE(is_closed(vehicle));
  const double box_m3 = static_cast<double>(size.width_m * size.length_m * size.height_m);
  EXPECT_GT(signed_volume_m3(vehicle), 0.4 * box_m3);
  EXPECT_LT(signed_volume_m3(vehicle), box_m3);
}

TEST_P(VehicleMesh, FlanksAreUprightAndFaceSideways) {
  double right_m2 = 0.0, left_m2 = 0.0;
  for (const auto& [a, b, c] : vehicle.triangles) {
    const Vec3f twice = cross(vehicle.vertices[b] - vehicle.vertices[a], vehicle.vertices[c] - vehicle.vertices[a]);
    const Vec3f normal = normalized(twice);
    if (normal.x > 0.9999F) right_m2 += static_cast<double>(length(twice)) / 2.0;
    if (normal.x < -0.9999F) left_m2 += static_cast<double>(length(twice)) / 2.0;
  }
  EXPECT_NEAR(right_m2, left_m2, 1e-3);
  EXPECT_GT(right_m2, 0.5 * static_cast<double>(size.length_m * size.height_m));
}

TEST_P(VehicleMesh, IsOfOneMaterial) {
  ASSERT_EQ(vehicle.materials.size(), vehicle.triangles.size());
  EXPECT_EQ(std::ranges::count(vehicle.materials, MaterialIndex{3}),
            static_cast<std::ptrdiff_t>(vehicle.triangles.size()));
}

INSTANTIATE_TEST_SUITE_P(Kinds, VehicleMesh, testing::Values(VehicleKind::Car, VehicleKind::Van, VehicleKind::Truck));

TEST(CarMesh, DrivesTowardsItsBonnet) {
  // The bonnet is lower than the boot, so the highest forward-facing point of the nose lies below that of the tail.
  const Mesh car = vehicle_mesh(VehicleKind::Car, 0);
  float nose = 0.0F, tail = 0.0F;
  for (const Vec3f& v : car.vertices) {
    if (v.y > 2.2F) nose = std::max(nose, v.z);
    if (v.y < -2.2F) tail = std::max(tail, v.z);
  }
  EXPECT_LT(nose, tail);
}

}  // namespace
}  // namespace sigmascape::scene
