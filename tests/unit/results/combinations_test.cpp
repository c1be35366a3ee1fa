#include "results/combinations.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

#include "made_rows.h"

namespace sigmascape::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Ways to a map at held-out views: the paper's, one better in fewer bytes, one better still in more; and what is no
/// way: the view's own look, a level of detail, an upper bound, a traced map, and views that were baked.
std::vector<ResultsRow> rows_of_ways(const ResultsPlan& plan) {
  const ResultsCase paper = made_case(plan, Method::Paper, ViewKind::HeldOut);
  const ResultsCase own = made_case(plan, Method::OwnGround, ViewKind::HeldOut);
  ResultsCase finer = own, look = own, coarse = own, bound = own, traced = own, on_grid = own;
  finer.grid = plan.grids[2].name();
  look.grid = own_look;
  coarse.level_of_detail = 2;
  bound.change = renormalized_change;
  traced.method = Method::Traced;
  on_grid.kind = ViewKind::OnGrid;
  return {made_row(paper, 8.0, 0.8, 1000), made_row(own, 6.0, 0.6, 500),   made_row(finer, 5.0, 0.4, 2000),
          made_row(look, 4.0, 0.2, 100),   made_row(coarse, 1.0, 0.1, 10), made_row(bound, 1.0, 0.1, 10),
          made_row(traced, 1.0, 0.1, 10),  made_row(on_grid, 1.0, 0.1, 10)};
}

TEST(ResultsCombinations, BestIsTheLeastRmsOfHeldOutViewsInTheBytesGiven) {
  const ResultsPlan plan = made_plan();
  const auto rows = rows_of_ways(plan);
  EXPECT_EQ(best_combination(plan, rows, 1000), &rows[1]);
  EXPECT_EQ(best_combination(plan, rows, 1'000'000), &rows[2]);
  EXPECT_EQ(best_combination(plan, rows, 1), nullptr);
}

/// Rows whose medians are so far apart, the second of which is closer at three of four views all the same.
std::vector<ResultsRow> nearly_alike_rows(const ResultsPlan& plan, double apart_db) {
  auto rows = rows_of_ways(plan);
  ResultsCase usual = rows[2].of;
  usual.baked_samples = 0;
  usual.change = adaptive_change;
  rows.push_back(made_row(usual, 5.0 + apart_db, 0.4, 2000));
  for (std::size_t view = 0; view < 3; ++view) rows.back().at_views[view].tested.rms_db = 4.9;
  return rows;
}

TEST(ResultsCombinations, BestOfWaysWithNearlyTheSameMedianIsCloserAtMoreOfTheViews) {
  const ResultsPlan plan = made_plan();
  auto rows = nearly_alike_rows(plan, 0.04);
  EXPECT_EQ(best_combination(plan, rows, 1'000'000), &rows.back());
  std::ranges::reverse(rows);
  EXPECT_EQ(best_combination(plan, rows, 1'000'000), &rows.front()) << "in whatever order they were measured";
  rows.front().at_views[0].tested.rms_db = rows.front().at_views[1].tested.rms_db = 5.1;
  EXPECT_EQ(best_combination(plan, rows, 1'000'000)->of.change, "") << "closer at one view, farther off at three";
}

TEST(ResultsCombinations, BestIsTheLeastMedianWhereMediansDiffer) {
  const ResultsPlan plan = made_plan();
  const auto rows = nearly_alike_rows(plan, 0.06);
  EXPECT_EQ(best_combination(plan, rows, 1'000'000), &rows[2]);
}

TEST(ResultsCombinations, SayByWhatRuleTheyAreTheBestAndBelowWhatNoErrorCanBeShown) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(combinations_table(plan, rows_of_ways(plan)),
              AllOf(HasSubstr("of ways within 0.05 dB of the least the one that is closer at more of the views"),
                    HasSubstr("two traced maps of one view differ by 2.00 dB themselves, no error below half of that, "
                              "1.00 dB, can be shown.")));
}

