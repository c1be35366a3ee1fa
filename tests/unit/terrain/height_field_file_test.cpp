#include "sigmascape/terrain/height_field_file.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/base/error.h"

namespace sigmascape::terrain {
namespace {

TEST(HeightFieldFile, ComesBackNodeForNode) {
  const ScratchFolder folder;
  HeightField field;
  field.west_m = -120.5;
  field.north_m = 310.0;
  field.spacing_m = 7.5;
  field.height_m = Array2D<float>(13, 9);
  float height = 1.25F;
  for (float& node : field.height_m.values()) node = (height *= -1.07F);
  write_height_field(folder.path("terrain.tif"), field, "+proj=tmerc +lat_0=43 +lon_0=-3 +k=1 +datum=WGS84 +units=m");
  const HeightField back = read_height_field(folder.path("terrain.tif"));
  EXPECT_DOUBLE_EQ(back.west_m, field.west_m);
  EXPECT_DOUBLE_EQ(back.north_m, field.north_m);
  EXPECT_DOUBLE_EQ(back.spacing_m, field.spacing_m);
  ASSERT_EQ(back.height_m.columns(), field.height_m.columns());
  EXPECT_TRUE(std::ranges::equal(back.height_m.values(), field.height_m.values()));
}

TEST(HeightFieldFile, IsRefusedWhenItIsNotThere) {
  EXPECT_THROW((void)read_height_field("nowhere/terrain.tif"), Error);
}

}  // namespace
}  // namespace sigmascape::terrain
