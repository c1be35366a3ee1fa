#include "sigmascape/scene/land_cover_reader.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "unit/geo/ascii_grid.h"

#include "sigmascape/scatter/material.h"

namespace sigmascape::scene {
namespace {

// A web-Mercator cell of 1 km is M cos φ / a of that northward: 500.4 m at 60 N, whatever it is where the raster has
// its middle.
TEST(LandCover, CellIsThatOfTheRasterWhereTheSceneLies) {
  const ScratchFolder folder;
  const geo::AsciiGrid mercator{-10e3, 0.0, 1000.0, 20, 9000};
  LandCoverSource source;
  source.raster =
      geo::RasterBand{folder.write("classes.asc", mercator.text([](double, double) { return 30.0; })), 1, "EPSG:3857"};
  source.nodata = scatter::library_material("grass");
  source.materials[30] = scatter::library_material("grass");
  Scene scene;
  scene.frame = geo::LocalFrame(60.0, 0.0);
  scene.extent = {-4e3, -4e3, 4e3, 4e3};
  static_cast<void>(add_land_cover(scene, source));
  EXPECT_NEAR(scene.ground.grid.cell_m, 500.4, 0.2);
}

}  // namespace
}  // namespace sigmascape::scene
