#include "sigmascape/atlas/store.h"

#include <barrier>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bytes_of.h"
#include "example_texels.h"
#include "scratch_folder.h"
#include "sealed_item.h"

#include "sigmascape/atlas/half.h"
#include "sigmascape/base/error.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::atlas {
namespace {

using testing::HasSubstr;

class StoreTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    written_ = std::make_unique<ScratchFolder>();
    static_cast<void>(written(written_->path("atlas")));
  }
  static void TearDownTestSuite() { written_.reset(); }

  static Store written(const std::filesystem::path& folder) {
    Store store = Store::create(folder, example_description());
    for (const Unit& unit : store.units()) {
      store.write(unit.patch, unit.look, example_texels(512, unit.look), {7, 64, "avx2", {{"rays_lost", 3}}});
    }
    return store;
  }
  /// A copy of one that was written for the whole suite.
  static Store filled(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    std::filesystem::copy(written_->path("atlas"), folder, std::filesystem::copy_options::recursive);
    return Store::open(folder);
  }

  inline static std::unique_ptr<ScratchFolder> written_;
  ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path("atlas");
};

TEST_F(StoreTest, NamesAreForPeople) {
  const Store store = Store::create(folder_, example_description());
  EXPECT_EQ(store.texture_path({0, -1}, 0), "patch_+000_-001/az000.0_el05.0_f10.000GHz.tif");
  EXPECT_EQ(store.texture_path({-12, 3}, 3), "patch_-012_+003/az135.0_el13.0_f10.000GHz.tif");
}

TEST_F(StoreTest, OpensAgainWithTheSameDescription) {
  static_cast<void>(Store::create(folder_, example_description()));
  ASSERT_TRUE(Store::find(folder_, example_description()));
  const Store store = Store::create(folder_, example_description());
  const Store opened = Store::open(folder_);
  EXPECT_EQ(opened.description().aspects, example_description().aspects);
  EXPECT_EQ(opened.description().patches, example_description().patches);
  EXPECT_EQ(opened.description().extent, example_description().extent);
  EXPECT_EQ(opened.description().settings, example_description().settings);
  EXPECT_EQ(opened.description().frame.proj(), example_description().frame.proj());
  EXPECT_EQ(opened.units().size(), 8U);
  EXPECT_EQ(opened.unit_count(), 8U);
  EXPECT_EQ(store.units(), opened.units());
}

TEST_F(StoreTest, IsFoundByARelativeNameWhereverTheProcessGoesAfterwards) {
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(written_->path(""));
  const Store store = Store::open("atlas");
  std::filesystem::current_path(here);
  EXPECT_TRUE(store.is_done(store.units().front().patch, 0));
  EXPECT_FALSE(store.read_halves(store.units().front().patch, 0).levels.empty());
}

TEST_F(StoreTest, RefusesAnotherDescriptionAndNamesWhatDiffers) {
  static_cast<void>(Store::create(folder_, example_description()));
  AtlasDescription other = example_description();
  other.settings["samples"] = "128";
  const std::string settings = message_of_error([&] { static_cast<void>(Store::create(folder_, other)); });
  EXPECT_THAT(settings, HasSubstr("collection.json"));
  EXPECT_THAT(settings, HasSubstr("settings.samples is \"64\" there and \"128\" here"));

  EXPECT_EQ(message_of_error([&] { static_cast<void>(Store::find(folder_, other)); }), settings);
  const auto nothing = folder_ / "nothing";
  EXPECT_FALSE(Store::find(nothing, other));
  EXPECT_FALSE(std::filesystem::exists(nothing)) << "looking for a store writes nothing";

  other = example_description();
  other.scene_hash = "ffff";
  EXPECT_THAT(
      message_of_error([&] { static_cast<void>(Store::create(folder_, other)); }),
      HasSubstr("holds another atlas: its scene is another one (terrain, objects or materials differ): scene_hash "
                "is \"0123abcd\" there and \"ffff\" here"));
  other = example_description();
  other.settings["bounces"] = "3";
  EXPECT_THAT(message_of_error([&] { static_cast<void>(Store::create(folder_, other)); }),
              HasSubstr("settings.bounces"));
  other.mantissa_bits = 9;
  other.attribution = "another";
  other.settings = {{"samples", "32"}, {"seed", "8"}};
  EXPECT_THAT(message_of_error([&] { static_cast<void>(Store::create(folder_, other)); }),
              HasSubstr("mantissa_bits is 10 there and 9 here, and 1 more; choose"));
  other = example_description();
  other.settings = {{"samples", "32"}, {"seed", "8"}};
  EXPECT_THAT(message_of_error([&] { static_cast<void>(Store::create(folder_, other)); }),
              HasSubstr("settings.samples is \"64\" there and \"32\" here, and settings.seed is \"7\" there and \"8\" "
                        "here; choose"));
}