TEST(ResultsCombinations, BestMayHaveRaysWhereTheNoiseIs) {
  const ResultsPlan plan = made_plan();
  auto rows = rows_of_ways(plan);
  ResultsCase usual = rows[2].of, look = rows[3].of;
  for (ResultsCase* of : {&usual, &look}) {
    of->baked_samples = 0;
    of->change = adaptive_change;
  }
  rows.push_back(made_row(usual, 4.5, 0.4, 2000));
  rows.push_back(made_row(look, 3.0, 0.1, 100));
  EXPECT_EQ(best_combination(plan, rows, 1'000'000)->of, usual);
  EXPECT_THAT(combinations_table(plan, rows),
              HasSubstr("| best of all | ours, on its own ground, rays where the noise is, 16 × 6 | 0.900 | 4.50 |"));
  EXPECT_THAT(
      limits_section(plan, rows),
      HasSubstr("*ours, on its own ground, rays where the noise is, 16 × 6* most is missing angles. Its RMS error is "
                "4.50 dB; from a texture baked for the view itself (its own look), where no angle is missing, "
                "3.00 dB are left"))
      << "its own look has rays where the noise is as well";
}

TEST(ResultsCombinations, ErrorIsPartedIntoWhatTheOwnLookLacksWhatTheTruthAddsAndTheRest) {
  const ErrorParts parts = error_parts(5.0, 4.0, 2.0);
  EXPECT_DOUBLE_EQ(parts.all_db2, 25.0);
  EXPECT_DOUBLE_EQ(parts.missing_angles_db2, 9.0);
  EXPECT_DOUBLE_EQ(parts.truth_noise_db2, 1.0);
  EXPECT_DOUBLE_EQ(parts.rest_db2, 15.0);
}

TEST(ResultsCombinations, NoPartIsNegativeWhereTheOwnLookIsWorseThanTheGrid) {
  const ErrorParts parts = error_parts(3.0, 4.0, 10.0);
  EXPECT_DOUBLE_EQ(parts.missing_angles_db2, 0.0);
  EXPECT_DOUBLE_EQ(parts.truth_noise_db2, 9.0);
  EXPECT_DOUBLE_EQ(parts.rest_db2, 0.0);
}

TEST(ResultsCombinations, AMapWithoutFaultIsHalfTheDifferenceOfTwoTracedMapsFromTheirMean) {
  // Noise of variance 2 in each: the difference of two has 4, their mean 1.
  EXPECT_DOUBLE_EQ(least_error(std::sqrt(4.0)), std::sqrt(1.0));
  // Of two with ρ = 0.5 signal and noise have the same variance; their mean has half the noise.
  EXPECT_DOUBLE_EQ(most_correlation(0.5), std::sqrt(1.0 / 1.5));
}

TEST(ResultsCombinations, TableHasThePapersOursFromItsLooksTheBestInItsBytesAndTheBest) {
  const ResultsPlan plan = made_plan();
  auto rows = rows_of_ways(plan);
  rows[0].trace_seconds = 19.4;
  EXPECT_THAT(
      combinations_table(plan, rows),
      AllOf(HasSubstr(
                "| ours, the same looks; best in the paper's bytes | ours, on its own ground, 8 × 5 | 0.900 | 6.00 |"),
            HasSubstr("| best of all | ours, on its own ground, 16 × 6 | 0.900 | 5.00 |"),
            HasSubstr("| *truth* | one traced map against another, 1024 to 6144 rays a cell | 0.900 | 2.00 |"),
            HasSubstr(" | | | 19 with 1024 |"), Not(HasSubstr("as many looks as the best"))));
  ResultsCase paper = rows[0].of;
  paper.grid = rows[2].of.grid;
  rows.push_back(made_row(paper, 7.0, 0.7, 5000));
  EXPECT_THAT(combinations_table(plan, rows),
              HasSubstr("| paper, as many looks as the best | paper, 16 × 6 | 0.900 | 7.00 |"));
}

