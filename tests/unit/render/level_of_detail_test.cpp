#include "sigmascape/render/level_of_detail.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::render {
namespace {

using ::testing::HasSubstr;

/// A town of the paper's, seen at 8.6°.
DetailQuestion town_question() {
  return {.range_resolution_m = 4.0,
          .cross_range_m = 6.0,
          .grazing_rad = radians_from_deg(8.6),
          .samples_per_cell = 2.0,
          .tallest_object_m = 20.0,
          .area_m2 = 250e3,
          .terrain_spacing_m = 4.0,
          .terrain_levels = 8,
          .texel_m = 2.0,
          .mips = 10};
}

TEST(LevelOfDetail, TheReachOfAnObjectIsItsLayoverAndItsShadow) {
  const DetailChoice choice = choose_detail(town_question());
  EXPECT_NEAR(choice.layover_m, 3.0, 0.03);
  EXPECT_NEAR(choice.shadow_m, 132.0, 0.5);
}

TEST(LevelOfDetail, ASmallAreaWithVisibleObjectsIsTraced) {
  const DetailChoice choice = choose_detail(town_question());
  EXPECT_FALSE(choice.geometry_may_go);
  EXPECT_EQ(choice.level, 0);
}

TEST(LevelOfDetail, ALargeAreaIsNeverTraced) {
  DetailQuestion question = town_question();
  question.area_m2 = 1e9;
  const DetailChoice choice = choose_detail(question);
  EXPECT_EQ(choice.level, 1);
  EXPECT_FALSE(choice.geometry_may_go);
  EXPECT_THAT(explained(choice), HasSubstr("too large to be traced"));
}

TEST(LevelOfDetail, GeometryGoesExactlyWhenItsReachIsBelowTheAllowedPartOfACell) {
  DetailQuestion question = town_question();
  const double reach_m = 20.0 / std::tan(question.grazing_rad);
  for (const double part : {0.99, 1.01}) {
    question.cross_range_m = 1e9;
    question.range_resolution_m = part * 2.0 * reach_m * std::cos(question.grazing_rad);
    EXPECT_EQ(choose_detail(question).geometry_may_go, part > 1.0);
    EXPECT_EQ(choose_detail(question).level == 0, part < 1.0);
  }
  // At steep angles layover takes over from shadow.
  question.grazing_rad = radians_from_deg(70.0);
  question.range_resolution_m = 2.0 * 20.0 * std::tan(question.grazing_rad) * std::cos(question.grazing_rad) * 0.99;
  EXPECT_FALSE(choose_detail(question).geometry_may_go);
}

TEST(LevelOfDetail, TheSmallerSideOfTheCellChoosesTheMip) {
  DetailQuestion question = town_question();
  question.area_m2 = 1e10;
  // A beam of 2° at 40 km by 75 m of range: two samples in 75 m are 37.5 m.
  question.range_resolution_m = 75.0;
  question.cross_range_m = 1400.0;
  question.grazing_rad = radians_from_deg(2.0);
  const DetailChoice choice = choose_detail(question);
  EXPECT_NEAR(choice.mip, std::log2(75.0 / std::cos(radians_from_deg(2.0)) / 2.0 / 2.0), 1e-9);
  EXPECT_EQ(choice.level, 1 + 4);
  // Nodes 64 m apart stand between one and two samples.
  EXPECT_EQ(choice.terrain_level, 4);
}

TEST(LevelOfDetail, TheSameMapOfTwiceTheSizeIsOneLevelCoarser) {
  DetailQuestion question = town_question();
  question.area_m2 = 1e10;
  const DetailChoice fine = choose_detail(question);
  question.range_resolution_m *= 2.0;
  question.cross_range_m *= 2.0;
  const DetailChoice coarse = choose_detail(question);
  EXPECT_NEAR(coarse.wanted_level - fine.wanted_level, 1.0, 1e-9);
  EXPECT_EQ(coarse.terrain_level - fine.terrain_level, 1);
}

TEST(LevelOfDetail, ThePapersRuleCountsPixelsATriangle) {
  DetailQuestion question = town_question();
  // 16 samples of 2 m / cos ψ a triangle are about 65 m².
  const double sample_m2 = std::pow(4.0 / std::cos(question.grazing_rad) / 2.0, 2.0);
  for (const double pixels : {15.0, 17.0}) {
    question.triangles_per_m2 = 1.0 / (pixels * sample_m2);
    const DetailChoice choice = choose_detail(question, {.rule = DetailRule::PixelsPerTriangle});
    EXPECT_NEAR(choice.pixels_per_triangle, pixels, 1e-9);
    EXPECT_EQ(choice.level > 0, pixels < 16.0);
  }
}

TEST(LevelOfDetail, StaysWithinWhatTheStoreHas) {
  DetailQuestion question = town_question();
  question.area_m2 = 1e12;
  question.range_resolution_m = question.cross_range_m = 1e6;
  EXPECT_EQ(choose_detail(question).mip, 9.0);
  EXPECT_EQ(choose_detail(question).terrain_level, 7);
  question.range_resolution_m = question.cross_range_m = 0.1;
  const DetailChoice finest = choose_detail(question);
  EXPECT_EQ(finest.mip, 0.0);
  EXPECT_TRUE(finest.finer_than_atlas);
  EXPECT_THAT(explained(finest), HasSubstr("closer than the texels"));
}

TEST(LevelOfDetail, ExplainsItself) {
  const std::string text = explained(choose_detail(town_question()));
  EXPECT_THAT(text, HasSubstr("level of detail 0: the full scene"));
  EXPECT_THAT(text, HasSubstr("shadows 132 m"));
}

TEST(LevelOfDetail, SaysWhoCastsTheShadowsOfWhatIsNotTraced) {
  DetailQuestion question = town_question();
  question.area_m2 = 1e9;
  EXPECT_THAT(explained(choose_detail(question)), HasSubstr("shadows are the baked ones"));
  question.ground_apart = true;
  EXPECT_THAT(explained(choose_detail(question)), HasSubstr("shadows are cast at run time"));
}

TEST(LevelOfDetail, AmplitudesAreNotTraced) {
  DetailQuestion question = town_question();
  question.traceable = false;
  const DetailChoice choice = choose_detail(question);
  EXPECT_EQ(choice.level, 1);
  EXPECT_THAT(explained(choice), HasSubstr("what is traced is power alone"));
}

TEST(LevelOfDetail, TerrainBelongsToTheTexelsThatAreInUse) {
  DetailQuestion question = town_question();
  question.area_m2 = 1e10;
  question.cross_range_m = 1e6;
  // From texels of 4 m to just below the next: nodes of 8 m serve them all.
  for (const double sample_m : {4.01, 5.5, 7.99}) {
    question.range_resolution_m = 2.0 * sample_m * std::cos(question.grazing_rad);
    EXPECT_EQ(choose_detail(question).level, 2);
    EXPECT_EQ(choose_detail(question).terrain_level, 1) << sample_m;
    EXPECT_THAT(explained(choose_detail(question)), HasSubstr("terrain level 1"));
  }
}

/// Flies away from the ground and back, with a tremble, over a change of level.
TEST(DetailTransition, ChangesOnceEachWayAndWithoutAStep) {
  DetailQuestion question = town_question();
  question.area_m2 = 1e10;
  DetailTransition transition(20);
  int changes = 0, level = 1;
  double greatest_step = 0.0, position = 1.0;
  for (int frame = 0; frame < 2000; ++frame) {
    const double along = 0.5 - 0.5 * std::cos(pi * frame / 1000.0);
    question.range_resolution_m = 5.0 * std::exp2(1.4 * along) * (1.0 + 0.03 * std::sin(2.1 * frame));
    question.cross_range_m = 1e6;
    const DetailBlend blend = transition.advance(choose_detail(question));
    const double now = blend.level + blend.next_share * (blend.next - blend.level);
    greatest_step = std::max(greatest_step, std::abs(now - position));
    position = now;
    if (blend.next != level) {
      ++changes;
      level = blend.next;
    }
  }
  EXPECT_EQ(changes, 2);
  EXPECT_NEAR(greatest_step, 1.0 / 20.0, 1e-9);
}

TEST(DetailTransition, ReachesTheCoarsestLevelThatThereIs) {
  DetailQuestion question = town_question();
  question.area_m2 = 1e10;
  question.mips = 3;
  question.cross_range_m = 1e6;
  DetailTransition transition(5);
  DetailBlend blend;
  for (int frame = 0; frame < 100; ++frame) {
    question.range_resolution_m = 4.0 * question.texel_m * std::exp2(0.1 * frame);
    blend = transition.advance(choose_detail(question));
  }
  EXPECT_EQ(blend.level, 3);
  EXPECT_EQ(blend.next, 3);
}

}  // namespace
}  // namespace sigmascape::render
