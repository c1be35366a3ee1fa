#include "sigmascape/scene/scene_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sigmascape::scene {
namespace {

TEST(SceneWarnings, AreTheRemarksThatAreLikelyMistakes) {
  Scene scene;
  scene.name = "place";
  scene.remarks = {{"trees standing in water, left out", 3, "trees.csv: feature 7"},
                   {"files without a feature that is asked for", 1, "houses.csv: has none", true},
                   {"meshes of nothing", 2, "mast.obj: face 1", true}};
  EXPECT_THAT(warnings_of(scene),
              ::testing::ElementsAre("place: files without a feature that is asked for: 1, first houses.csv: has none",
                                     "place: meshes of nothing: 2, first mast.obj: face 1"));
}

}  // namespace
}  // namespace sigmascape::scene
