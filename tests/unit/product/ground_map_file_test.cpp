#include "sigmascape/product/ground_map_file.h"

#include <array>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "unit/product/made_up_map.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/product/described_map.h"
#include "sigmascape/product/map_file.h"

namespace sigmascape::product {
namespace {

radar::GroundMap rough_map() {
  radar::GroundMap map;
  map.grid = {.west_m = -150.5, .north_m = 301.25, .cell_m = 0.75, .columns = 300, .rows = 41};
  map.crs = geo::LocalFrame(43.26, -2.93).proj();
  map.metadata = {{"attribution", "© somebody & others"}, {"frequency_hz", "1e+10"}};
  map.sigma0 = Array2D<radar::Channels>(300, 41);
  for (std::size_t i = 0; i < map.sigma0.size(); ++i) {
    const auto value = [&](int channel) { return unit_float(hashed(i, channel)); };
    map.sigma0.values()[i] = {value(0), value(1), 1e-9F * value(2), value(3) - 0.5F};
  }
  map.sigma0(7, 7) = {unseen_power, unseen_power, unseen_power, unseen_power};
  return map;
}

TEST(GroundMapFile, ReadsBackTheSameMap) {
  const ScratchFolder folder;
  const auto path = folder.path("map.tif");
  const radar::GroundMap written = rough_map();
  write_map(path, written);
  const radar::GroundMap read = read_ground_map(path);
  EXPECT_EQ(read.grid, written.grid);
  EXPECT_EQ(read.crs, written.crs);
  EXPECT_EQ(read.metadata, written.metadata);
  ASSERT_EQ(read.sigma0.size(), written.sigma0.size());
  for (std::size_t i = 0; i < read.sigma0.size(); ++i) {
    using Bits = std::array<std::uint32_t, 4>;
    ASSERT_EQ(std::bit_cast<Bits>(read.sigma0.values()[i]), std::bit_cast<Bits>(written.sigma0.values()[i])) << i;
  }
}

TEST(GroundMapFile, AFileThatAGisMovedOrNamedAnewKeepsItsOwnCrs) {
  const ScratchFolder folder;
  const auto path = folder.path("map.tif");
  for (const double moved_m : {1000.0, 0.0}) {
    write_map(path, rough_map());
    geo::GeoRaster raster = geo::read_geotiff(path);
    raster.placement.west_m += moved_m;
    raster.placement.crs = "EPSG:25830";
    geo::write_geotiff(path, raster);
    const radar::GroundMap read = read_ground_map(path);
    EXPECT_EQ(read.grid.west_m, -150.5 + moved_m);
    EXPECT_THAT(read.crs, testing::HasSubstr("UTM zone 30N")) << moved_m;
    EXPECT_EQ(read.metadata.at(local_frame_key), rough_map().crs) << "what is told of the radar stays in its frame";
  }
}

TEST(GroundMapFile, BandsMayStandInAnyOrderAndNodataMayBeANumber) {
  const ScratchFolder folder;
  const auto path = folder.path("map.tif");
  geo::GeoRaster raster{.placement = {0.0, 0.0, 1.0, "EPSG:25830"}, .bands = {}, .nodata = -1.0F, .metadata = {}};
  for (const char* name : {"RE_VVHH", "HV", "HH", "VV"}) {
    raster.bands.push_back({name, Array2D<float>(2, 1, name == std::string("VV") ? 5.0F : 1.0F)});
    raster.bands.back().values(1, 0) = -1.0F;
  }
  geo::write_geotiff(path, raster);
  const radar::GroundMap map = read_ground_map(path);
  EXPECT_EQ(map.sigma0(0, 0).vv, 5.0F);
  EXPECT_EQ(map.sigma0(0, 0).re_vvhh, 1.0F);
  EXPECT_TRUE(std::isnan(map.sigma0(1, 0).vv));
}

// As gdal_translate -b leaves them.
TEST(GroundMapFile, OfOnePolarizationOnlyItsBandsAreNeeded) {
  const ScratchFolder folder;
  const auto path = folder.path("map.tif");
  geo::GeoRaster raster{.placement = {0.0, 0.0, 1.0, "EPSG:25830"}, .bands = {}, .nodata = {}, .metadata = {}};
  raster.bands.push_back({"HH", Array2D<float>(2, 1, 3.0F)});
  geo::write_geotiff(path, raster);
  const radar::GroundMap map = read_ground_map(path, radar::Polarization::HH);
  EXPECT_EQ(map.sigma0(1, 0).hh, 3.0F);
  EXPECT_TRUE(std::isnan(map.sigma0(1, 0).vv));
  for (const auto& [lacking, band] :
       {std::pair(radar::Polarization::VV, "VV"), std::pair(radar::Polarization::VH, "HV"),
        std::pair(radar::Polarization::Sum, "VV")})
    EXPECT_THAT(message_of_error([&] { (void)read_ground_map(path, lacking); }),
                testing::HasSubstr(std::string("it has no band named ") + band));
  raster.bands.push_back({"VV", Array2D<float>(2, 1, 5.0F)});
  raster.bands.push_back({"HV", Array2D<float>(2, 1, 0.5F)});
  geo::write_geotiff(path, raster);
  EXPECT_EQ(read_ground_map(path, radar::Polarization::Sum).sigma0(0, 0).power(radar::Polarization::Sum), 9.0F);
  EXPECT_THAT(message_of_error([&] { (void)read_ground_map(path); }), testing::HasSubstr("RE_VVHH"));
}

TEST(GroundMapFile, OtherFilesAreRefusedWithTheReason) {
  const ScratchFolder folder;
  geo::GeoRaster heights;
  heights.placement = {0.0, 0.0, 1.0, "EPSG:25830"};
  heights.bands.push_back({"height", Array2D<float>(4, 4, 1.0F)});
  geo::write_geotiff(folder.path("heights.tif"), heights);
  try {
    (void)read_ground_map(folder.path("heights.tif"));
    FAIL() << "a height raster was taken for a ground map";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("heights.tif"));
    EXPECT_THAT(error.what(), testing::HasSubstr("not a ground map"));
    EXPECT_THAT(error.what(), testing::HasSubstr("VV"));
  }
  std::ofstream(folder.path("text.tif")) << "no raster at all";
  EXPECT_THROW((void)read_ground_map(folder.path("text.tif")), Error);
  EXPECT_THROW((void)read_ground_map(folder.path("absent.tif")), Error);
}

TEST(GroundMapFile, AMapThatDoesNotFitItsGridIsRefused) {
  radar::GroundMap map = rough_map();
  map.grid.columns = 299;
  const ScratchFolder folder;
  const auto path = folder.path("map.tif");
  EXPECT_THROW(write_map(path, map), Error);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(GroundMapFile, GdalinfoSeesBandsPlaceAndNodata) {
  if (std::system("gdalinfo --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "gdalinfo (package gdal-bin) is not installed";
  const ScratchFolder folder;
  const auto path = folder.path("map.tif");
  write_map(path, rough_map());
  std::string info;
  std::FILE* pipe = popen(("gdalinfo '" + path.string() + "'").c_str(), "r");
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) info += buffer.data();
  EXPECT_EQ(pclose(pipe), 0);
  for (const char* part : {"Size is 300, 41", "Origin = (-150.500000000000000,301.250000000000000)",
                           "Transverse Mercator", "Description = VV", "Description = HH", "Description = HV",
                           "Description = RE_VVHH", "Type=Float32", "NoData Value=nan", "frequency_hz=1e+10"}) {
    EXPECT_THAT(info, testing::HasSubstr(part));
  }
}

}  // namespace
}  // namespace sigmascape::product
