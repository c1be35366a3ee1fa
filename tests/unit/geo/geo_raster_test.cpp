#include "sigmascape/geo/geo_raster.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <unistd.h>

#include "bytes_of.h"
#include "scratch_folder.h"

#include "sigmascape/base/error.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/geo/quiet_gdal.h"

namespace sigmascape::geo {
namespace {

class GeoRasterFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("sigmascape_geo_raster_") + test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

/// 300 × 270 cells, so that tiles at the edges are not full.
GeoRaster example_raster() {
  GeoRaster raster;
  raster.placement = {-1234.5, 987.25, 2.5, LocalFrame(43.26, -2.93).proj()};
  Array2D<float> ramp(300, 270);
  Array2D<float> waves(300, 270);
  for (std::size_t row = 0; row < 270; ++row) {
    for (std::size_t column = 0; column < 300; ++column) {
      ramp(column, row) = static_cast<float>(column) * 1e-3F - static_cast<float>(row) * 7.0F;
      waves(column, row) = std::sin(static_cast<float>(column * row));
    }
  }
  waves(3, 5) = std::numeric_limits<float>::quiet_NaN();
  raster.bands = {{"ramp", ramp}, {"waves", waves}};
  raster.nodata = std::numeric_limits<float>::quiet_NaN();
  raster.metadata = {{"view", "azimuth 130 deg, \"quoted\" & <odd>"}, {"frequency_hz", "1e10"}};
  return raster;
}

TEST_F(GeoRasterFile, ReadsBackWhatWasWritten) {
  const GeoRaster written = example_raster();
  write_geotiff(folder_ / "map.tif", written);
  const GeoRaster read = read_geotiff(folder_ / "map.tif");
  EXPECT_DOUBLE_EQ(read.placement.west_m, written.placement.west_m);
  EXPECT_DOUBLE_EQ(read.placement.north_m, written.placement.north_m);
  EXPECT_DOUBLE_EQ(read.placement.cell_m, written.placement.cell_m);
  EXPECT_EQ(read.metadata, written.metadata);
  ASSERT_TRUE(read.nodata.has_value());
  EXPECT_TRUE(std::isnan(*read.nodata));
  ASSERT_EQ(read.bands.size(), 2U);
  for (std::size_t band = 0; band < 2; ++band) {
    EXPECT_EQ(read.bands[band].name, written.bands[band].name);
    for (std::size_t i = 0; i < written.bands[band].values.size(); ++i) {
      const float expected = written.bands[band].values.values()[i];
      const float value = read.bands[band].values.values()[i];
      ASSERT_TRUE(value == expected || (std::isnan(value) && std::isnan(expected))) << band << " " << i;
    }
  }
}

TEST_F(GeoRasterFile, TheCrsIsTheLocalFrame) {
  write_geotiff(folder_ / "map.tif", example_raster());
  const std::string wkt = read_geotiff(folder_ / "map.tif").placement.crs;
  EXPECT_THAT(wkt, testing::StartsWith("PROJCRS[\"Sigmascape local transverse Mercator at 43.26 N, 2.93 W\""));
  EXPECT_THAT(wkt, testing::HasSubstr("43.26"));
  EXPECT_THAT(wkt, testing::HasSubstr("-2.93"));
}

TEST_F(GeoRasterFile, NothingIsLeftBesideTheFile) {
  write_geotiff(folder_ / "map.tif", example_raster());
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++files;
  EXPECT_EQ(files, 1U);
}

TEST_F(GeoRasterFile, StatisticsOfTheFileBeforeAreNotKept) {
  write_geotiff(folder_ / "map.tif", example_raster());
  std::ofstream(folder_ / "map.tif.aux.xml") << "<PAMDataset/>";
  write_geotiff(folder_ / "map.tif", example_raster());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "map.tif.aux.xml"));
  std::filesystem::create_symlink("map.tif", folder_ / "latest.tif");
  for (const char* name : {"map.tif.aux.xml", "latest.tif.aux.xml"}) std::ofstream(folder_ / name) << "<PAMDataset/>";
  write_geotiff(folder_ / "latest.tif", example_raster());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "map.tif.aux.xml")) << "they lie beside what the link leads to";
  EXPECT_FALSE(std::filesystem::exists(folder_ / "latest.tif.aux.xml"));
}

TEST_F(GeoRasterFile, EqualRastersGiveEqualBytes) {
  write_geotiff(folder_ / "a.tif", example_raster());
  write_geotiff(folder_ / "b.tif", example_raster());
  EXPECT_EQ(bytes_of(folder_ / "a.tif"), bytes_of(folder_ / "b.tif"));
}

// GDAL's own script; it comes with GDAL's Python, which the library does not need.
TEST_F(GeoRasterFile, IsCloudOptimisedInTheEyesOfGdal) {
  const auto validates = [](const std::string& file) {
    return std::system(
        ("/usr/bin/python3 -m osgeo_utils.samples.validate_cloud_optimized_geotiff '" + file + "' > /dev/null 2>&1")
            .c_str());
  };
  if (std::system("/usr/bin/python3 -c 'import osgeo_utils.samples.validate_cloud_optimized_geotiff' 2> /dev/null") !=
      0)
    GTEST_SKIP() << "GDAL's Python scripts are not installed (python3-gdal)";
  const auto path = folder_ / "cog.tif";
  GeoRaster large = example_raster();
  for (NamedBand& band : large.bands) band.values = Array2D<float>(1100, 700, 2.5F);
  write_geotiff(path, large);
  EXPECT_EQ(validates(path.string()), 0);
  write_geotiff(path, example_raster());
  EXPECT_EQ(validates(path.string()), 0);
}