TEST_F(StoreTest, OfTwoThatAreMadeAtOnceWithOtherSettingsOneIsRefused) {
  AtlasDescription other = example_description();
  other.settings["samples"] = "128";
  for (int attempt = 0; attempt < 20; ++attempt) {
    const auto folder = folder_ / std::to_string(attempt);
    std::barrier together(2);
    const auto made = [&](const AtlasDescription& description) {
      together.arrive_and_wait();
      return message_of_error([&] { static_cast<void>(Store::create(folder, description)); });
    };
    std::string first, second;
    {
      const std::jthread at_once([&] { first = made(example_description()); });
      second = made(other);
    }
    ASSERT_NE(first.empty(), second.empty()) << first << second;
    EXPECT_THAT(first.empty() ? second : first, HasSubstr("holds another atlas: settings.samples"));
    EXPECT_EQ(Store::open(folder).description().settings.at("samples"), first.empty() ? "64" : "128");
  }
}

TEST_F(StoreTest, OfManyThatAreMadeAtOnceAlikeNoneIsRefused) {
  std::barrier together(4);
  {
    std::vector<std::jthread> bakes;
    for (int bake = 0; bake < 4; ++bake) {
      bakes.emplace_back([&] {
        together.arrive_and_wait();
        EXPECT_NO_THROW(static_cast<void>(Store::create(folder_, example_description())));
      });
    }
  }
  EXPECT_TRUE(Store::find(folder_, example_description()));
}

// The elevation raster of the scene beside its file, say, where the atlas is to lie in the same folder.
TEST_F(StoreTest, FilesOfOthersByTheNamesOfAnAtlasAreRefusedAndLeftAsTheyAre) {
  for (const auto& [file, told] : {std::pair("terrain.tif", "terrain.tif"), std::pair("terrain.json", "terrain.json"),
                                   std::pair("terrain/level_0.tif", "terrain"), std::pair("terrain", "terrain"),
                                   std::pair("ground/soil.tif", "ground"), std::pair("ground", "ground"),
                                   std::pair("ground/collection.json", "ground")}) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << "{\"of\": \"others\"}";
    const std::string refused = folder_.string() + ": holds " + told +
                                ", which is of no atlas, and a bake would write over it; choose an empty folder";
    EXPECT_EQ(message_of_error([&] { static_cast<void>(Store::create(folder_, example_description())); }), refused);
    EXPECT_EQ(message_of_error([&] { static_cast<void>(Store::find(folder_, example_description())); }), refused);
    EXPECT_EQ(bytes_of(folder_ / file), "{\"of\": \"others\"}");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "collection.json"));
  }
}

TEST_F(StoreTest, OtherFilesMayLieWhereAnAtlasIsMade) {
  std::filesystem::create_directories(folder_ / "patches");
  for (const char* file :
       {"scene.toml", "houses.geojson", "terrain.csv", "patches/a.tif", ".collection.json.0-1-0.tmp"})
    std::ofstream(folder_ / file) << "of others";
  EXPECT_NO_THROW(static_cast<void>(Store::create(folder_, example_description())));
  EXPECT_EQ(bytes_of(folder_ / "scene.toml"), "of others");
}

// What the first of them writes is not taken for a file of others by the next.
TEST_F(StoreTest, OfManyThatBeginAtOnceAndGoOnAtOnceNoneIsRefused) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const auto folder = folder_ / std::to_string(attempt);
    std::barrier together(4);
    std::vector<std::jthread> bakes;
    for (int bake = 0; bake < 4; ++bake) {
      bakes.emplace_back([&] {
        together.arrive_and_wait();
        EXPECT_NO_THROW(static_cast<void>(Store::create(folder, example_description())));
        std::ofstream(folder / "terrain.tif") << "heights";
      });
    }
  }
}

TEST_F(StoreTest, RefusesDescriptionsThatMakeNoSense) {
  AtlasDescription description = example_description();
  description.aspects.azimuths_rad = {0.0, 1e-5};
  EXPECT_THAT(message_of_error([&] { static_cast<void>(Store::create(folder_, description)); }),
              HasSubstr("two are called"));
  description = example_description();
  description.extent.east_m = description.extent.west_m;
  EXPECT_THAT(message_of_error([&] { static_cast<void>(Store::create(folder_, description)); }), HasSubstr("no area"));
  description.extent.east_m = 1e12;
  EXPECT_THAT(message_of_error([&] { static_cast<void>(Store::create(folder_, description)); }), HasSubstr("too far"));
  description.extent = {-9e5, -9e5, 9e5, 9e5};
  description.patches = {1.0, 256};
  EXPECT_THAT(message_of_error([&] { static_cast<void>(Store::create(folder_, description)); }), HasSubstr("patches"));
  EXPECT_FALSE(std::filesystem::exists(folder_));
}

TEST_F(StoreTest, TextThatIsNotUtf8IsNoObstacle) {
  AtlasDescription description = example_description();
  description.attribution = "Diputaci\xf3n";
  static_cast<void>(Store::create(folder_, description));
  EXPECT_NO_THROW(static_cast<void>(Store::create(folder_, description)));
}

