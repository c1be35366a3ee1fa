#include "sigmascape/atlas/verify.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "example_texels.h"
#include "scratch_folder.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/catalogs.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::atlas {
namespace {

namespace fs = std::filesystem;

/// An atlas of two patches that keeps its ground apart, whole.
class VerifyTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    written_ = std::make_unique<ScratchFolder>();
    AtlasDescription description = example_description();
    description.settings[shadows_setting] = shadows_at_run_time;
    const Store atlas = Store::create(written_->path("atlas"), description);
    fill(atlas);
    fill(create_ground_store(atlas, {0.1, 0.5}));
    for (const PatchIndex& patch : description.patches.covering(description.extent)) {
      const radar::GroundGrid texels = description.patches.texels_of(patch);
      write_obstacles(atlas, patch, {texels, Array2D<radar::Obstacle>(texels.columns, texels.rows)});
    }
    write_heights(atlas.folder(), description.frame);
    vouch_for_terrain(atlas);
  }
  static void TearDownTestSuite() { written_.reset(); }
  VerifyTest() { fs::copy(written_->path("atlas"), folder_, fs::copy_options::recursive); }

  /// So many and so different that a byte in the middle of the file is of one of them.
  static void write_heights(const fs::path& atlas, const geo::LocalFrame& frame) {
    Array2D<float> heights(100, 100);
    for (std::size_t i = 0; i < heights.size(); ++i) heights.values()[i] = static_cast<float>(i * i % 997);
    geo::write_geotiff(atlas / terrain_name, {.placement = {-500.0, 500.0, 10.0, frame.proj()},
                                              .bands = {{"HEIGHT_M", heights}},
                                              .nodata = {},
                                              .metadata = {}});
  }

  static void fill(const Store& store) {
    for (const Unit& unit : store.units()) store.write(unit.patch, unit.look, example_texels(512, unit.look), {});
    Pyramid(store).make_above(store.units());
  }

  /// The one fault that there is, "file what".
  [[nodiscard]] std::string fault(Scrutiny scrutiny = Scrutiny::Content) const {
    const auto faults = verify(Store::open(folder_), scrutiny);
    if (faults.empty()) return "none";
    return faults.size() == 1 ? faults.front().file.string() + " " + faults.front().what
                              : fmt::format("{} faults", faults.size());
  }

  /// A byte in the middle becomes another one; the length stays.
  void alter(const fs::path& file) const {
    std::fstream stream(folder_ / file, std::ios::in | std::ios::out | std::ios::binary);
    const auto middle = static_cast<std::streamoff>(fs::file_size(folder_ / file) / 2);
    stream.seekg(middle);
    const int byte = stream.get();
    stream.seekp(middle);
    stream.put(static_cast<char>(byte ^ 1));
  }

  inline static std::unique_ptr<ScratchFolder> written_;  ///< for each test to copy
  ScratchFolder scratch_;
  fs::path folder_ = scratch_.path("atlas");
};

TEST_F(VerifyTest, WholeAtlasHasNoFault) {
  EXPECT_EQ(fault(), "none");
}

TEST_F(VerifyTest, FindsWhatIsWrongWithTheTerrain) {
  const Store atlas = Store::open(folder_);
  EXPECT_EQ(vouched_terrain(atlas, Scrutiny::Content), folder_ / terrain_name);
  alter(terrain_name);
  EXPECT_EQ(fault(), "terrain.tif was altered: its SHA-256 is not the recorded one");
  EXPECT_EQ(fault(Scrutiny::Size), "none");
  EXPECT_THROW((void)vouched_terrain(atlas, Scrutiny::Content), Error);
  fs::remove(folder_ / "terrain.json");
  EXPECT_EQ(fault(Scrutiny::Size),
            "terrain.json is missing, so the file that it vouches for does not count: unfinished, or it was removed");
  vouch_for_terrain(atlas);
  EXPECT_EQ(fault(), "none");
}

TEST_F(VerifyTest, FindsWhatIsWrongWithTheGround) {
  const fs::path texture = fs::path("ground") / "patch_+000_+000" / "az000.0_el05.7_f10.000GHz.tif";
  ASSERT_TRUE(fs::exists(folder_ / texture));
  alter(texture);
  EXPECT_EQ(fault(), texture.string() + " was altered: its SHA-256 is not the recorded one");
  alter(texture);

  // What the ground's store is of follows from the atlas.
  const fs::path collection = folder_ / "ground/collection.json";
  const auto whole_size = fs::file_size(collection);
  fs::copy_file(folder_ / collection_name, collection, fs::copy_options::overwrite_existing);
  EXPECT_EQ(fault(), "ground/collection.json was altered: it does not say what follows from the atlas");
  fs::resize_file(collection, 100);
  EXPECT_EQ(fault(), "ground/collection.json is truncated or was altered");
  std::vector<StoreFault> mended;
  static_cast<void>(create_ground_store(Store::open(folder_), {0.1, 0.5}, &mended));
  ASSERT_EQ(mended.size(), 1U);
  EXPECT_EQ(mended.front().file, "ground/collection.json");
  EXPECT_EQ(fs::file_size(collection), whole_size);
  EXPECT_EQ(fault(), "none");
  fs::remove_all(folder_ / "ground");
  EXPECT_EQ(fault(), "ground/collection.json is missing");
}

