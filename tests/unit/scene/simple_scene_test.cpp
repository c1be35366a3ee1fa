#include "sigmascape/scene/simple_scene.h"

#include <gtest/gtest.h>

#include "sigmascape/base/error.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::scene {
namespace {

TEST(SimpleScene, IsABoxAndACylinderOnFlatConcrete) {
  const Scene scene = simple_scene();
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_FLOAT_EQ(scene.terrain.lowest_m(), 0.0F);
  EXPECT_FLOAT_EQ(scene.terrain.highest_m(), 0.0F);
  EXPECT_EQ(scene.terrain.extent(), scene.extent);
  EXPECT_EQ(scene.ground.grid.extent(), scene.extent);
  ASSERT_EQ(scene.materials.size(), 1U);
  EXPECT_EQ(scene.materials[scene.ground.at({1.0, 1.0})].name, "concrete");
}

TEST(SimpleScene, TakesSizesAndPlacesFromItsOptions) {
  const Scene scene = simple_scene({.box_centre = {-11.0, 3.0},
                                    .box_size_m = {4.0F, 5.0F, 6.0F},
                                    .box_yaw_rad = 0.5,
                                    .cylinder_height_m = 21.0,
                                    .ground_material = "grass"});
  EXPECT_NEAR(signed_volume_m3(scene.prototypes[scene.instances[0].prototype]), 120.0, 1e-3);
  EXPECT_FLOAT_EQ(scene.instances[0].x_m, -11.0F);
  EXPECT_FLOAT_EQ(scene.instances[0].y_m, 3.0F);
  EXPECT_FLOAT_EQ(scene.instances[0].yaw_rad, 0.5F);
  EXPECT_NEAR(tallest_object_m(scene), 21.0, 1e-5);
  EXPECT_EQ(scene.materials[scene.ground.at({0.0, 0.0})].name, "grass");
}

TEST(SimpleScene, RefusesAnUnknownMaterial) {
  EXPECT_THROW((void)simple_scene({.ground_material = "cheese"}), Error);
}

}  // namespace
}  // namespace sigmascape::scene
