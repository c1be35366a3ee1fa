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

// At 60 N a degree of longitude turns north by sin 60°: 112 km, which are 2° there, by 1.74°.
TEST(SceneWarnings, TellOfAFrameWhoseNorthIsNotThatOfTheScene) {
  Scene scene;
  scene.name = "place";
  scene.frame = geo::LocalFrame(60.0, 10.0);
  const auto with_middle_at = [&](double x, double y) {
    scene.extent = {x - 1e3, y - 1e3, x + 1e3, y + 1e3};
    return warnings_of(scene);
  };
  EXPECT_THAT(with_middle_at(112e3, 0.0), ::testing::ElementsAre(::testing::HasSubstr("lies 1.7° east of true north")));
  EXPECT_THAT(with_middle_at(-112e3, 0.0),
              ::testing::ElementsAre(::testing::HasSubstr("lies 1.7° west of true north")));
  EXPECT_THAT(with_middle_at(20e3, 250e3), ::testing::IsEmpty());
  scene.frame = geo::LocalFrame(0.0, 10.0);
  EXPECT_THAT(with_middle_at(250e3, 0.0), ::testing::IsEmpty());
}

}  // namespace
}  // namespace sigmascape::scene