TEST_F(StoreTest, AFolderWithoutAtlasIsRefused) {
  EXPECT_THAT(message_of_error([&] { static_cast<void>(Store::open(folder_)); }), HasSubstr("collection.json"));
  std::filesystem::create_directories(folder_);
  std::ofstream(folder_ / "collection.json") << "{\"type\": \"Collection\"}";
  EXPECT_THAT(message_of_error([&] { static_cast<void>(Store::open(folder_)); }), HasSubstr("not the collection"));
}

TEST_F(StoreTest, ReadsBackWhatWasWrittenToTheNearestHalf) {
  const Store store = Store::create(folder_, example_description());
  const auto texels = example_texels(512, 5);
  EXPECT_FALSE(store.is_done({0, 0}, 1));
  store.write({0, 0}, 1, texels, {});
  EXPECT_TRUE(store.is_done({0, 0}, 1, Scrutiny::Content));
  EXPECT_FALSE(store.is_done({0, 0}, 0));
  const MipChain chain = store.read({0, 0}, 1);
  ASSERT_EQ(chain.size(), 2U);
  const MipChain expected = mip_chain(texels, 256);
  for (std::size_t level = 0; level < 2; ++level) {
    ASSERT_EQ(chain[level].size(), expected[level].size());
    for (std::size_t i = 0; i < chain[level].size(); ++i) {
      const radar::Channels wanted = expected[level].values()[i];
      const radar::Channels found = chain[level].values()[i];
      ASSERT_NEAR(found.vv, wanted.vv, wanted.vv * 0x1p-11F + 1e-8F) << level << " " << i;
      ASSERT_NEAR(found.hv, wanted.hv, wanted.hv * 0x1p-11F + 1e-5F) << level << " " << i;
      ASSERT_NEAR(found.re_vvhh, wanted.re_vvhh, std::abs(wanted.re_vvhh) * 0x1p-11F + 1e-5F) << level << " " << i;
    }
  }
}

TEST_F(StoreTest, ErrorsComeBackToATenthOfADecibelAndAreVouchedFor) {
  const Store store = Store::create(folder_, example_description());
  Array2D<float> errors(512, 512, 0.25F);
  errors(3, 200) = 0.01F;
  errors(200, 3) = 12.0F;
  store.write({0, 0}, 0, example_texels(512, 0), {}, errors);
  const Array2D<float> read = store.read_errors({0, 0}, 0);
  ASSERT_EQ(read.columns(), 512U);
  EXPECT_NEAR(read(100, 100), 0.25F, 0.25F * 0.024F);
  EXPECT_NEAR(read(3, 200), 0.01F, 0.01F * 0.024F);
  EXPECT_NEAR(read(200, 3), 12.0F, 12.0F * 0.024F);

  const auto file = folder_ / "patch_+000_+000/az000.0_el05.0_f10.000GHz_error.tif";
  std::string altered = bytes_of(file);
  altered.back() = static_cast<char>(altered.back() ^ 1);
  std::ofstream(file, std::ios::binary) << altered;
  EXPECT_TRUE(store.is_done({0, 0}, 0));
  EXPECT_FALSE(store.is_done({0, 0}, 0, Scrutiny::Content));
  std::filesystem::remove(file);
  EXPECT_FALSE(store.is_done({0, 0}, 0));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(store.read_errors({0, 0}, 0)); }), HasSubstr("is missing"));

  store.write({0, 0}, 1, example_texels(512, 1), {});
  EXPECT_THAT(message_of_error([&] { static_cast<void>(store.read_errors({0, 0}, 1)); }), HasSubstr("was not baked"));
  EXPECT_THAT(message_of_error([&] {
                store.write({0, 0}, 1, example_texels(512, 1), {}, Array2D<float>(3, 3));
              }),
              HasSubstr("one a texel"));
}

TEST_F(StoreTest, RowsRunSouthwardAndColumnsEastward) {
  const Store store = Store::create(folder_, example_description());
  Array2D<radar::Channels> texels(512, 512);
  texels(511, 0).hh = 2.0F;
  store.write({-1, 0}, 0, texels, {});
  const geo::GeoRaster raster = geo::read_geotiff(folder_ / store.texture_path({-1, 0}, 0));
  EXPECT_DOUBLE_EQ(raster.placement.west_m, -512.0);
  EXPECT_DOUBLE_EQ(raster.placement.north_m, 512.0);
  EXPECT_EQ(raster.bands[1].name, "HH");
  EXPECT_EQ(raster.bands[1].values(511, 0), 2.0F);
  EXPECT_EQ(store.read({-1, 0}, 0).front()(511, 0).hh, 2.0F);
}

