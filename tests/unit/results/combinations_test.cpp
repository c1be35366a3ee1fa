#include "results/combinations.h"

#include <cmath>
#include <gmock/gmock.h>

#include "made_rows.h"

namespace sigmascape::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Ways to a map at held-out views: the paper's, one better in fewer bytes, one better still in more; and what is no
/// way: the view's own look, a level of detail, an upper bound, and views that were baked.
std::vector<ResultsRow> made_rows(const ResultsPlan& plan) {
  const ResultsCase paper = made_case(plan, Method::Paper, ViewKind::HeldOut);
  const ResultsCase own = made_case(plan, Method::OwnGround, ViewKind::HeldOut);
  ResultsCase finer = own, look = own, coarse = own, bound = own, on_grid = own;
  finer.grid = plan.grids[2].name();
  look.grid = own_look;
  coarse.level_of_detail = 2;
  bound.change = renormalized_change;
  on_grid.kind = ViewKind::OnGrid;
  return {made_row(paper, 8.0, 0.8, 1000), made_row(own, 6.0, 0.6, 500),   made_row(finer, 5.0, 0.4, 2000),
          made_row(look, 4.0, 0.2, 100),   made_row(coarse, 1.0, 0.1, 10), made_row(bound, 1.0, 0.1, 10),
          made_row(on_grid, 1.0, 0.1, 10)};
}

TEST(ResultsCombinations, BestIsTheLeastRmsOfHeldOutViewsInTheBytesGiven) {
  const ResultsPlan plan = made_plan();
  const auto rows = made_rows(plan);
  EXPECT_EQ(best_combination(plan, rows, 1000), &rows[1]);
  EXPECT_EQ(best_combination(plan, rows, 1'000'000), &rows[2]);
  EXPECT_EQ(best_combination(plan, rows, 1), nullptr);
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
  auto rows = made_rows(plan);
  EXPECT_THAT(
      combinations_table(plan, rows),
      AllOf(HasSubstr(
                "| ours, the same looks; best in the paper's bytes | ours, on its own ground, 8 × 5 | 0.900 | 6.00 |"),
            HasSubstr("| best of all | ours, on its own ground, 16 × 6 | 0.900 | 5.00 |"),
            HasSubstr("| *truth* | one traced map against another, 1024 to 6144 rays a cell | 0.900 | 2.00 |"),
            Not(HasSubstr("looks of the best"))));
  ResultsCase paper = rows[0].of;
  paper.grid = rows[2].of.grid;
  rows.push_back(made_row(paper, 7.0, 0.7, 5000));
  EXPECT_THAT(combinations_table(plan, rows),
              HasSubstr("| paper, the looks of the best | paper, 16 × 6 | 0.900 | 7.00 |"));
}

TEST(ResultsCombinations, LimitsAreOfTheGridsThatTheyName) {
  const ResultsPlan plan = made_plan();
  const std::string text = limits_section(plan, made_rows(plan));
  // 36 = 20 + 1 + 15 and 25 = 9 + 1 + 15 dB².
  EXPECT_THAT(text, HasSubstr("What limits *ours, on its own ground, 8 × 5* most is missing angles."));
  EXPECT_THAT(text, HasSubstr("missing angles are 56 %, the truth's noise 3 %, the rest 42 %"));
  EXPECT_THAT(text,
              HasSubstr("What limits *ours, on its own ground, 16 × 6* most is the bake's noise, with its texels"));
  EXPECT_THAT(text, HasSubstr("it is 0.600 with the angles of the grid missing and 0.200 from the own look"));
}

TEST(ResultsCombinations, OfAWayThatIsCloserThanTheOwnLookNoShareIsTold) {
  const ResultsPlan plan = made_plan();
  auto rows = made_rows(plan);
  rows[3] = made_row(rows[3].of, 5.5, 0.2, 100);
  EXPECT_THAT(
      limits_section(plan, rows),
      AllOf(HasSubstr("*ours, on its own ground, 16 × 6* comes closer than the view's own look from as many rays, "
                      "5.00 against 5.50 dB RMS"),
            HasSubstr("So what limits it most is the bake's noise")));
  EXPECT_THAT(verdict(plan, rows),
              HasSubstr("; what limits the best most is the bake's noise, with its texels and mips."));
}

TEST(ResultsCombinations, VerdictIsOfTheBestThePapersAndTheNoiseFloor) {
  const ResultsPlan plan = made_plan();
  auto rows = made_rows(plan);
  EXPECT_THAT(
      verdict(plan, rows),
      AllOf(
          HasSubstr("From the paper's 8 × 5 looks our maps of 4 views that were not baked come to 6.00 dB RMS"),
          HasSubstr("the paper's method to 8.00 dB RMS"),
          HasSubstr("The best maps, *ours, on its own ground, 16 × 6*, come to 5.00 dB RMS"),
          HasSubstr(
              "Two traced maps of a held-out view differ by 2.00 dB, so that no map could be shown to come closer than "
              "1.00 dB; what limits the best most, with about 60 % of its squared error, is the bake's noise"),
          Not(HasSubstr("that were baked they"))));
  ResultsCase best = rows[2].of, paper = rows[0].of;
  best.kind = paper.kind = ViewKind::OnGrid;
  rows.push_back(made_row(best, 1.5, 0.1));
  rows.push_back(made_row(paper, 2.5, 0.1));
  paper.grid = best.grid;
  rows.push_back(made_row(paper, 2.2, 0.1));
  EXPECT_THAT(verdict(plan, rows),
              HasSubstr("At the 4 views that were baked they come to 1.50 dB RMS and a correlation of "
                        "0.900, the paper's from as many looks to 2.20 dB RMS"));
}

TEST(ResultsCombinations, SayNothingWithoutHeldOutViews) {
  const ResultsPlan plan = made_plan();
  const std::vector<ResultsRow> rows{made_row(made_case(plan, Method::Paper, ViewKind::OnGrid), 8.0, 0.8)};
  EXPECT_EQ(combinations_table(plan, rows) + limits_section(plan, rows) + verdict(plan, rows), "");
}

}  // namespace
}  // namespace sigmascape::cli
