#include "sigmascape/product/layer_file.h"

#include <cstddef>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>

#include "scratch_folder.h"

#include "sigmascape/base/units.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/geo/local_frame.h"

namespace sigmascape::product {
namespace {

TEST(LayerFile, HoldsABandForEachLayerWithAnglesInDegrees) {
  const ScratchFolder folder;
  radar::LayerStack stack{
      .grid = {10.0, 20.0, 2.0, 3, 2}, .layers = {}, .crs = geo::LocalFrame().proj(), .metadata = {}};
  stack.layers.push_back({"incidence", "rad", Array2D<float>(3, 2, static_cast<float>(pi / 6.0))});
  stack.layers.push_back({"shadow", "", Array2D<float>(3, 2, 1.0F)});
  write_layers(folder.path("layers.tif"), stack);
  const auto raster = geo::read_geotiff(folder.path("layers.tif"));
  ASSERT_EQ(raster.bands.size(), 2U);
  EXPECT_EQ(raster.bands[0].name, "incidence");
  EXPECT_NEAR(raster.bands[0].values(2, 1), 30.0, 1e-5);
  EXPECT_EQ(raster.metadata.at("UNIT_incidence"), "deg");
  EXPECT_EQ(raster.bands[0].unit, "deg");
  EXPECT_EQ(raster.bands[1].unit, "");
  EXPECT_EQ(raster.bands[1].name, "shadow");
  EXPECT_EQ(raster.bands[1].values(0, 0), 1.0F);
  EXPECT_EQ(raster.placement.west_m, 10.0);
  EXPECT_EQ(raster.placement.north_m, 20.0);
}

// Whoever looks at the whole map is shown overviews: a mask is 0 or 1 there too, and a length has its mean.
TEST(LayerFile, OverviewsOfMasksHoldNothingBetweenTheirNumbers) {
  const ScratchFolder folder;
  constexpr std::size_t side = 512;
  radar::LayerStack stack{
      .grid = {0.0, 0.0, 1.0, side, side}, .layers = {}, .crs = geo::LocalFrame().proj(), .metadata = {}};
  Array2D<float> stripes(side, side);
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) stripes(column, row) = column % 2 == 0 ? 1.0F : 0.0F;
  }
  stack.layers = {{"shadow", "", stripes}, {"height", "m", stripes}};
  write_layers(folder.path("layers.tif"), stack);

  const std::string command = "gdal_translate -q -oo OVERVIEW_LEVEL=0 -co TILED=NO '" +
                              folder.path("layers.tif").string() + "' '" + folder.path("half.tif").string() +
                              "' 2> /dev/null";
  if (std::system(command.c_str()) != 0) GTEST_SKIP() << "gdal_translate is not installed";
  const auto half = geo::read_geotiff(folder.path("half.tif"));
  ASSERT_EQ(half.bands.at(0).values.columns(), side / 2);
  for (std::size_t i = 0; i < half.bands[0].values.size(); ++i) {
    ASSERT_EQ(half.bands[0].values.values()[i], 1.0F) << "the north-western of four cells";
    ASSERT_EQ(half.bands[1].values.values()[i], 0.5F);
  }
}

}  // namespace
}  // namespace sigmascape::product
