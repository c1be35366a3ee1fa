#include "sigmascape/geo/half_pyramid.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/geo/local_frame.h"

namespace sigmascape::geo {
namespace {

/// Halves of every magnitude, subnormal ones among them, in two bands that differ.
HalfPyramid example_pyramid() {
  HalfPyramid pyramid;
  pyramid.placement = {512.0, 1024.0, 0.5, LocalFrame(43.26, -2.93).proj()};
  pyramid.band_names = {"VV", "HH"};
  pyramid.scale = 0x1p-5;
  pyramid.columns = pyramid.rows = 1024;
  pyramid.metadata = {{"who", "test"}};
  for (std::size_t level = 0; level < 3; ++level) {
    const std::size_t side = 1024U >> level;
    std::vector<float>& values = pyramid.levels.emplace_back(side * side * 2);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto mantissa = static_cast<float>(1024 + (i * 7 + level) % 1024);
      values[i] = std::ldexp(mantissa, static_cast<int>(i % 30) - 24) * (i % 2 == 0 ? 1.0F : -1.0F);
      if (i % 11 == 0) values[i] = static_cast<float>(i % 1024) * 0x1p-24F;
    }
  }
  return pyramid;
}

TEST(HalfPyramid, ReadsBackExactlyTimesItsScale) {
  const HalfPyramid pyramid = example_pyramid();
  const auto file =
      std::filesystem::path(testing::TempDir()) / ("sigmascape_half_pyramid_" + std::to_string(::getpid()) + ".tif");
  write_atomically(file, half_cog_bytes(pyramid));
  const GeoRaster read = read_geotiff(file);
  std::filesystem::remove(file);
  ASSERT_EQ(read.bands.size(), 2U);
  EXPECT_EQ(read.bands[0].name, "VV");
  EXPECT_EQ(read.bands[1].name, "HH");
  EXPECT_EQ(read.metadata.at("who"), "test");
  for (std::size_t i = 0; i < pyramid.levels[0].size(); ++i) {
    ASSERT_EQ(read.bands[i % 2].values.values()[i / 2], pyramid.levels[0][i] * 0x1p-5F) << i;
  }
}

TEST(HalfPyramid, EqualOnesGiveEqualBytes) {
  EXPECT_EQ(half_cog_bytes(example_pyramid()), half_cog_bytes(example_pyramid()));
}

TEST(HalfPyramid, OfAnotherShapeIsRefused) {
  HalfPyramid pyramid = example_pyramid();
  pyramid.levels.pop_back();
  EXPECT_THROW(static_cast<void>(half_cog_bytes(pyramid)), Error);
  pyramid = example_pyramid();
  pyramid.levels[1].pop_back();
  EXPECT_THROW(static_cast<void>(half_cog_bytes(pyramid)), Error);
}

}  // namespace
}  // namespace sigmascape::geo
