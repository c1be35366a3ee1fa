#include "sigmascape/product/layer_file.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace sigmascape::product
