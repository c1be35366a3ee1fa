// Who reads a large file can be told to stop, in the loops over what is read and while GDAL itself reads.
#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "unit/geo/ascii_grid.h"
#include "unit/geo/example_frame.h"
#include "unit/geo/read_features.h"

#include "sigmascape/base/interruption.h"
#include "sigmascape/geo/raster.h"
#include "sigmascape/geo/vector_source.h"

namespace sigmascape::geo {
namespace {

/// Asks to stop when it has been asked so often.
class StopAfter {
 public:
  explicit StopAfter(int questions) : left_(questions), interruption_([this] { return left_-- <= 0; }) {}

 private:
  int left_;
  Interruption interruption_;
};

TEST(ToldToStop, ReadingFeatures) {
  const ScratchFolder folder;
  const auto file = folder.write("trees.csv", "east,north\n-2.986,43.312\n-2.985,43.312\n");
  const VectorSource source{
      .file = file, .kind = GeometryKind::Points, .crs = "EPSG:4326", .x_column = "east", .y_column = "north"};
  {
    const StopAfter stop(1000);
    EXPECT_EQ(read_features(source, example_frame).size(), 2U);
  }
  const StopAfter stop(0);
  EXPECT_THROW(static_cast<void>(read_features(source, example_frame)), Interrupted);
}

TEST(ToldToStop, ReadingAnExtractOfOpenStreetMap) {
  const ScratchFolder folder;
  const auto file = folder.write("extract.osm",
                                 "<?xml version='1.0'?><osm version='0.6'>"
                                 "<node id='1' lat='43.312' lon='-2.986'><tag k='natural' v='tree'/></node></osm>");
  const VectorSource source{.file = file, .kind = GeometryKind::Points};
  EXPECT_EQ(read_features(source, example_frame).size(), 1U);
  const StopAfter stop(0);
  EXPECT_THROW(static_cast<void>(read_features(source, example_frame)), Interrupted);
}

TEST(ToldToStop, ReadingRasters) {
  const ScratchFolder folder;
  constexpr AsciiGrid utm{500'600.0, 4'795'000.0, 10.0, 100, 80};
  const Raster raster({folder.write("plane.asc", utm.text([](double, double) { return 1.0; })), 1, "EPSG:25830"});
  const Extent extent = raster.outline_in(example_frame).extent_inside();
  const Lattice lattice{extent.west_m, extent.north_m, 10.0, 50, 40};
  EXPECT_EQ(raster.heights_on(lattice, example_frame)(20, 20), 1.0F);
  const StopAfter stop(0);
  EXPECT_THROW(static_cast<void>(raster.heights_on(lattice, example_frame)), Interrupted);
  EXPECT_THROW(static_cast<void>(raster.classes_on(lattice, example_frame)), Interrupted);
}

}  // namespace
}  // namespace sigmascape::geo