// 300 columns: 2 × 2 cells make one of the overview; the cell that is not known counts for nothing.
TEST_F(GeoRasterFile, OverviewsAreMeansAndOfClassesTheCornerCell) {
  GeoRaster raster = example_raster();
  raster.bands[0].values = Array2D<float>(300, 270, 7.0F);
  raster.bands[0].values(1, 0) = 3.0F;
  raster.bands[0].values(1, 1) = std::numeric_limits<float>::quiet_NaN();
  raster.bands[1].values = raster.bands[0].values;
  raster.bands[1].is_classes = true;
  write_geotiff(folder_ / "o.tif", raster);
  const std::string command = "gdal_translate -q -oo OVERVIEW_LEVEL=0 -co TILED=NO '" + (folder_ / "o.tif").string() +
                              "' '" + (folder_ / "half.tif").string() + "' 2> /dev/null";
  if (std::system(command.c_str()) != 0) GTEST_SKIP() << "gdal_translate is not installed";
  const GeoRaster half = read_geotiff(folder_ / "half.tif");
  EXPECT_EQ(half.bands.at(0).values.columns(), 150U);
  EXPECT_NEAR(half.bands[0].values(0, 0), (7.0 + 3.0 + 7.0) / 3.0, 1e-6);
  EXPECT_EQ(half.bands[0].values(1, 0), 7.0F);
  EXPECT_EQ(half.bands[1].values(0, 0), 7.0F);
}

TEST_F(GeoRasterFile, BandsOfDifferentSizeAreRefusedByName) {
  GeoRaster raster = example_raster();
  raster.bands[1].values = Array2D<float>(10, 10);
  try {
    write_geotiff(folder_ / "map.tif", raster);
    FAIL() << "written all the same";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("band waves"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "map.tif"));
}

// GDAL would read "a=b", "c" back as "a", "b=c".
TEST_F(GeoRasterFile, KeysThatWouldBeReadAsOthersAreRefused) {
  GeoRaster raster = example_raster();
  for (const char* key : {"a=b", "dc:title", ""}) {
    raster.metadata = {{key, "c"}};
    EXPECT_THROW(write_geotiff(folder_ / "map.tif", raster), Error) << key;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "map.tif"));
  raster.metadata = {{"a", "b=c"}};
  write_geotiff(folder_ / "map.tif", raster);
  EXPECT_EQ(read_geotiff(folder_ / "map.tif").metadata.at("a"), "b=c");
}

TEST_F(GeoRasterFile, ACrsThatIsNoneIsRefused) {
  GeoRaster raster = example_raster();
  raster.placement.crs = "somewhere";
  EXPECT_THROW(write_geotiff(folder_ / "map.tif", raster), Error);
}

TEST_F(GeoRasterFile, ACrsThatTheFileCannotHoldIsRefused) {
  GeoRaster raster = example_raster();
  raster.placement.crs = "+proj=ob_tran +o_proj=longlat +o_lon_p=-162 +o_lat_p=39.25 +lon_0=180 +to_meter=0.0174532925";
  try {
    write_geotiff(folder_ / "map.tif", raster);
    EXPECT_EQ(read_geotiff(folder_ / "map.tif").placement.crs, raster.placement.crs);
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("GeoTIFF has no keys for"), std::string::npos) << error.what();
    EXPECT_FALSE(std::filesystem::exists(folder_ / "map.tif"));
  }
}

TEST_F(GeoRasterFile, AFileThatIsNoneIsRefused) {
  write_atomically(folder_ / "map.tif", "II*");
  EXPECT_THROW(static_cast<void>(read_geotiff(folder_ / "map.tif")), Error);
  EXPECT_THROW(static_cast<void>(read_geotiff(folder_ / "missing.tif")), Error);
}

TEST_F(GeoRasterFile, ATruncatedFileIsRefused) {
  write_geotiff(folder_ / "map.tif", example_raster());
  std::filesystem::resize_file(folder_ / "map.tif", std::filesystem::file_size(folder_ / "map.tif") / 2);
  EXPECT_THROW(static_cast<void>(read_geotiff(folder_ / "map.tif")), Error);
}

// Of which nothing is stored.
TEST_F(GeoRasterFile, AFileLargerThanMemoryIsRefused) {
  const QuietGdal quiet;
  register_gdal_drivers();
  CPLStringList options;
  options.SetNameValue("SPARSE_OK", "TRUE");
  options.SetNameValue("TILED", "YES");
  options.SetNameValue("BLOCKXSIZE", "65536");
  options.SetNameValue("BLOCKYSIZE", "65536");
  const std::filesystem::path file = folder_ / "huge.tif";
  {
    const GDALDatasetUniquePtr huge(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        file.c_str(), 4'000'000, 4'000'000, 1, GDT_Byte, options.List()));
    ASSERT_NE(huge, nullptr);
    std::array<double, 6> placement{0.0, 1.0, 0.0, 0.0, 0.0, -1.0};
    huge->SetGeoTransform(placement.data());
    huge->SetProjection("EPSG:32630");
  }
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_geotiff(file)); }),
              ::testing::HasSubstr("huge.tif: holds 4000000 × 4000000 cells in 1 bands, which take 6.4e+04 GB"));
}

}  // namespace
}  // namespace sigmascape::geo
