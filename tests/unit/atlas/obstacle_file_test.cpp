#include "sigmascape/atlas/obstacle_file.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "example_obstacles.h"
#include "scratch_folder.h"
#include "sealed_item.h"

#include "sigmascape/atlas/half.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::atlas {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ObstacleFile : public ::testing::Test {
 protected:
  static radar::ObstacleMap empty_map(const Store& atlas, PatchIndex patch) {
    const radar::GroundGrid texels = atlas.description().patches.texels_of(patch);
    return {texels, Array2D<radar::Obstacle>(texels.columns, texels.rows)};
  }
  [[nodiscard]] std::string refusal_of(const radar::Obstacle& obstacle) const {
    radar::ObstacleMap map = empty_map(atlas_, {0, 0});
    map.obstacles(7, 5) = obstacle;
    return message_of_error([&] { write_obstacles(atlas_, {0, 0}, map); });
  }

  ScratchFolder folder_;
  Store atlas_ = Store::create(folder_.path("a"), wide_ground_apart());
};

TEST_F(ObstacleFile, GivesBackWhatStandsToTheNearestHalf) {
  const PatchIndex patch{-2, -1};
  const radar::ObstacleMap map = example_obstacles(atlas_, patch);
  write_obstacles(atlas_, patch, map);
  const Array2D<radar::Obstacle> read = read_obstacles(atlas_, patch);
  ASSERT_EQ(read.columns(), 512U);
  ASSERT_EQ(read.rows(), 512U);
  const auto nearest = [](float value) { return float_from_half(half_from_float(value)); };
  for (std::size_t i = 0; i < read.size(); ++i) {
    const radar::Obstacle& given = map.obstacles.values()[i];
    const radar::Obstacle expected{nearest(given.solid_top_m), nearest(given.crown_base_m), nearest(given.crown_top_m),
                                   nearest(given.crown_extinction_per_m)};
    ASSERT_EQ(read.values()[i], expected) << i;
  }
  // A texel of a metre or two knows no height to a few centimetres.
  EXPECT_NEAR(nearest(49.99F), 49.99F, 0.02F);
}

TEST_F(ObstacleFile, OpensInAGisWithItsLevels) {
  write_obstacles(atlas_, {1, -1}, example_obstacles(atlas_, {1, -1}));
  const auto file = atlas_.folder() / "patch_+001_-001" / "obstacles.tif";
  const geo::GeoRaster raster = geo::read_geotiff(file);
  ASSERT_EQ(raster.bands.size(), 4U);
  EXPECT_EQ(raster.bands[0].name, "SOLID_TOP_M");
  EXPECT_EQ(raster.bands[3].name, "CROWN_EXTINCTION_PER_M");
  EXPECT_DOUBLE_EQ(raster.placement.west_m, 512.0);
  EXPECT_DOUBLE_EQ(raster.placement.north_m, 0.0);
  EXPECT_DOUBLE_EQ(raster.placement.cell_m, 1.0);
  EXPECT_EQ(raster.bands[0].values(100, 200), read_obstacles(atlas_, {1, -1})(100, 200).solid_top_m);
}

// A crown as thin as paper has an extinction beyond every half; what comes back must stay a number.
TEST_F(ObstacleFile, TheLargestExtinctionIsAHalf) {
  radar::ObstacleMap map = empty_map(atlas_, {0, 0});
  map.obstacles(3, 4) = {.crown_base_m = 5.0F, .crown_top_m = 5.01F, .crown_extinction_per_m = 1e6F};
  map.obstacles(3, 5) = {.crown_base_m = 5.0F, .crown_top_m = 9.0F, .crown_extinction_per_m = 1e-6F};
  write_obstacles(atlas_, {0, 0}, map);
  const Array2D<radar::Obstacle> read = read_obstacles(atlas_, {0, 0});
  EXPECT_EQ(read(3, 4).crown_extinction_per_m, largest_half);
  EXPECT_NEAR(read(3, 5).crown_extinction_per_m, 1e-6F, 3e-8F);
}

TEST_F(ObstacleFile, RefusesWhatCannotStand) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const auto is_told = AllOf(HasSubstr("obstacles.tif, column 7, row 5"), HasSubstr("negative or not a finite number"));
  EXPECT_THAT(refusal_of({.solid_top_m = -1.0F}), is_told);
  EXPECT_THAT(refusal_of({.crown_base_m = infinite}), is_told);
  EXPECT_THAT(refusal_of({.crown_top_m = infinite}), is_told);
  EXPECT_THAT(refusal_of({.crown_extinction_per_m = std::numeric_limits<float>::quiet_NaN()}), is_told);
  EXPECT_THAT(message_of_error([&] {
                write_obstacles(atlas_, {0, 0}, empty_map(atlas_, {1, 0}));
              }),
              HasSubstr("is not given on the texels of the patch"));
  EXPECT_FALSE(std::filesystem::exists(atlas_.folder() / "patch_+000_+000"));
}

TEST_F(ObstacleFile, AFormerKindIsFoundOutByItsItem) {
  write_obstacles(atlas_, {0, 0}, example_obstacles(atlas_, {0, 0}));
  rewrite_item(atlas_.folder() / "patch_+000_+000" / "obstacles.json", "sigmascape:tallest_m", "sigmascape:something");
  const auto fault = obstacles_fault(atlas_, {0, 0}, Scrutiny::Size);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->file, "patch_+000_+000/obstacles.tif");
  EXPECT_THAT(fault->what, HasSubstr("former kind"));
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(read_obstacles(atlas_, {0, 0}));
              }),
              AllOf(HasSubstr("patch_+000_+000/obstacles.tif"), HasSubstr("former kind"), HasSubstr("--verify")));
}

}  // namespace
}  // namespace sigmascape::atlas