TEST_F(StoreTest, PlainGdalSeesSigma0WithTheScaleOfTheBand) {
  const Store store = Store::create(folder_, example_description());
  store.write({0, 0}, 0, example_texels(512, 9), {});
  const auto expected = store.read({0, 0}, 0).front();
  const geo::GeoRaster raster = geo::read_geotiff(folder_ / store.texture_path({0, 0}, 0));
  ASSERT_EQ(raster.bands.size(), 4U);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(raster.bands[0].values.values()[i], expected.values()[i].vv) << i;
    ASSERT_EQ(raster.bands[3].values.values()[i], expected.values()[i].re_vvhh) << i;
  }
}

TEST_F(StoreTest, TheFileIsAValidCloudOptimisedGeoTiffWithOurOverviews) {
  if (std::system("/usr/bin/python3 -c 'import osgeo_utils.samples.validate_cloud_optimized_geotiff' 2>/dev/null") !=
      0) {
    GTEST_SKIP() << "/usr/bin/python3 has no osgeo_utils (package python3-gdal): the validator was NOT run";
  }
  const Store store = Store::create(folder_, example_description());
  store.write({0, 0}, 0, example_texels(512, 9), {});
  const std::string file = (folder_ / store.texture_path({0, 0}, 0)).string();
  const std::string validate =
      "/usr/bin/python3 -m osgeo_utils.samples.validate_cloud_optimized_geotiff --full-check=yes " + file + " >&2";
  EXPECT_EQ(std::system(validate.c_str()), 0);

  const float wanted = store.read({0, 0}, 0)[1](100, 50).vv;
  const std::string look = "/usr/bin/python3 -c \"from osgeo import gdal; d = gdal.Open('" + file +
                           "'); b = d.GetRasterBand(1); o = b.GetOverview(0); v = o.ReadRaster(100, 50, 1, 1, 1, 1, "
                           "gdal.GDT_Float32); import struct; x = struct.unpack('f', v)[0] * b.GetScale(); "
                           "assert b.GetOverviewCount() == 1 and x == " +
                           std::to_string(static_cast<double>(wanted) * 0x1p30) + " * 2.0**-30, (x, b.GetScale())\"";
  EXPECT_EQ(std::system(look.c_str()), 0);
}

TEST_F(StoreTest, EqualBakesGiveEqualBytes) {
  const Store one = written(folder_ / "one");
  const Store two = written(folder_ / "two");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "one")) {
    if (!entry.is_regular_file()) continue;
    const auto relative = std::filesystem::relative(entry.path(), folder_ / "one");
    EXPECT_EQ(bytes_of(entry.path()), bytes_of(folder_ / "two" / relative)) << relative;
    ++files;
  }
  EXPECT_EQ(files, 1U + 2U + 2U * one.units().size()) << "nothing but collection, catalogs, textures and items";
}

TEST_F(StoreTest, WhatIsWrongIsFoundAndNamed) {
  const Store store = filled(folder_);
  ASSERT_TRUE(store.verify().empty());

  const auto missing = store.texture_path({-1, 0}, 0);
  const auto truncated = store.texture_path({-1, 0}, 1);
  const auto altered = store.texture_path({0, 0}, 2);
  const auto without_item = store.texture_path({0, 0}, 3);
  auto item = without_item;
  item.replace_extension(".json");
  std::filesystem::remove(folder_ / missing);
  std::filesystem::resize_file(folder_ / truncated, std::filesystem::file_size(folder_ / truncated) - 1);
  {
    std::fstream file(folder_ / altered, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(-100, std::ios::end);
    const auto byte = static_cast<char>(~file.peek());
    file.seekp(-100, std::ios::end);
    file.put(byte);
  }
  std::filesystem::remove(folder_ / item);

  const auto faults = store.verify();
  ASSERT_EQ(faults.size(), 4U);
  EXPECT_EQ(faults[0].file, missing);
  EXPECT_THAT(faults[0].what, HasSubstr("missing"));
  EXPECT_EQ(faults[1].file, truncated);
  EXPECT_THAT(faults[1].what, HasSubstr("truncated"));
  EXPECT_EQ(faults[2].file, altered);
  EXPECT_THAT(faults[2].what, HasSubstr("altered"));
  EXPECT_EQ(faults[3].file, item);

  EXPECT_FALSE(store.is_done({-1, 0}, 0));
  EXPECT_FALSE(store.is_done({-1, 0}, 1));
  EXPECT_TRUE(store.is_done({0, 0}, 2, Scrutiny::Size));
  EXPECT_FALSE(store.is_done({0, 0}, 2, Scrutiny::Content));
  EXPECT_FALSE(store.is_done({0, 0}, 3));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(store.read({-1, 0}, 1)); }), HasSubstr(truncated.string()));
}

TEST_F(StoreTest, AnItemThatIsNoneDoesNotCount) {
  const Store store = Store::create(folder_, example_description());
  store.write({0, 0}, 0, example_texels(512, 1), {});
  auto item = folder_ / store.texture_path({0, 0}, 0);
  item.replace_extension(".json");
  for (const char* text :
       {"", "{", "[]", "{\"properties\": 3}", "{\"properties\": {\"sigmascape:size_bytes\": \"x\"}}"}) {
    std::ofstream(item) << text;
    EXPECT_FALSE(store.is_done({0, 0}, 0)) << text;
  }
}

