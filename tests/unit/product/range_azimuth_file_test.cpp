#include "sigmascape/product/range_azimuth_file.h"

#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bytes_of.h"
#include "full_disk.h"
#include "scratch_folder.h"

namespace sigmascape::product {
namespace {

using ::testing::HasSubstr;

const radar::RangeAzimuthGrid grid{.first_range_m = 1000.0,
                                   .range_step_m = 2.5,
                                   .ranges = 2,
                                   .first_azimuth_rad = 0.0,
                                   .azimuth_step_rad = 0.01,
                                   .azimuths = 3};

TEST(RangeAzimuthFile, AFullDiskLeavesNoDescriptionWithoutNumbers) {
  const ScratchFolder folder;
  {
    const FullDisk full(4096);
    EXPECT_THAT(
        message_of_error([&] { write_range_azimuth(folder.path("snr.npy"), grid, Array2D<float>(64, 64), {}); }),
        HasSubstr("snr.npy: cannot be written"));
  }
  EXPECT_EQ(difference_of(files_of(folder.path("")), {}), "");
}

TEST(RangeAzimuthFile, IsTheFormatThatNumpyDocuments) {
  const ScratchFolder folder;
  Array2D<float> bins(3, 2);
  for (std::size_t i = 0; i < bins.size(); ++i) bins.values()[i] = static_cast<float>(i) + 0.5F;
  write_range_azimuth(folder.path("snr.npy"), grid, bins,
                      {.quantity = "made up",
                       .radar_position = {1.5, -2.25, 300.0},
                       .numbers = {{"noise_w", 1e-12}},
                       .words = {{"time_s", "-2.5"}, {"seed", "7"}, {"dwell", "the first"}}});

  const std::string bytes = bytes_of(folder.path("snr.npy"));
  ASSERT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t length = static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ((10 + length) % 64, 0U);
  const std::string header = bytes.substr(10, length);
  EXPECT_THAT(header, HasSubstr("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }"));
  EXPECT_EQ(header.back(), '\n');
  ASSERT_EQ(bytes.size(), 10 + length + 6 * sizeof(float));
  float last = 0.0F;
  std::memcpy(&last, &bytes[bytes.size() - sizeof(float)], sizeof(float));
  EXPECT_EQ(last, 5.5F);

  const std::string json = bytes_of(folder.path("snr.json"));
  EXPECT_THAT(json, HasSubstr("\"quantity\": \"made up\""));
  EXPECT_THAT(json, HasSubstr("\"range_step_m\": 2.5"));
  EXPECT_THAT(json, HasSubstr("where bin 0 begins; its middle lies half a step further"));
  const auto told = nlohmann::json::parse(json);
  EXPECT_EQ(told.at("noise_w"), 1e-12);
  EXPECT_EQ(told.at("radar_position_m"), nlohmann::json({1.5, -2.25, 300.0}));
  EXPECT_EQ(told.at("time_s"), -2.5);
  EXPECT_EQ(told.at("seed"), "7");
  EXPECT_EQ(told.at("dwell"), "the first");
}

TEST(RangeAzimuthFile, WantsItsExtension) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of_error([&] { write_range_azimuth(folder.path("snr.tif"), grid, {}, {}); }),
              HasSubstr("snr.tif: would not be known for a NumPy file; give a name that ends in .npy"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path(".")));
}

}  // namespace
}  // namespace sigmascape::product
