#include "sigmascape/product/map_file.h"

#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "bytes_of.h"
#include "full_disk.h"
#include "scratch_folder.h"

#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/product/ground_map_file.h"
#include "sigmascape/product/npy_bytes.h"
#include "sigmascape/product/npy_file.h"

namespace sigmascape::product {
namespace {

radar::GroundMap small_map() {
  radar::GroundMap map{.grid = {10.0, 20.0, 2.0, 3, 2},
                       .sigma0 = Array2D<radar::Channels>(3, 2, {0.5F, 0.25F, 0.125F, 0.1F}),
                       .crs = geo::LocalFrame().proj(),
                       .metadata = {{"radar", "test"}}};
  map.sigma0(1, 0) = {};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  map.sigma0(2, 1) = {nan, nan, nan, nan};
  return map;
}

TEST(MapFile, HoldsDecibelsWhereTheyAreAskedFor) {
  const ScratchFolder folder;
  write_map(folder.path("map.tif"), small_map(), MapScale::Decibels);
  const auto raster = geo::read_geotiff(folder.path("map.tif"));
  ASSERT_EQ(raster.bands.size(), 3U);
  EXPECT_EQ(raster.bands[1].name, "HH");
  EXPECT_NEAR(raster.bands[0].values(0, 0), -3.0103, 1e-4);
  EXPECT_NEAR(raster.bands[1].values(0, 0), -6.0206, 1e-4);
  EXPECT_EQ(raster.bands[0].values(1, 0), -100.0F);
  EXPECT_TRUE(std::isnan(raster.bands[0].values(2, 1)));

  const auto again = read_ground_map(folder.path("map.tif"));
  EXPECT_NEAR(again.sigma0(0, 0).hv, 0.125, 1e-6);
  EXPECT_TRUE(std::isnan(again.sigma0(0, 0).re_vvhh));
  EXPECT_TRUE(std::isnan(again.sigma0(2, 1).vv));
  EXPECT_EQ(again.metadata, small_map().metadata);
}

TEST(MapFile, PlacesAreNamedWithTheUnitThatTheyHave) {
  const ScratchFolder folder;
  radar::GroundMap map = small_map();
  map.crs = "EPSG:4326";
  write_map(folder.path("map.npy"), map);
  EXPECT_THAT(bytes_of(folder.path("map.json")),
              testing::AllOf(testing::HasSubstr("\"west_deg\": 10.0"), testing::HasSubstr("\"cell_deg\": 2.0"),
                             testing::HasSubstr("west and north are those of the north-western cell"),
                             testing::Not(testing::HasSubstr("_m\""))));
  write_map(folder.path("map.npz"), map);
  EXPECT_THAT(bytes_of(folder.path("map.npz")), testing::HasSubstr("x_deg.npy"));
  write_map(folder.path("map.tif"), map);
  EXPECT_EQ(geo::read_geotiff(folder.path("map.tif")).metadata.at("SIGMASCAPE_GRID"),
            "west 10 deg, north 20 deg, cell 2 deg, 3 x 2 cells");
}

// A scene is called after its file, and the names of files are bytes.
TEST(MapFile, NamesThatAreNoTextDoNotKeepAMapFromBeingWritten) {
  const ScratchFolder folder;
  radar::GroundMap map = small_map();
  map.metadata["scene"] = "caf\xe9";
  write_map(folder.path("map.npy"), map);
  EXPECT_EQ(nlohmann::json::parse(bytes_of(folder.path("map.json"))).at("scene"), "caf\uFFFD");
  EXPECT_NO_THROW(write_map(folder.path("map.npz"), map));
}

TEST(MapFile, AFullDiskLeavesNoDescriptionWithoutNumbers) {
  const ScratchFolder folder;
  radar::GroundMap map = small_map();
  map.grid.columns = map.grid.rows = 64;
  map.sigma0 = Array2D<radar::Channels>(64, 64);
  {
    const FullDisk full(8192);
    EXPECT_THAT(message_of_error([&] { write_map(folder.path("map.npy"), map); }),
                ::testing::HasSubstr("map.npy: cannot be written"));
  }
  EXPECT_EQ(difference_of(files_of(folder.path("")), {}), "");
}

// Beside the link the description would be lost, and numbers of one scale would lie beside words of another.
TEST(MapFile, ThroughALinkNumbersAndDescriptionStayTogether) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("maps"));
  write_map(folder.path("maps/today.npy"), small_map(), MapScale::Linear);
  write_map(folder.path("decibels.npy"), small_map(), MapScale::Decibels);
  std::filesystem::create_symlink("maps/today.npy", folder.path("latest.npy"));
  write_map(folder.path("latest.npy"), small_map(), MapScale::Decibels);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("latest.npy")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("latest.json")));
  for (const char* ending : {".npy", ".json"}) {
    EXPECT_EQ(bytes_of(folder.path(std::string("maps/today") + ending)),
              bytes_of(folder.path(std::string("decibels") + ending)));
  }
}

TEST(MapFile, RefusesOtherEndings) {
  EXPECT_NE(message_of_error([] { check_map_name("map.jpg"); }).find(".tif, .npy or .npz"), std::string::npos);
  for (const char* name : {"a.tif", "a.npy", "a.npz", "A.TIF", "A.Npy", "A.NPZ"}) check_map_name(name);
}

TEST(NpyFile, ReadsWhatWasWrittenAndRefusesElse) {
  const ScratchFolder folder;
  const std::vector<std::complex<float>> numbers{{1.0F, 2.0F}, {3.0F, 4.0F}, {5.0F, 6.0F}, {7.0F, 8.0F}};
  const std::array<std::size_t, 3> shape{2, 1, 2};
  folder.write("a.npy", npy_bytes("<c8", shape, std::as_bytes(std::span(numbers))));
  const ComplexArray array = read_complex_npy(folder.path("a.npy"));
  EXPECT_EQ(array.shape, (std::vector<std::size_t>{2, 1, 2}));
  EXPECT_EQ(array.numbers, numbers);
  const auto told = [&](const std::string& bytes) {
    folder.write("b.npy", bytes);
    return message_of_error([&] { (void)read_complex_npy(folder.path("b.npy")); });
  };
  const std::string whole = npy_bytes("<c8", shape, std::as_bytes(std::span(numbers)));
  EXPECT_NE(told(whole.substr(0, whole.size() - 4)).find("cut off"), std::string::npos);
  EXPECT_NE(told(npy_bytes("<f4", shape, std::as_bytes(std::span(numbers)).first(16))).find("something else"),
            std::string::npos);
  EXPECT_NE(told("hello").find("no NumPy file"), std::string::npos);
  // 2^32 · 2^29 numbers of 8 bytes take 2^64 bytes, which is 0 where no more digits are.
  const std::array<std::size_t, 2> endless{std::size_t{1} << 32U, std::size_t{1} << 29U};
  EXPECT_NE(told(npy_bytes("<c8", endless, {})).find("cut off"), std::string::npos);
}

}  // namespace
}  // namespace sigmascape::product