/// With another number in an item, as an editor or a bad disk would leave it.
void alter_item(const std::filesystem::path& item, const std::string& from, const std::string& to) {
  std::string text = bytes_of(item);
  text.replace(text.find(from), from.size(), to);
  std::ofstream(item, std::ios::binary) << text;
}

/// Without one of the properties, that is not the first.
void erase_property(const std::filesystem::path& item, const std::string& name) {
  std::string text = bytes_of(item);
  const std::size_t found = text.find("\"sigmascape:" + name + "\"");
  const std::size_t comma_before = text.rfind(',', found);
  std::size_t end = text.find('\n', found);
  if (text[end - 1] == ',') --end;
  text.erase(comma_before, end - comma_before);
  std::ofstream(item, std::ios::binary) << text;
}

TEST_F(StoreTest, AnAlteredItemIsFoundNamedAndNotRead) {
  const Store store = Store::create(folder_, example_description());
  store.write({0, 0}, 0, example_texels(512, 1), {}, Array2D<float>(512, 512, 0.25F));
  const auto texture = store.texture_path({0, 0}, 0);
  const auto item = std::filesystem::path(texture).replace_extension(".json");
  const std::string whole = bytes_of(folder_ / item);
  const auto refused = [&] {
    EXPECT_FALSE(store.is_done({0, 0}, 0));
    const std::string message = message_of_error([&] { static_cast<void>(store.read({0, 0}, 0)); });
    EXPECT_THAT(message, HasSubstr((folder_ / item).string()));
    EXPECT_THAT(message, HasSubstr("--verify"));
    std::ofstream(folder_ / item, std::ios::binary) << whole;
    EXPECT_TRUE(store.is_done({0, 0}, 0, Scrutiny::Content));
    return message;
  };
  alter_item(folder_ / item, "\"sigmascape:scale\": ", "\"sigmascape:scale\": 1");
  EXPECT_THAT(refused(), HasSubstr("was altered: its own SHA-256 is not the recorded one"));
  erase_property(folder_ / item, "errors_sha256");
  EXPECT_THAT(refused(), HasSubstr("was altered: its own SHA-256 is not the recorded one"));
  alter_item(folder_ / item, "\"gsd\": 1.0", "\"gsd\": 2.0");
  EXPECT_THAT(refused(), HasSubstr("was altered: its own SHA-256 is not the recorded one"));
  erase_property(folder_ / item, "item_sha256");
  EXPECT_THAT(refused(), HasSubstr("was altered: it does not record its own SHA-256"));
}

TEST_F(StoreTest, AnItemOfAnotherBakeDoesNotCount) {
  const Store store = Store::create(folder_, example_description());
  store.write({0, 0}, 0, example_texels(512, 1), {});
  const auto item = (folder_ / store.texture_path({0, 0}, 0)).replace_extension(".json");
  rewrite_item(item, "\"samples\": \"64\"", "\"samples\": \"32\"");
  EXPECT_FALSE(store.is_done({0, 0}, 0));
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(store.read({0, 0}, 0));
              }),
              HasSubstr("is of another bake: samples is 32 there and 64 in the collection"));
  // What only one of the two knows is another setting as well.
  rewrite_item(item, "\"samples\": \"32\"", "\"samples\": \"64\", \"noise\": \"shared\"");
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(store.read({0, 0}, 0));
              }),
              HasSubstr("is of another bake: noise is shared there and not given in the collection"));
  rewrite_item(item, "\"samples\": \"64\", \"noise\"", "\"noise\"");
  EXPECT_FALSE(store.is_done({0, 0}, 0));
  rewrite_item(item, "\"noise\": \"shared\"", "\"samples\": \"64\"");
  EXPECT_TRUE(store.is_done({0, 0}, 0));
  rewrite_item(item, "\"sigmascape:scene_hash\": \"0123abcd\"", "\"sigmascape:scene_hash\": \"ffff\"");
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(store.read({0, 0}, 0));
              }),
              HasSubstr("is of another bake: scene_hash is ffff there and 0123abcd in the collection"));
  rewrite_item(item, "\"sigmascape:scene_hash\": \"ffff\"", "\"sigmascape:scene_hash\": \"0123abcd\"");
  for (const auto& [here, there, told] :
       {std::array{"\"sigmascape:mantissa_bits\": 10", "\"sigmascape:mantissa_bits\": 4",
                   "mantissa_bits is 4 there and 10"},
        std::array{"\"sigmascape:digits\": \"all\"", "\"sigmascape:digits\": \"to-noise\"",
                   "digits is to-noise there and all"}}) {
    rewrite_item(item, here, there);
    EXPECT_THAT(message_of_error([&] { static_cast<void>(store.read({0, 0}, 0)); }), HasSubstr(told));
    rewrite_item(item, there, here);
  }
  EXPECT_TRUE(store.is_done({0, 0}, 0));
}

