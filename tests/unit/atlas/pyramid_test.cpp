#include "sigmascape/atlas/pyramid.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

#include "example_texels.h"
#include "scratch_folder.h"

#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::atlas {
namespace {

/// Columns −3 … 2 and rows 0 … 2 of patches of 256 texels, one look.
AtlasDescription wide_description() {
  AtlasDescription description = example_description();
  description.patches = {1.0, 256};
  description.extent = {-3 * 256.0, 0.0, 3 * 256.0, 3 * 256.0};
  description.aspects = {{0.0}, {radians_from_deg(13.0)}, {10e9}};
  return description;
}

std::uint64_t seed_of(PatchIndex patch) {
  return static_cast<std::uint64_t>(100 * (patch.y + 10) + patch.x + 10);
}

Store filled(const std::filesystem::path& folder, const AtlasDescription& description = wide_description()) {
  Store store = Store::create(folder, description);
  for (const Unit& unit : store.units())
    store.write(unit.patch, unit.look, example_texels(256, seed_of(unit.patch)), {});
  return store;
}

void alter(const std::filesystem::path& path) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(-100, std::ios::end);
  const auto byte = static_cast<char>(~file.peek());
  file.seekp(-100, std::ios::end);
  file.put(byte);
}

TEST(Pyramid, OneInThePlaceOfAnotherIsFound) {
  const ScratchFolder folder;
  const Store store = Store::create(folder.path("a"), wide_description());
  for (const Unit& unit : store.units()) store.write(unit.patch, unit.look, example_texels(256, 1), {});
  const Pyramid pyramid(store);
  pyramid.make_above(store.units());
  ASSERT_TRUE(pyramid.verify().empty());
  const auto west = folder.path("a") / pyramid.texture_path({1, {-2, 0}}, 0);
  const auto east = folder.path("a") / pyramid.texture_path({1, {0, 0}}, 0);
  std::filesystem::copy_file(std::filesystem::path(west).replace_extension(".json"),
                             std::filesystem::path(east).replace_extension(".json"),
                             std::filesystem::copy_options::overwrite_existing);
  const auto faults = pyramid.verify(Scrutiny::Size);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front().what,
            "is of pyramid_1_patch_-002_+000_az000.0_el13.0_f10.000GHz and stands in the place of "
            "pyramid_1_patch_+000_+000_az000.0_el13.0_f10.000GHz");
}

TEST(Pyramid, GoesOnUntilTilesMeetAtTheOrigin) {
  const ScratchFolder folder;
  const auto levels_of = [&](const radar::Rectangle& extent) {
    AtlasDescription description = wide_description();
    description.extent = extent;
    static int serial = 0;
    return Pyramid(Store::create(folder.path(std::to_string(++serial)), description)).levels();
  };
  EXPECT_EQ(levels_of({10, 10, 20, 20}), 0U);
  EXPECT_EQ(levels_of({-10, -10, 20, 20}), 0U) << "four patches about the origin have no common file";
  EXPECT_EQ(levels_of({0, 0, 512, 10}), 1U);
  EXPECT_EQ(levels_of({256, 0, 768, 10}), 2U) << "columns 1 and 2 first share a file at level 2";
  EXPECT_EQ(levels_of({-3 * 256.0, 0, 3 * 256.0, 3 * 256.0}), 2U);
}

TEST(Pyramid, TilesAreAlignedToTheLattice) {
  const ScratchFolder folder;
  const Store store = Store::create(folder.path("a"), wide_description());
  const Pyramid pyramid(store);
  const std::vector<PyramidTile> first = pyramid.tiles(1);
  ASSERT_EQ(first.size(), 8U);
  EXPECT_EQ(first.front(), (PyramidTile{1, {-4, 2}}));
  EXPECT_EQ(first.back(), (PyramidTile{1, {2, 0}}));
  EXPECT_EQ(pyramid.tiles(2).size(), 2U);
  EXPECT_EQ(pyramid.tile_over({-1, 2}, 1), (PyramidTile{1, {-2, 2}}));
  EXPECT_EQ(pyramid.tile_over({-1, 2}, 2), (PyramidTile{2, {-4, 0}}));
  EXPECT_EQ(pyramid.texture_path({2, {-4, 0}}, 0), "pyramid_2/patch_-004_+000/az000.0_el13.0_f10.000GHz.tif");
}

// Power is kept: the mean over a tile is that of its patches, those the atlas does not have being black.
TEST(Pyramid, TexelsAreAreaMeansOfThePatchesInTheirPlace) {
  const ScratchFolder folder;
  const Store store = filled(folder.path("a"));
  const Pyramid pyramid(store);
  EXPECT_EQ(pyramid.make_above(store.units()), 8U + 2U);
  for (std::size_t level = 1; level <= 2; ++level) {
    const std::size_t block = std::size_t{1} << level;
    const radar::Channels texel = decoded(store.read_halves(level, {-3, 1}, 0)).front()(200, 100);
    const PyramidTile tile = pyramid.tile_over({-3, 1}, level);
    double expected = 0.0;
    for (std::size_t row = 100 * block; row < 101 * block; ++row) {
      for (std::size_t column = 200 * block; column < 201 * block; ++column) {
        const PatchIndex patch{tile.south_west.x + static_cast<int>(column / 256),
                               tile.south_west.y + static_cast<int>(block) - 1 - static_cast<int>(row / 256)};
        if (patch.x < -3 || patch.y > 2) continue;
        const auto texels = store.read(patch, 0).front();
        expected += static_cast<double>(texels(column % 256, row % 256).vv) / static_cast<double>(block * block);
      }
    }
    ASSERT_GT(expected, 0.0);
    EXPECT_NEAR(static_cast<double>(texel.vv) / expected, 1.0, static_cast<double>(level) * 0x1p-11);
  }
  // Column −4 is no patch of the atlas.
  EXPECT_EQ(decoded(store.read_halves(1, {-4, 0}, 0)).front()(127, 200).vv, 0.0F);
  EXPECT_GT(decoded(store.read_halves(1, {-4, 0}, 0)).front()(128, 200).vv, 0.0F);
}

