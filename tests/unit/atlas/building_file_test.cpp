#include "sigmascape/atlas/building_file.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <string>

#include "example_obstacles.h"
#include "scratch_folder.h"

#include "sigmascape/atlas/verify.h"
#include "sigmascape/base/error.h"

namespace sigmascape::atlas {
namespace {

using ::testing::HasSubstr;

/// A tent of two slopes with two gables, of two materials by turns.
Buildings tent() {
  Buildings buildings{
      .vertices = {{0, 0, 7}, {10, 0, 7}, {10, 8, 7}, {0, 8, 7}, {0, 4, 9.5F}, {10, 4, 9.5F}},
      .triangles = {{0, 1, 5}, {1, 2, 5}, {0, 5, 4}, {2, 3, 4}, {3, 0, 4}, {2, 4, 5}},
      .material_of = {0, 1, 0, 0, 1, 0},
      .materials = {},
  };
  for (const char* name : {"roof", "gable"}) {
    FaceMaterial& material = buildings.materials.emplace_back();
    material.name = name;
    for (int frequency = 0; frequency < 2; ++frequency) {
      radar::FaceReflectivity& reflectivity = material.reflectivity.emplace_back();
      for (std::size_t node = 0; node < radar::FaceReflectivity::node_count; ++node) {
        const auto number = static_cast<float>(node) + 1000.0F * static_cast<float>(frequency);
        reflectivity.at_node.push_back({number, 0.5F * number, 0.25F * number, -number});
      }
    }
  }
  return buildings;
}

AtlasDescription with_buildings_apart() {
  AtlasDescription description = wide_ground_apart();
  description.settings[buildings_setting] = buildings_apart;
  description.format_version = newest_format_version;
  return description;
}

class BuildingFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::string bytes() const {
    std::ifstream stream(atlas_.folder() / buildings_name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  [[nodiscard]] std::string fault() const {
    const auto found = buildings_fault(atlas_, Scrutiny::Content);
    return found ? found->file.string() + " " + found->what : "";
  }

  ScratchFolder folder_;
  Store atlas_ = Store::create(folder_.path("a"), with_buildings_apart());
};

TEST_F(BuildingFile, GivesBackFacesMaterialByMaterial) {
  const Buildings given = tent();
  write_buildings(atlas_, given);
  const Buildings read = read_buildings(atlas_);
  EXPECT_EQ(read.vertices, given.vertices);
  ASSERT_EQ(read.triangles.size(), 6U);
  EXPECT_EQ(read.triangles[0], given.triangles[0]);
  EXPECT_EQ(read.triangles[3], given.triangles[5]) << "the last roof before the first gable";
  EXPECT_EQ(read.triangles[5], given.triangles[4]);
  EXPECT_THAT(read.material_of, ::testing::ElementsAre(0, 0, 0, 0, 1, 1));
  ASSERT_EQ(read.materials.size(), 2U);
  EXPECT_EQ(read.materials[1].name, "gable");
  ASSERT_EQ(read.materials[1].reflectivity.size(), 2U);
  EXPECT_EQ(read.materials[1].reflectivity[1].at_node, given.materials[1].reflectivity[1].at_node);
}

TEST_F(BuildingFile, MayHoldNone) {
  write_buildings(atlas_, {});
  EXPECT_TRUE(read_buildings(atlas_).triangles.empty());
}

TEST_F(BuildingFile, HasTheSameBytesOfTheSameBuildings) {
  write_buildings(atlas_, tent());
  const std::string first = bytes();
  write_buildings(atlas_, tent());
  EXPECT_EQ(bytes(), first);
}

TEST_F(BuildingFile, IsVouchedForByItsItem) {
  EXPECT_EQ(fault(), "buildings.glb is missing");
  write_buildings(atlas_, tent());
  EXPECT_EQ(fault(), "");
  std::string altered = bytes();
  altered[altered.size() / 2] ^= 1;
  std::ofstream(atlas_.folder() / buildings_name, std::ios::binary) << altered;
  EXPECT_EQ(fault(), "buildings.glb was altered: its SHA-256 is not the recorded one");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_buildings(atlas_)); }), HasSubstr("bake again"));
  std::filesystem::remove(atlas_.folder() / "buildings.json");
  EXPECT_THAT(fault(), HasSubstr("buildings.json is missing"));
}

// Whole and vouched for, and yet of another kind.
TEST_F(BuildingFile, OfOtherAnglesIsRefused) {
  Buildings other = tent();
  other.materials[0].reflectivity[0].at_node.resize(91);
  write_buildings(atlas_, other);
  EXPECT_EQ(fault(), "");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_buildings(atlas_)); }), HasSubstr("cannot be understood"));
}

TEST_F(BuildingFile, IsVerifiedWithTheAtlas) {
  const auto is_of_buildings = [](const StoreFault& found) { return found.file == buildings_name; };
  const auto found = [&] {
    const auto faults = verify(atlas_);
    return std::ranges::count_if(faults, is_of_buildings);
  };
  EXPECT_EQ(found(), 1);
  write_buildings(atlas_, tent());
  EXPECT_EQ(found(), 0);
}

TEST_F(BuildingFile, IsNotForProgramsThatKnowOfNone) {
  std::ifstream stream(atlas_.folder() / "collection.json");
  const std::string collection(std::istreambuf_iterator<char>(stream), {});
  EXPECT_THAT(collection, HasSubstr("\"format_version\": 3"));
  EXPECT_THAT(collection, HasSubstr("./buildings.json"));
  EXPECT_FALSE(keeps_buildings_apart(wide_ground_apart()));
}

}  // namespace
}  // namespace sigmascape::atlas