// Those from before there were revisions tell none.
TEST_F(StoreTest, WhatTellsNoRevisionOfThePhysicsIsOfTheFirst) {
  EXPECT_EQ(filled(folder_).description().physics_revision(), "1");
  AtlasDescription later = example_description();
  later.settings[physics_revision_setting] = "1";
  EXPECT_EQ(Store::create(folder_, later).description().settings, example_description().settings)
      << "it goes on as it was begun";
  later.settings[physics_revision_setting] = "2";
  EXPECT_THAT(message_of_error([&] { static_cast<void>(Store::create(folder_, later)); }),
              HasSubstr("settings.physics_revision is \"1\" there and \"2\" here"));

  // A collection that was removed is written anew by whatever bake comes first.
  std::filesystem::remove(folder_ / "collection.json");
  const Store store = Store::create(folder_, later);
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(store.read({0, 0}, 0));
              }),
              HasSubstr("is of another bake: physics_revision is 1 there and 2 in the collection"));
  store.write({0, 0}, 0, example_texels(512, 1), {});
  EXPECT_TRUE(store.is_done({0, 0}, 0));
  std::filesystem::remove(folder_ / "collection.json");
  const Store first = Store::create(folder_, example_description());
  EXPECT_FALSE(first.is_done({0, 0}, 0));
  EXPECT_TRUE(first.is_done({0, 0}, 1));
}

/// A texture, its item and its standard errors in the place of another's, each as it was written.
void copy_look(const Store& store, const std::filesystem::path& from, const std::filesystem::path& to) {
  for (const char* ending : {".tif", ".json"}) {
    std::filesystem::copy_file((store.folder() / from).replace_extension(ending),
                               (store.folder() / to).replace_extension(ending),
                               std::filesystem::copy_options::overwrite_existing);
  }
}

TEST_F(StoreTest, ALookInThePlaceOfAnotherIsFoundNamedAndNotRead) {
  const Store store = filled(folder_);
  const auto told_of = [&](PatchIndex patch, LookIndex look, const std::filesystem::path& from) {
    const auto there = store.texture_path(patch, look);
    copy_look(store, from, there);
    EXPECT_FALSE(store.is_done(patch, look));
    const auto faults = store.verify();
    if (faults.size() != 1) return std::string("not one fault");
    EXPECT_EQ(faults.front().file, std::filesystem::path(there).replace_extension(".json"));
    EXPECT_THAT(message_of_error([&] { static_cast<void>(store.read(patch, look)); }), HasSubstr(faults.front().what));
    store.write(patch, look, example_texels(512, look), {});
    return faults.front().what;
  };
  EXPECT_EQ(told_of({0, 0}, 1, store.texture_path({0, 0}, 0)),
            "is of patch_+000_+000_az000.0_el05.0_f10.000GHz and stands in the place of "
            "patch_+000_+000_az135.0_el05.0_f10.000GHz");
  EXPECT_EQ(told_of({0, 0}, 2, store.texture_path({-1, 0}, 2)),
            "is of patch_-001_+000_az000.0_el13.0_f10.000GHz and stands in the place of "
            "patch_+000_+000_az000.0_el13.0_f10.000GHz");
  EXPECT_TRUE(store.verify().empty());
}

// Names of files are rounded, and do not tell how large texels are.
TEST_F(StoreTest, ALookOfTheSameNameFromAnotherAtlasDoesNotCount) {
  const Store store = filled(folder_ / "here");
  const auto told_of = [&](const AtlasDescription& other) {
    const auto folder = folder_ / std::to_string(other.patches.texel_m + other.aspects.azimuths_rad[1]);
    const Store there = Store::create(folder, other);
    there.write({0, 0}, 1, example_texels(other.patches.texels_per_side, 1), {});
    for (const char* ending : {".tif", ".json"}) {
      std::filesystem::copy_file((folder / there.texture_path({0, 0}, 1)).replace_extension(ending),
                                 (store.folder() / store.texture_path({0, 0}, 1)).replace_extension(ending),
                                 std::filesystem::copy_options::overwrite_existing);
    }
    return message_of_error([&] { static_cast<void>(store.read({0, 0}, 1)); });
  };
  AtlasDescription other = example_description();
  other.aspects.azimuths_rad[1] = radians_from_deg(135.04);
  EXPECT_THAT(told_of(other),
              HasSubstr("is of another bake: azimuth_deg is 135.04 there, which the collection does not have"));
  other = example_description();
  other.patches = {2.0, 256};
  EXPECT_THAT(told_of(other), HasSubstr("is of another bake: gsd is 2 there and 1 in the collection"));
  other.patches = {1.0, 1024};
  EXPECT_THAT(told_of(other),
              HasSubstr("is of another bake: proj:shape is [1024,1024] there and [512,512] in the collection"));
}

