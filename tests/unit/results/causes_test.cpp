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
std::vector<ResultsRow> rows_with_causes(const ResultsPlan& plan) {
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
  const auto rows = rows_with_causes(plan);
  EXPECT_THAT(largest_causes(plan, rows, ViewKind::HeldOut),
              AllOf(StartsWith("The largest by RMS is: missing angles (ours"),
                    HasSubstr("falls by 2.00 dB in the median over the views, at 4 of 4; it is the largest cause at 4 "
                              "of these views")));
  EXPECT_THAT(largest_causes(plan, rows, ViewKind::OnGrid),
              AllOf(StartsWith("The largest by RMS is: sampling noise of the bake"),
                    HasSubstr("falls by 5.00 dB in the median over the views, at 4 of 4; it is the largest cause at 4 "
                              "of these views")));
}

TEST(ResultsCauses, ByRelativeL1MayBeOthersThanByRms) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(
      largest_causes(plan, rows_with_causes(plan), ViewKind::HeldOut),
      HasSubstr("By relative L1 it is: flat-ground shadows on slopes (ours: shadows baked against made at run time). "
                "Without it L1 falls by 0.300 in the median over the views, at 4 of 4; it is the largest cause at 4 of "
                "these views."));
  EXPECT_THAT(largest_causes(plan, rows_with_causes(plan), ViewKind::OnGrid),
              HasSubstr("No cause adds to the relative L1."));
}

TEST(ResultsCauses, ThatAreTheSameByBothAreSaidToBe) {
  const ResultsPlan plan = made_plan();
  const std::vector<ResultsRow> rows{made_row(made_case(plan, Method::BakedShadows, ViewKind::OnGrid), 7.0, 0.8),
                                     made_row(made_case(plan, Method::LevelGround, ViewKind::OnGrid), 6.0, 0.5)};
  EXPECT_THAT(
      largest_causes(plan, rows, ViewKind::OnGrid),
      HasSubstr("It is by relative L1 too, which falls by 0.300 in the median over the views, at 4 of 4; it is the "
                "largest cause at 4 of these views."));
}

/// Views at 5°, 15°, … elevation, with the errors of one case.
ResultsRow row_of_views(const ResultsCase& of, const std::vector<double>& each_db) {
  ResultsRow row = made_row(of, median(each_db), 0.5);
  row.views = each_db.size();
  row.at_views.resize(each_db.size(), row.at_views.front());
  for (std::size_t view = 0; view < each_db.size(); ++view) {
    row.at_views[view].azimuth_deg = 45.0 * static_cast<double>(view);
    row.at_views[view].elevation_deg = 5.0 + 10.0 * static_cast<double>(view);
    row.at_views[view].tested.rms_db = each_db[view];
  }
  return row;
}

/// Shadows take 9 dB off at one view and hardly any at three, layover 5 dB there and 2, 1 and 1 dB.
std::vector<ResultsRow> rows_of_one_odd_view(const ResultsPlan& plan) {
  return {row_of_views(made_case(plan, Method::BakedShadows, ViewKind::OnGrid), {19.0, 8.1, 7.1, 6.1}),
          row_of_views(made_case(plan, Method::LevelGround, ViewKind::OnGrid), {10.0, 8.0, 7.0, 6.0}),
          row_of_views(made_case(plan, Method::OwnGround, ViewKind::OnGrid), {5.0, 6.0, 6.0, 5.0})};
}

TEST(ResultsCauses, AreWeighedByTheMedianSoThatNoSingleViewDecides) {
  const ResultsPlan plan = made_plan();
  const auto rows = rows_of_one_odd_view(plan);
  EXPECT_THAT(
      largest_causes(plan, rows, ViewKind::OnGrid),
      AllOf(StartsWith("The largest by RMS is: layover placement and mutual shadowing on slopes"),
            HasSubstr("falls by 1.50 dB in the median over the views, at 4 of 4; it is the largest cause at 3 of "
                      "these views.")));
  EXPECT_THAT(causes_table(plan, rows, ViewKind::OnGrid),
              AllOf(HasSubstr("RMS falls by, median [dB]"), HasSubstr("| +0.10 | 4 of 4 |\n"),
                    HasSubstr("| +1.50 | 4 of 4 |\n")));
}

TEST(ResultsCauses, ThatBothMethodsAreMeasuredForAreNoRivalsOfThemselves) {
  const ResultsPlan plan = made_plan();
  ResultsCase own = made_case(plan, Method::OwnGround, ViewKind::HeldOut), paper = own;
  paper.method = Method::Paper;
  ResultsCase own_baked = own, paper_baked = paper;
  own_baked.grid = paper_baked.grid = own_look;
  EXPECT_THAT(
      largest_causes(plan,
                     {row_of_views(own, {9.0, 6.0, 9.0}), row_of_views(own_baked, {5.0, 5.0, 5.0}),
                      row_of_views(paper, {8.0, 8.0, 8.0}), row_of_views(paper_baked, {5.0, 5.0, 5.0})},
                     ViewKind::HeldOut),
      AllOf(StartsWith("The largest by RMS is: missing angles (ours on its own ground"),
            HasSubstr("falls by 4.00 dB in the median over the views, at 3 of 3; it is the largest cause at 3 of "
                      "these views.")));
}

TEST(ResultsCauses, FlatGroundShadowsAreToldOfWhereTheyPutThePapersMethodFarOff) {
  const ResultsPlan plan = made_plan();
  auto rows = rows_of_one_odd_view(plan);
  rows.push_back(row_of_views(made_case(plan, Method::Paper, ViewKind::OnGrid), {17.9, 6.0, 6.0, 6.0}));
  ResultsAtView& worst = rows.back().at_views.front();
  worst.tested.bias_db = -8.69;
  worst.tested.correlation_db = 0.299;
  // cot 5° = 11.4.
  EXPECT_EQ(flat_shadows_text(plan, rows),
            "The total power of the paper's maps is farthest off at azimuth 0.0°, elevation 5.0°: 8.69 dB too dark, "
            "17.90 dB RMS, correlation 0.299. There flat-ground shadows are the largest cause: our own maps come "
            "closer by 9.00 dB when shadows are made at run time. Baked ones are 11.4 times as long as what casts them "
            "is high, whatever the slope; on those that face towards the radar true shadows are shorter.");
  EXPECT_THAT(causes_section(plan, rows), HasSubstr(flat_shadows_text(plan, rows) + "\n\n"));
  worst.tested.bias_db = 8.69;
  EXPECT_THAT(flat_shadows_text(plan, rows), HasSubstr("face away from the radar true shadows are longer"));
  worst.tested.bias_db = -2.9;
  EXPECT_EQ(flat_shadows_text(plan, rows), "") << "a little too dark";
  worst.tested.bias_db = -8.69;
  rows.front().at_views.front().tested.rms_db = 11.0;
  EXPECT_EQ(flat_shadows_text(plan, rows), "") << "layover takes more off there";
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
  const auto rows = rows_with_causes(plan);
  const char* truth = "| *truth* | one traced map against another | 0.900 | 2.00 |";
  EXPECT_THAT(causes_table(plan, rows, ViewKind::OnGrid), HasSubstr(truth));
  EXPECT_THAT(causes_table(plan, rows, ViewKind::HeldOut), Not(HasSubstr(truth))) << "no row of the paper's method";
}

}  // namespace
}  // namespace sigmascape::cli
