#include "sigmascape/bake/ground_baker.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include "scratch_folder.h"
#include "sealed_item.h"

#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/atlas/verify.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::bake {
namespace {

namespace fs = std::filesystem;

/// Eight patches about the origin with houses of many heights all over them.
scene::Scene town() {
  scene::Scene scene;
  scene.name = "town";
  scene.extent = {-700, -300, 800, 300};
  scene.terrain = {-800, 800, 1600, Array2D<float>(2, 2, 120.0F)};
  const scatter::Material stone{.name = "stone", .model = scatter::LambertParameters{0.5, {0.1, 0.5}}, .source = {}};
  scene.ground = {{-800, 800, 1600, 1, 1}, Array2D<scene::MaterialIndex>(1, 1, scene.material_index(stone))};
  scene.prototypes.push_back(scene::box_mesh({20, 20, 10}, scene.material_index(stone)));
  for (int i = -13; i < 15; ++i) {
    const auto height = static_cast<float>(i + 14) / 10.0F;
    scene.instances.push_back({.x_m = 50.0F * static_cast<float>(i),
                               .y_m = 20.0F * static_cast<float>(i % 13),
                               .scale = {1.0F, 1.0F, height}});
  }
  return scene;
}

/// Of the town's ground and obstacles, the store of one bake with its files, and others to be held against it.
class GroundBaker : public ::testing::Test {
 protected:
  static BakeSettings settings() {
    BakeSettings settings;
    settings.aspects = {{0.0}, {radians_from_deg(30.0)}, {10e9}};
    settings.patches = {2.0, 256};
    return settings;
  }
  [[nodiscard]] atlas::Store store(const std::string& name) const {
    return atlas::Store::create(folder_.path(name), description_of(scene_, settings()));
  }
  /// Faults of obstacles alone: no look was baked.
  static std::vector<std::string> faults(const atlas::Store& store) {
    std::vector<std::string> files;
    for (const atlas::StoreFault& fault : atlas::verify(store)) {
      if (fault.file.stem() == "obstacles") files.push_back(fault.file.string());
    }
    return files;
  }
  static void alter(const fs::path& path) {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(-1, std::ios::end);
    file.put('?');
  }

  ScratchFolder folder_;
  scene::Scene scene_ = town();
};

TEST_F(GroundBaker, SharesMakeTheSameFilesAsOneRun) {
  bake_ground(scene_, store("one"));
  const auto one = files_of(folder_.path("one"));
  EXPECT_TRUE(one.contains("pyramid_1/patch_-002_-002/obstacles.tif"));
  EXPECT_TRUE(one.contains("patch_+001_+000/obstacles.tif"));
  for (const std::size_t index : {2U, 0U, 1U}) bake_ground(scene_, store("three"), {index, 3});
  EXPECT_EQ(difference_of(files_of(folder_.path("three")), one), "");
}

TEST_F(GroundBaker, DamagedObstaclesAreMadeAnew) {
  const atlas::Store atlas = store("a");
  bake_ground(scene_, atlas);
  EXPECT_TRUE(faults(atlas).empty());
  const auto whole = files_of(atlas.folder());
  const auto file = [&](const atlas::PyramidTile& tile) { return atlas.folder() / atlas::obstacles_path(tile); };

  fs::resize_file(file({0, {-2, -1}}), 1000);
  fs::remove(file({0, {0, 0}}));
  fs::remove(atlas::item_path(file({0, {-1, 0}})));
  fs::resize_file(file({1, {0, -2}}), 1000);
  // As a killed process leaves them.
  const fs::path leftover = file({0, {1, 0}}).parent_path() / ".obstacles.tif.99-0.tmp";
  fs::rename(file({0, {1, 0}}), leftover);
  fs::last_write_time(leftover, fs::file_time_type::clock::now() - std::chrono::hours(30));
  // As another host is about to write them.
  const fs::path another_s = file({0, {1, -1}}).parent_path() / ".obstacles.tif.0123456789abcdef-99-0.tmp";
  std::ofstream(another_s) << "half";
  EXPECT_EQ(faults(atlas).size(), 5U);
  bake_ground(scene_, atlas);
  EXPECT_TRUE(fs::remove(another_s));
  EXPECT_EQ(difference_of(files_of(atlas.folder()), whole), "");

  alter(file({0, {-2, -1}}));
  alter(file({1, {0, 0}}));
  EXPECT_EQ(faults(atlas).size(), 2U);
  bake_ground(scene_, atlas);
  EXPECT_EQ(faults(atlas).size(), 2U) << "what has the right size is only found when asked";
  bake_ground(scene_, atlas, {}, atlas::Scrutiny::Content);
  EXPECT_EQ(difference_of(files_of(atlas.folder()), whole), "");
}

TEST_F(GroundBaker, ObstaclesOfAFormerKindAreMadeAnew) {
  const atlas::Store atlas = store("a");
  bake_ground(scene_, atlas);
  const auto whole = files_of(atlas.folder());
  const fs::path item = atlas.folder() / "patch_-001_-001" / "obstacles.json";
  rewrite_item(item, "sigmascape:tallest_m", "sigmascape:something");
  EXPECT_EQ(faults(atlas), std::vector<std::string>{"patch_-001_-001/obstacles.tif"});
  bake_ground(scene_, atlas);
  EXPECT_EQ(difference_of(files_of(atlas.folder()), whole), "");
}

}  // namespace
}  // namespace sigmascape::bake