TEST_F(StoreTest, AnAlteredCollectionIsNamedWithWhatMendsIt) {
  static_cast<void>(filled(folder_));
  const auto file = folder_ / "collection.json";
  const std::string whole = bytes_of(file);
  for (const auto& [from, to] :
       {std::pair("\"attribution\": \"made up\"", "\"attribution\": \"made down\""),
        std::pair("\"id\": \"example\"", "\"id\": \"sample\""),
        std::pair("\"mantissa_bits\": 10", "\"mantissa_bits\": 5"), std::pair("-512.0", "-511.0"),
        std::pair("\"scene_hash\": \"0123abcd\"", "\"scene_hash\": \"ffff\"")}) {
    alter_item(file, from, to);
    EXPECT_EQ(
        message_of_error([&] { static_cast<void>(Store::open(folder_)); }),
        file.string() +
            ": was altered: its own SHA-256 is not the recorded one; remove this one file and bake again with the "
            "same settings, which writes it anew and keeps what is baked")
        << to;
    std::ofstream(file, std::ios::binary) << whole;
  }
  std::filesystem::remove(file);
  EXPECT_TRUE(Store::create(folder_, example_description()).verify().empty());
  EXPECT_EQ(bytes_of(file), whole);
}

// What cannot be read is not taken for missing, and is named.
TEST_F(StoreTest, AFolderInThePlaceOfAFileIsNamed) {
  const Store store = filled(folder_);
  const auto put_folder = [&](const std::filesystem::path& file) {
    std::filesystem::remove(folder_ / file);
    std::filesystem::create_directory(folder_ / file);
    return file;
  };
  const auto item = put_folder(store.texture_path({0, 0}, 0).replace_extension(".json"));
  const auto texture = put_folder(store.texture_path({0, 0}, 1));
  const auto faults = store.verify();
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].file, item);
  EXPECT_EQ(faults[0].what, "cannot be read (Is a directory)");
  EXPECT_EQ(faults[1].file, texture);
  EXPECT_EQ(faults[1].what, "cannot be read (Is a directory)");
  const auto collection = folder_ / put_folder("collection.json");
  const std::string told =
      collection.string() +
      ": cannot be read (Is a directory); make it a file that may be read, or choose another folder";
  EXPECT_EQ(message_of_error([&] { static_cast<void>(Store::open(folder_)); }), told);
  EXPECT_EQ(message_of_error([&] { static_cast<void>(Store::create(folder_, example_description())); }), told);
}

// Items of format 1 neither vouch for themselves nor tell more of the settings than seed and instruction set.
TEST_F(StoreTest, AtlasesOfTheFormerFormatAreReadAndGoOn) {
  AtlasDescription former = example_description();
  former.format_version = 1;
  const Store store = Store::create(folder_, former);
  store.write({0, 0}, 0, example_texels(512, 1), {7, 64, "avx2", {}});
  const auto item = (folder_ / store.texture_path({0, 0}, 0)).replace_extension(".json");
  std::string text = bytes_of(item);
  const std::size_t settings = text.find("\"sigmascape:settings\"");
  text.erase(settings, text.find("\"sigmascape:seed\"") - settings);
  std::ofstream(item, std::ios::binary) << text;
  erase_property(item, "item_sha256");

  const Store opened = Store::create(folder_, example_description());
  EXPECT_EQ(opened.description().format_version, 1);
  EXPECT_TRUE(opened.is_done({0, 0}, 0, Scrutiny::Content));
  EXPECT_NO_THROW(static_cast<void>(opened.read({0, 0}, 0)));
  opened.write({0, 0}, 1, example_texels(512, 1), {7, 64, "avx2", {}});
  alter_item((folder_ / store.texture_path({0, 0}, 1)).replace_extension(".json"), "\"gsd\": 1.0", "\"gsd\": 2.0");
  EXPECT_FALSE(opened.is_done({0, 0}, 1)) << "what was written since vouches for itself";
  alter_item(item, "\"sigmascape:seed\": 7", "\"sigmascape:seed\": 8");
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(opened.read({0, 0}, 0));
              }),
              HasSubstr("is of another bake: seed is 8 there and 7 in the collection"));
}

TEST_F(StoreTest, ADamagedCollectionIsToldWithWhatMendsIt) {
  static_cast<void>(filled(folder_));
  const auto file = folder_ / "collection.json";
  const std::string whole = bytes_of(file);
  std::string without_texel = whole;
  without_texel.replace(without_texel.find("\"texel_m\""), 9, "\"texel_n\"");
  for (const std::string& damaged :
       {std::string(), whole.substr(0, whole.size() / 2), std::string("[]"), without_texel}) {
    std::ofstream(file, std::ios::binary) << damaged;
    const auto open = [&] { static_cast<void>(Store::open(folder_)); };
    const auto create = [&] { static_cast<void>(Store::create(folder_, example_description())); };
    EXPECT_EQ(message_of_error(open),
              file.string() +
                  ": is truncated or was altered, and does not tell what this atlas is of; remove this one "
                  "file and bake again with the same settings, which writes it anew and keeps what is baked");
    EXPECT_EQ(message_of_error(create), message_of_error(open));
  }
  std::filesystem::remove(file);
  const Store store = Store::create(folder_, example_description());
  EXPECT_EQ(bytes_of(file), whole);
  EXPECT_TRUE(store.verify().empty());
}

