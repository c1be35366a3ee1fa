#include "results_combinations.h"

#include <gmock/gmock.h>

#include "made_rows.h"

namespace sigmascape::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

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

TEST(ResultsCombinations, SectionNamesBothAndWhatLimitsThem) {
  const ResultsPlan plan = made_plan();
  const std::string text = combinations_section(plan, made_rows(plan));
  EXPECT_THAT(text, AllOf(HasSubstr("| best in its bytes | ours, on its own ground, 8 × 5 | 0.900 | 6.00 |"),
                          HasSubstr("| best of all | ours, on its own ground, 16 × 6 | 0.900 | 5.00 |"),
                          HasSubstr("| *truth* | one traced map against another | 0.900 | 2.00 |")));
  // 36 = 20 + 1 + 15 and 25 = 9 + 1 + 15 dB².
  EXPECT_THAT(text, HasSubstr("What limits *ours, on its own ground, 8 × 5* most is missing angles."));
  EXPECT_THAT(text, HasSubstr("missing angles are 56 %, the truth's noise 3 %, the rest 42 %"));
  EXPECT_THAT(text, HasSubstr("What limits *ours, on its own ground, 16 × 6* most is what stays"));
}

TEST(ResultsCombinations, SectionIsEmptyWithoutHeldOutViews) {
  const ResultsPlan plan = made_plan();
  const std::vector<ResultsRow> rows{made_row(made_case(plan, Method::Paper, ViewKind::OnGrid), 8.0, 0.8)};
  EXPECT_EQ(combinations_section(plan, rows), "");
}

}  // namespace
}  // namespace sigmascape::cli
