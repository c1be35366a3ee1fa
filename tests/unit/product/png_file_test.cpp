#include "sigmascape/product/png_file.h"

#include <cstdlib>
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <png.h>
#include <sstream>
#include <vector>

#include "bytes_of.h"
#include "full_disk.h"
#include "scratch_folder.h"
#include "unit/product/made_up_map.h"

#include "sigmascape/base/error.h"

namespace sigmascape::product {
namespace {

/// The pixels of a PNG file as libpng's own simplified reader sees them, always RGBA.
Array2D<Rgba> pixels_of(const std::filesystem::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) {
    ADD_FAILURE() << image.message;
    return {};
  }
  image.format = PNG_FORMAT_RGBA;
  std::vector<png_byte> samples(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, samples.data(), 0, nullptr), 0) << image.message;
  Array2D<Rgba> pixels(image.width, image.height);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels.values()[i] = {samples[4 * i], samples[4 * i + 1], samples[4 * i + 2], samples[4 * i + 3]};
  }
  return pixels;
}

std::map<std::string, std::string> texts_of(const std::filesystem::path& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_textp chunks = nullptr;
  int count = 0;
  png_get_text(png, info, &chunks, &count);
  std::map<std::string, std::string> texts;
  for (int i = 0; i < count; ++i) texts[chunks[i].key] = chunks[i].text;
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(file);
  return texts;
}

Picture small_picture() {
  radar::GroundMap map = map_of(5, 3, [](auto c, auto r) { return static_cast<double>(1 + c + 5 * r); });
  map.crs = "EPSG:25830";
  map.sigma0(1, 1).vv = unseen_power;
  return picture_of(map, {.scale = ColourScale::Scope});
}

TEST(PngFile, PixelsReadBackAreThoseWritten) {
  const Picture picture = small_picture();
  const ScratchFolder folder;
  const auto path = folder.path("map.png");
  write_png(path, picture);
  const Array2D<Rgba> read = pixels_of(path);
  ASSERT_EQ(read.columns(), 5U);
  ASSERT_EQ(read.rows(), 3U);
  for (std::size_t i = 0; i < read.size(); ++i) EXPECT_EQ(read.values()[i], picture.pixels.values()[i]);
}

TEST(PngFile, AFullDiskLeavesNoWorldFileWithoutPicture) {
  const ScratchFolder folder;
  Picture picture = small_picture();
  picture.metadata["noise"] = std::string(9000, 'x');
  {
    const FullDisk full(4096);
    EXPECT_THAT(message_of_error([&] { write_png(folder.path("map.png"), picture); }),
                ::testing::HasSubstr("map.png: cannot be written"));
  }
  EXPECT_EQ(difference_of(files_of(folder.path("")), {}), "");
}

TEST(PngFile, TransparencyIsKept) {
  Picture picture = small_picture();
  picture.pixels(2, 2).alpha = 0;
  const ScratchFolder folder;
  const auto path = folder.path("map.png");
  write_png(path, picture);
  EXPECT_EQ(pixels_of(path)(2, 2).alpha, 0);
  EXPECT_EQ(pixels_of(path)(2, 1).alpha, 255);
}

TEST(PngFile, MetadataTravelsAsText) {
  Picture picture = small_picture();
  picture.metadata["attribution"] = "© Gobierno de España, 2026";
  const ScratchFolder folder;
  const auto path = folder.path("map.png");
  write_png(path, picture);
  const auto texts = texts_of(path);
  EXPECT_EQ(texts.at("attribution"), "© Gobierno de España, 2026");
  EXPECT_EQ(texts.at("crs"), "EPSG:25830");
  EXPECT_EQ(texts.at("quantity"), "sigma0 VV+HH+2HV [dB]");
}

TEST(PngFile, WorldFileNamesTheCentreOfTheUpperLeftPixel) {
  const ScratchFolder folder;
  const auto path = folder.path("map.png");
  write_png(path, small_picture());
  std::istringstream lines(bytes_of(std::filesystem::path(path).replace_extension(".pgw")));
  std::vector<double> numbers;
  for (double number = 0.0; lines >> number;) numbers.push_back(number);
  EXPECT_THAT(numbers, testing::ElementsAre(2.0, 0.0, 0.0, -2.0, 101.0, 199.0));
}

TEST(PngFile, ThroughALinkTheWorldFileLiesBesideThePicture) {
  const ScratchFolder folder;
  std::filesystem::create_symlink("maps/today.png", folder.path("latest.png"));
  write_png(folder.path("latest.png"), small_picture());
  EXPECT_TRUE(std::filesystem::exists(folder.path("maps/today.png")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("maps/today.pgw")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("latest.pgw")));
}

TEST(PngFile, EqualPicturesGiveEqualBytes) {
  EXPECT_EQ(png_bytes(small_picture()), png_bytes(small_picture()));
}

TEST(PngFile, WhatCannotBeWrittenIsAnErrorAndLeavesNothing) {
  EXPECT_THROW((void)png_bytes(Picture{}), Error);
  Picture picture = small_picture();
  picture.metadata[std::string(80, 'k')] = "too long a key";
  const ScratchFolder folder;
  EXPECT_THROW(write_png(folder.path("map.png"), picture), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
  EXPECT_THROW(write_png("/proc/no/such/place/map.png", small_picture()), Error);
}

}  // namespace
}  // namespace sigmascape::product