TEST_F(StoreTest, TexelsThatDoNotFitOrAreNotFiniteAreRefused) {
  const Store store = Store::create(folder_, example_description());
  EXPECT_THAT(message_of_error([&] { store.write({0, 0}, 0, example_texels(256, 1), {}); }), HasSubstr("512 x 512"));
  auto texels = example_texels(512, 1);
  texels(3, 17).hv = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(message_of_error([&] { store.write({0, 0}, 0, texels, {}); }), HasSubstr("column 3, row 17"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / store.texture_path({0, 0}, 0)));
}

TEST_F(StoreTest, ItemsCarryNoClockButTheFactsOfTheBake) {
  const Store store = filled(folder_);
  auto item = folder_ / store.texture_path({0, 0}, 2);
  item.replace_extension(".json");
  const std::string text = bytes_of(item);
  EXPECT_THAT(text, HasSubstr("\"datetime\": null"));
  EXPECT_THAT(text, HasSubstr("\"start_datetime\": \"1970-01-01T00:00:00Z\""));
  EXPECT_THAT(text, HasSubstr("\"sigmascape:seed\": 7"));
  EXPECT_THAT(text, HasSubstr("\"sigmascape:simd\": \"avx2\""));
  EXPECT_THAT(text, HasSubstr("\"rays_lost\": 3"));
  EXPECT_THAT(text, HasSubstr("\"sar:frequency_band\": \"X\""));
  EXPECT_THAT(text, HasSubstr("\"sigmascape:elevation_deg\": 13.0"));
  EXPECT_THAT(text, HasSubstr("\"view:incidence_angle\": 77.0"));
  EXPECT_THAT(text, HasSubstr("\"view:azimuth\": 180.0"));
}

TEST_F(StoreTest, FewerMantissaBitsMakeSmallerFiles) {
  const Store fine = Store::create(folder_ / "fine", example_description());
  AtlasDescription description = example_description();
  description.mantissa_bits = 5;
  const Store coarse = Store::create(folder_ / "coarse", description);
  fine.write({0, 0}, 0, example_texels(512, 1), {});
  coarse.write({0, 0}, 0, example_texels(512, 1), {});
  const auto path = fine.texture_path({0, 0}, 0);
  EXPECT_LT(std::filesystem::file_size(folder_ / "coarse" / path),
            std::filesystem::file_size(folder_ / "fine" / path) * 7 / 10);
}

TEST_F(StoreTest, DigitsThatNoiseDrownsAreNotStored) {
  const Store whole = Store::create(folder_ / "whole", example_description());
  AtlasDescription description = example_description();
  description.digits = Digits::ToNoise;
  const Store rounded = Store::create(folder_ / "rounded", description);
  EXPECT_EQ(Store::open(folder_ / "rounded").description().digits, Digits::ToNoise);
  const Array2D<radar::Channels> texels = example_texels(512, 1);
  constexpr float error = 0.2F;
  for (const Store* store : {&whole, &rounded}) store->write({0, 0}, 0, texels, {}, Array2D<float>(512, 512, error));
  const auto path = whole.texture_path({0, 0}, 0);
  EXPECT_LT(std::filesystem::file_size(folder_ / "rounded" / path),
            std::filesystem::file_size(folder_ / "whole" / path) * 8 / 10);
  const MipChain levels = rounded.read({0, 0}, 0);
  const auto darkest = static_cast<float>(fitting_scale(texels) * 0x1p-14);  // that halves have all their bits of
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const float vv = texels.values()[i].vv;
    ASSERT_NEAR(levels.front().values()[i].vv, vv, std::max(vv, darkest) * error / 8.0F);
  }
}

// Who has no errors to go by rounds nothing.
TEST_F(StoreTest, WithoutErrorsAllDigitsAreStored) {
  const Store whole = Store::create(folder_ / "whole", example_description());
  AtlasDescription description = example_description();
  description.digits = Digits::ToNoise;
  const Store rounded = Store::create(folder_ / "rounded", description);
  for (const Store* store : {&whole, &rounded}) store->write({0, 0}, 0, example_texels(512, 1), {});
  const auto path = whole.texture_path({0, 0}, 0);
  EXPECT_EQ(bytes_of(folder_ / "rounded" / path), bytes_of(folder_ / "whole" / path));
}

}  // namespace
}  // namespace sigmascape::atlas