TEST(ResultsCombinations, LimitsAreOfTheGridsThatTheyName) {
  const ResultsPlan plan = made_plan();
  const std::string text = limits_section(plan, rows_of_ways(plan));
  // 36 = 20 + 1 + 15 and 25 = 9 + 1 + 15 dB².
  EXPECT_THAT(text, HasSubstr("What limits *ours, on its own ground, 8 × 5* most is missing angles."));
  EXPECT_THAT(text, HasSubstr("missing angles are at least 56 %, the truth's noise at least 3 %, and the bake's noise, "
                              "texels and mips at most the "
                              "remaining 42 %"));
  EXPECT_THAT(text, HasSubstr("The error of *ours, on its own ground, 16 × 6* has several causes."));
  EXPECT_THAT(text, HasSubstr("its error is 0.600, that of the own look 0.200"));
}

TEST(ResultsCombinations, OfAWayThatIsCloserThanTheOwnLookNoShareIsTold) {
  const ResultsPlan plan = made_plan();
  auto rows = rows_of_ways(plan);
  rows[3] = made_row(rows[3].of, 5.5, 0.2, 100);
  EXPECT_THAT(
      limits_section(plan, rows),
      AllOf(HasSubstr(
                "*ours, on its own ground, 16 × 6* comes closer to the truth, 5.00 dB RMS, than a texture baked for "
                "the view itself with as many rays (its own look), 5.50 dB"),
            HasSubstr("How much of its error missing angles are, and how much noise, these numbers do not tell.")));
}

// 25 dB² against 4.8² = 23.04: noise that is averaged may hide more than these 8 %.
TEST(ResultsCombinations, OfAWayThatIsHardlyFartherOffThanTheOwnLookNoShareIsToldEither) {
  const ResultsPlan plan = made_plan();
  auto rows = rows_of_ways(plan);
  rows[3] = made_row(rows[3].of, 4.8, 0.2, 100);
  EXPECT_THAT(limits_section(plan, rows),
              AllOf(HasSubstr("*ours, on its own ground, 16 × 6* comes about as close to the truth, 5.00 dB RMS, as a "
                              "texture baked for the view itself with as many rays (its own look), 4.80 dB"),
                    HasSubstr("these numbers do not tell"), Not(HasSubstr("at least 8 %"))));
}

TEST(ResultsCombinations, VerdictSaysWhatIsComparedBothMethodsTheBestAndItsSpeed) {
  const ResultsPlan plan = made_plan();
  auto rows = rows_of_ways(plan);
  rows[2].render_ms = 184.0;
  EXPECT_EQ(
      verdict(plan, rows),
      "Maps rendered from baked textures are held against path-traced ones, cell by cell of 8 m, at 4 views from "
      "directions that were not baked. From the 8 × 5 directions (azimuths × elevations) of the paper that is followed "
      "here ours are off by 6.00 dB RMS in the "
      "median, those of the paper's method by 8.00 dB; ours come closer at all of the views. The best maps, *ours, "
      "on its own ground, 16 × 6*, are off by 5.00 dB. Such a map takes 0.18 s of processor time.\n\n");
}

TEST(ResultsCombinations, VerdictIsOfThePapersMethodWhereOursWasNotMeasuredFromItsLooks) {
  const ResultsPlan plan = made_plan();
  auto rows = rows_of_ways(plan);
  rows.erase(rows.begin() + 1);
  EXPECT_THAT(verdict(plan, rows), HasSubstr("From the 8 × 5 directions (azimuths × elevations) of the paper that is "
                                             "followed here the paper's method is off by 8.00 dB "
                                             "RMS in the median. The best maps, *ours, on its own ground, 16 × 6*"));
}

TEST(ResultsCombinations, SayNothingWithoutHeldOutViews) {
  const ResultsPlan plan = made_plan();
  const std::vector<ResultsRow> rows{made_row(made_case(plan, Method::Paper, ViewKind::OnGrid), 8.0, 0.8)};
  EXPECT_EQ(combinations_table(plan, rows) + limits_section(plan, rows) + verdict(plan, rows), "");
}

}  // namespace
}  // namespace sigmascape::cli
