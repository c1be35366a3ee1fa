#include "sigmascape/atlas/atlas_summary.h"

#include <filesystem>
#include <gtest/gtest.h>

#include "example_obstacles.h"
#include "example_texels.h"
#include "scratch_folder.h"

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/levels_above.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::atlas {
namespace {

/// Four patches and one place above them, one look, a ground of two.
Store whole_atlas(const std::filesystem::path& folder) {
  const Store atlas = Store::create(folder, small_ground_apart());
  const Store ground = create_ground_store(atlas, {radians_from_deg(13.0), radians_from_deg(40.0)});
  for (const Unit& unit : atlas.units()) atlas.write(unit.patch, unit.look, example_texels(256, 1), {});
  write_all_obstacles(atlas);
  for (const Unit& unit : ground.units()) ground.write(unit.patch, unit.look, example_texels(256, 2), {});
  geo::write_geotiff(folder / terrain_name, {.placement = {0.0, 0.0, 8.0, atlas.description().frame.proj()},
                                             .bands = {{"height_m", Array2D<float>(8, 8, 5.0F)}},
                                             .nodata = {},
                                             .metadata = {}});
  vouch_for_terrain(atlas);
  return atlas;
}

void expect_files(const AtlasSummary::Files& files, std::size_t done, std::size_t planned) {
  EXPECT_EQ(files.done, done);
  EXPECT_EQ(files.planned, planned);
}

TEST(AtlasSummary, CountsEachKindOfFilesByItself) {
  const ScratchFolder folder;
  const Store atlas = whole_atlas(folder.path("a"));
  const LevelsAbove::Written written = make_levels_above(atlas).written;
  AtlasSummary summary = summary_of(atlas);
  expect_files(summary.pyramid, written.looks, 1);
  expect_files(summary.obstacles.value(), 4 + written.obstacles, 4 + 1);
  expect_files(summary.ground.value().textures, 2 * 4 + written.ground, 2 * (4 + 1));
  EXPECT_FALSE(summary.ground->fault || summary.terrain_fault);
  EXPECT_FALSE(summary_of(open_ground_store(atlas)).terrain_fault) << "it has none of its own";

  std::filesystem::remove(atlas.folder() / obstacles_path({0, {0, 0}}));
  std::filesystem::remove_all(ground_folder_of(atlas) / "patch_+000_+000");
  std::filesystem::remove(atlas.folder() / terrain_name);
  summary = summary_of(atlas);
  EXPECT_EQ(summary.looks_done, 4U);
  expect_files(summary.pyramid, 1, 1);
  expect_files(summary.obstacles.value(), 4, 4 + 1);
  // What was made from files whose items are gone is out of date.
  expect_files(summary.ground.value().textures, 2 * 3, 2 * (4 + 1));
  ASSERT_TRUE(summary.terrain_fault);
  EXPECT_EQ(summary.terrain_fault->file, terrain_name);

  std::filesystem::remove_all(ground_folder_of(atlas));
  summary = summary_of(atlas);
  expect_files(summary.ground.value().textures, 0, 0);
  ASSERT_TRUE(summary.ground->fault);
  EXPECT_EQ(summary.ground->fault->file, "ground/collection.json");
}

TEST(AtlasSummary, OfAnAtlasThatHoldsEverythingNoGroundIsPlanned) {
  const ScratchFolder folder;
  AtlasDescription description = small_ground_apart();
  description.settings.clear();
  const AtlasSummary summary = summary_of(Store::create(folder.path("a"), description));
  expect_files(summary.pyramid, 0, 1);
  EXPECT_FALSE(summary.obstacles || summary.ground || summary.buildings);
}

// Items of earlier programs do not tell.
TEST(AtlasSummary, SaysOfHowManyLooksTheErrorIsTold) {
  const ScratchFolder folder;
  const Store store = Store::create(folder.path("atlas"), example_description());
  const PowerError error{.power = 2.0, .standard_error = 0.5};
  store.write({0, 0}, 0, example_texels(512, 1), {.samples_per_texel = 8.0, .simd = "avx2", .counts = {}});
  store.write({0, 0}, 1, example_texels(512, 2),
              {.samples_per_texel = 8.0, .simd = "avx2", .counts = {}, .error = error});
  const AtlasSummary summary = summary_of(store);
  EXPECT_EQ(summary.looks_done, 2U);
  EXPECT_EQ(summary.looks_told, 1U);
  EXPECT_EQ(summary.errors.relative(), 0.25);
}

}  // namespace
}  // namespace sigmascape::atlas