TEST(Pyramid, OpensInPlaceInAGis) {
  const ScratchFolder folder;
  const Store store = filled(folder.path("a"));
  const Pyramid pyramid(store);
  pyramid.make_above(store.units());
  const geo::GeoRaster raster = geo::read_geotiff(store.folder() / pyramid.texture_path({2, {-4, 0}}, 0));
  EXPECT_DOUBLE_EQ(raster.placement.west_m, -1024.0);
  EXPECT_DOUBLE_EQ(raster.placement.north_m, 1024.0);
  EXPECT_DOUBLE_EQ(raster.placement.cell_m, 4.0);
  EXPECT_EQ(raster.bands[0].values(200, 100), decoded(store.read_halves(2, {-3, 1}, 0)).front()(200, 100).vv);
}

TEST(Pyramid, WhoeverMakesItMakesTheSameBytes) {
  const ScratchFolder folder;
  const Store whole = filled(folder.path("whole"));
  Pyramid(whole).make_above(whole.units());
  // The other is filled from its end, and each patch is followed by what became possible with it.
  const Store grown = Store::create(folder.path("grown"), wide_description());
  auto units = grown.units();
  std::ranges::reverse(units);
  std::size_t written = 0;
  for (const Unit& unit : units) {
    grown.write(unit.patch, unit.look, example_texels(256, seed_of(unit.patch)), {});
    written += Pyramid(grown).make_above({unit});
  }
  EXPECT_EQ(written, 10U);
  EXPECT_EQ(difference_of(files_of(folder.path("whole")), files_of(folder.path("grown"))), "");
}

TEST(Pyramid, WaitsForAllOfItsPatchesAndTrustsNoAlteredOne) {
  const ScratchFolder folder;
  const Store store = filled(folder.path("a"));
  const Pyramid pyramid(store);
  const auto texture = store.folder() / store.texture_path({0, 0}, 0);
  alter(texture);
  EXPECT_EQ(pyramid.make_above(store.units()), 7U + 1U);
  EXPECT_FALSE(pyramid.is_done({1, {0, 0}}, 0));
  EXPECT_FALSE(pyramid.is_done({2, {0, 0}}, 0));
  EXPECT_TRUE(pyramid.is_done({2, {-4, 0}}, 0));

  store.write({0, 0}, 0, example_texels(256, seed_of({0, 0})), {});
  EXPECT_EQ(pyramid.make_above({{{0, 0}, 0}}), 2U);
  EXPECT_TRUE(pyramid.verify().empty());
}

TEST(Pyramid, FaultsAreFoundNamedAndMended) {
  const ScratchFolder folder;
  const Store store = filled(folder.path("a"));
  const Pyramid pyramid(store);
  EXPECT_EQ(pyramid.verify().size(), 8U) << "what can be made and is not there";
  pyramid.make_above(store.units());
  const auto whole = files_of(store.folder());
  const auto altered = pyramid.texture_path({1, {0, 0}}, 0), truncated = pyramid.texture_path({1, {0, 2}}, 0),
             missing = pyramid.texture_path({2, {-4, 0}}, 0);
  alter(store.folder() / altered);
  std::filesystem::resize_file(store.folder() / truncated, 100);
  std::filesystem::remove(store.folder() / missing);
  std::map<std::filesystem::path, std::string> faults;
  for (const StoreFault& fault : pyramid.verify()) faults[fault.file] = fault.what;
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_THAT(faults[altered], ::testing::HasSubstr("SHA-256"));
  EXPECT_THAT(faults[truncated], ::testing::HasSubstr("is truncated: 100 of"));
  EXPECT_THAT(faults[missing], ::testing::HasSubstr("is missing"));
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(store.read_halves(2, {-1, 0}, 0));
              }),
              ::testing::HasSubstr("sigmascape atlas pyramid"));
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(store.read_halves(3, {-1, 0}, 0));
              }),
              ::testing::HasSubstr("has no level 3"));
  EXPECT_EQ(pyramid.make_above(store.units(), Scrutiny::Content), 3U);
  EXPECT_EQ(difference_of(files_of(store.folder()), whole), "");
}

// A patch that was baked anew with another result makes what was formed from it out of date.
TEST(Pyramid, FollowsItsPatches) {
  const ScratchFolder folder;
  const Store store = filled(folder.path("a"));
  const Pyramid pyramid(store);
  pyramid.make_above(store.units());
  store.write({0, 0}, 0, example_texels(256, 4711), {});
  const auto faults = pyramid.verify();
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults.front().file, pyramid.texture_path({1, {0, 0}}, 0));
  EXPECT_THAT(faults.front().what, ::testing::HasSubstr("made from other files"));
  EXPECT_EQ(pyramid.make_above({{{0, 0}, 0}}), 2U);
  EXPECT_TRUE(pyramid.verify().empty());
}

}  // namespace
}  // namespace sigmascape::atlas
