#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "end_to_end/made_scene.h"
#include "scratch_folder.h"

namespace sigmascape::end_to_end {
namespace {

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(LevelZeroFrame, TheExampleShowsBothLevelsOfAnySceneAndItsAtlas) {
  const ScratchFolder folder;
  const auto scene = write_made_scene(folder.path("town"), 120.0, 120.0);
  const auto atlas = folder.path("atlas"), picture = folder.path("levels.png"), told = folder.path("told");
  ASSERT_EQ(run(fmt::format("'{}' bake '{}' --out '{}' --patch-texels 256 --azimuths 4 --elevations-deg 5,13 "
                            "--samples 2 --json > '{}'",
                            SIGMASCAPE_CLI, scene.string(), atlas.string(), told.string())),
            0);
  ASSERT_EQ(run(fmt::format("'{}' '{}' '{}' '{}' > '{}'", SIGMASCAPE_EXAMPLE_LEVEL_ZERO, scene.string(), atlas.string(),
                            picture.string(), told.string())),
            0);
  std::ifstream stream(told);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(text, ::testing::StartsWith("level of detail 0: the full scene, path-traced"));
  EXPECT_THAT(text, ::testing::HasSubstr("32 rays a cell"));
  EXPECT_GT(std::filesystem::file_size(picture), 10'000U);
}

}  // namespace
}  // namespace sigmascape::end_to_end
