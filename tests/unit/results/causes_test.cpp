#include "results/causes.h"

#include <algorithm>
#include <functional>
#include <gmock/gmock.h>

#include "made_rows.h"

namespace sigmascape::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Rows in which missing angles take 2 dB at held-out views, the bake's noise 5 dB at views that were baked, shadows
/// 1 dB and an L1 of 0.3 at held-out views, and hills 9 dB against level ground, whose truth is another.
std::vector<ResultsRow> made_rows(const ResultsPlan& plan) {
  const auto own_look_of = [&](ViewKind kind, std::uint32_t samples) {
    ResultsCase of = made_case(plan, Method::OwnGround, kind);
    of.grid = own_look;
    of.baked_samples = samples;
    return of;
  };
  ResultsCase levelled = made_case(plan, Method::Paper, ViewKind::OnGrid);
  levelled.scene = "level";
  return {made_row(made_case(plan, Method::OwnGround, ViewKind::HeldOut), 6.0, 0.5),
          made_row(own_look_of(ViewKind::HeldOut, plan.baked_samples), 4.0, 0.4),
          made_row(made_case(plan, Method::BakedShadows, ViewKind::HeldOut), 7.0, 0.8),
          made_row(made_case(plan, Method::LevelGround, ViewKind::HeldOut), 6.0, 0.5),
          made_row(own_look_of(ViewKind::OnGrid, plan.baked_samples), 9.0, 0.3),
          made_row(own_look_of(ViewKind::OnGrid, plan.finer_samples), 4.0, 0.3),
          made_row(made_case(plan, Method::Paper, ViewKind::OnGrid), 12.0, 0.9),
          made_row(levelled, 3.0, 0.1)};
}

TEST(ResultsCauses, AreWeighedAtTheSameViewsAlone) {
  const ResultsPlan plan = made_plan();
  const auto rows = made_rows(plan);
  EXPECT_THAT(largest_causes(plan, rows, ViewKind::HeldOut),
              AllOf(StartsWith("The largest by RMS is: missing angles (ours"),
                    HasSubstr("falls by 2.00 dB in the mean over the views, at 4 of 4")));
  EXPECT_THAT(largest_causes(plan, rows, ViewKind::OnGrid),
              AllOf(StartsWith("The largest by RMS is: sampling noise of the bake"),
                    HasSubstr("falls by 5.00 dB in the mean over the views, at 4 of 4")));
}

TEST(ResultsCauses, ByRelativeL1MayBeOthersThanByRms) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(
      largest_causes(plan, made_rows(plan), ViewKind::HeldOut),
      HasSubstr("By relative L1 it is: flat-ground shadows on slopes (ours: shadows baked against made at run time). "
                "Without it L1 falls by 0.300 in the mean over the views, at 4 of 4."));
  EXPECT_THAT(largest_causes(plan, made_rows(plan), ViewKind::OnGrid), HasSubstr("No cause adds to the relative L1."));
}

TEST(ResultsCauses, ThatAreTheSameByBothAreSaidToBe) {
  const ResultsPlan plan = made_plan();
  const std::vector<ResultsRow> rows{made_row(made_case(plan, Method::BakedShadows, ViewKind::OnGrid), 7.0, 0.8),
                                     made_row(made_case(plan, Method::LevelGround, ViewKind::OnGrid), 6.0, 0.5)};
  EXPECT_THAT(largest_causes(plan, rows, ViewKind::OnGrid),
              HasSubstr("It is by relative L1 too, which falls by 0.300 in the mean over the views, at 4 of 4."));
}

TEST(ResultsCauses, StandOnlyAmongThoseOfTheirKindOfViews) {
  const ResultsPlan plan = made_plan();
  for (const ViewKind kind : {ViewKind::HeldOut, ViewKind::OnGrid}) {
    for (const Contrast& cause : causes(plan, kind)) {
      EXPECT_EQ(cause.with.kind, kind) << cause.name;
      EXPECT_EQ(cause.without.kind, kind) << cause.name;
    }
  }
  EXPECT_EQ(std::ranges::count_if(causes(plan, ViewKind::OnGrid), std::not_fn(are_of_the_same_views)), 1);
  EXPECT_EQ(std::ranges::count_if(causes(plan, ViewKind::HeldOut), std::not_fn(are_of_the_same_views)), 0);
}

TEST(ResultsCauses, HaveTheTruthsNoiseBesideThem) {
  const ResultsPlan plan = made_plan();
  const auto rows = made_rows(plan);
  const char* truth = "| *truth* | one traced map against another | 0.900 | 2.00 |";
  EXPECT_THAT(causes_table(plan, rows, ViewKind::OnGrid), HasSubstr(truth));
  EXPECT_THAT(causes_table(plan, rows, ViewKind::HeldOut), Not(HasSubstr(truth))) << "no row of the paper's method";
}

}  // namespace
}  // namespace sigmascape::cli