TEST_F(VerifyTest, FindsWhatIsWrongWithObstacles) {
  const fs::path obstacles = fs::path("patch_-001_+000") / "obstacles.tif";
  alter(obstacles);
  EXPECT_EQ(fault(), obstacles.string() + " was altered: its SHA-256 is not the recorded one");
  EXPECT_EQ(fault(Scrutiny::Size), "none");
  fs::remove(folder_ / obstacles);
  EXPECT_EQ(fault(), obstacles.string() + " is missing, though its item is there");
  fs::remove((folder_ / obstacles).replace_extension(".json"));
  EXPECT_EQ(fault(), obstacles.string() + " is missing");
}

TEST_F(VerifyTest, FindsObstaclesInThePlaceOfOthers) {
  for (const char* file : {"obstacles.tif", "obstacles.json"}) {
    fs::copy_file(folder_ / "patch_-001_+000" / file, folder_ / "patch_+000_+000" / file,
                  fs::copy_options::overwrite_existing);
  }
  EXPECT_EQ(fault(Scrutiny::Size),
            "patch_+000_+000/obstacles.json is of patch_-001_+000_obstacles and stands in the place of "
            "patch_+000_+000_obstacles");
}

// Those of atlases from before say nothing of themselves, and stay as they are.
TEST_F(VerifyTest, CollectionsThatDoNotVouchForThemselvesAreWhole) {
  for (const fs::path& folder : {folder_, folder_ / "ground"}) {
    const std::string former = former_collection_texts(Store::open(folder).description()).back();
    EXPECT_EQ(former.find(collection_hash), std::string::npos);
    std::ofstream(folder / collection_name, std::ios::binary) << former;
  }
  const auto before = files_of(folder_);
  EXPECT_EQ(fault(), "none");
  EXPECT_TRUE(mend_catalogs(Store::open(folder_), Scrutiny::Content).empty());
  EXPECT_EQ(difference_of(files_of(folder_), before), "");
  std::ofstream(folder_ / collection_name, std::ios::app) << "\n";
  EXPECT_THAT(fault(), testing::StartsWith("collection.json does not link"));
}

// As when its collection was lost and a bake of a later revision began in its folder.
TEST_F(VerifyTest, GroundAndObstaclesOfOtherPhysicsDoNotCount) {
  AtlasDescription later = Store::open(folder_).description();
  later.settings[physics_revision_setting] = "2";
  fs::remove(folder_ / collection_name);
  const Store atlas = Store::create(folder_, later);
  constexpr const char* of_another = "is of another bake: physics_revision is 1 there and 2 in the collection";
  const auto obstacles = obstacles_fault(atlas, {0, 0}, Scrutiny::Size);
  ASSERT_TRUE(obstacles);
  EXPECT_EQ(obstacles->what, of_another);
  EXPECT_TRUE(ground_collection_fault(atlas));
  const Store ground = create_ground_store(atlas, {0.1, 0.5});
  const auto texture = texture_fault(ground, ground.texture_path({0, 0}, 0), Scrutiny::Size);
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->what, of_another);
}

/// What load_atlas says of it.
std::string loaded(const fs::path& folder) {
  try {
    static_cast<void>(load_atlas(Store::open(folder)));
    return "none";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST_F(VerifyTest, WhatWasAlteredIsNamedInsteadOfLoaded) {
  EXPECT_EQ(loaded(folder_), "none");
  for (const char* file : {"patch_+000_+000/az000.0_el05.0_f10.000GHz.tif",
                           "ground/patch_-001_+000/az000.0_el05.7_f10.000GHz.tif", "patch_-001_+000/obstacles.tif"}) {
    ASSERT_TRUE(fs::exists(folder_ / file)) << file;
    alter(file);
    EXPECT_THAT(loaded(folder_), testing::AllOf(testing::HasSubstr((folder_ / file).string()),
                                                testing::HasSubstr("was altered"), testing::HasSubstr("--verify")));
    alter(file);
    EXPECT_EQ(loaded(folder_), "none") << file;
  }
}

}  // namespace
}  // namespace sigmascape::atlas
