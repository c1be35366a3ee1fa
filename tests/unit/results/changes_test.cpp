#include "results/changes.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <tuple>

#include "bake_options.h"
#include "made_rows.h"

namespace sigmascape::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Ours from the paper's grid, from more elevations, from more azimuths and from both.
std::vector<ResultsRow> rows_of_grids(const ResultsPlan& plan, double with_elevations_db, double with_azimuths_db) {
  const ResultsCase own = made_case(plan, Method::OwnGround, ViewKind::HeldOut);
  ResultsCase elevations = own, azimuths = own, both = own;
  elevations.grid = plan.more_elevations().name();
  azimuths.grid = plan.more_azimuths().name();
  both.grid = plan.next_grid().name();
  std::vector<ResultsRow> rows{
      made_row(own, 6.0, 0.5, 10'000'000), made_row(elevations, with_elevations_db, 0.5, 12'000'000),
      made_row(azimuths, with_azimuths_db, 0.5, 20'000'000), made_row(both, 3.0, 0.2, 25'000'000)};
  rows.front().atlas.bake_seconds = 100.0;
  rows.back().atlas.bake_seconds = 240.0;
  return rows;
}

TEST(ResultsChanges, GridOfTheTablesIsWhatIsBakedByDefault) {
  const BakeOptions usual;
  const LookGrid grid = made_plan().paper_grid();
  EXPECT_EQ(grid.azimuths, usual.azimuths);
  EXPECT_EQ(grid.elevations_deg, usual.elevations_deg);
}

TEST(ResultsChanges, SayWhatTheNextGridTakesAndGives) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(
      worth_of_looks(plan, rows_of_grids(plan, 5.8, 4.0)),
      AllOf(HasSubstr(
                "More azimuths, 16 × 5 looks, take 2.00 dB off the RMS error for 10.00 MB more: 0.200 dB a megabyte."),
            HasSubstr("`sigmascape bake` takes 8 × 5 looks by default. 16 × 6 looks (`--azimuths 16 "
                      "--elevations-deg 5,9,13,21,29,37`) take 2.5 times the bytes, 25.00 instead of 10.00 MB, "
                      "and 2.4 times the processor time of the bake, 240 instead of 100 s, for an RMS error of "
                      "3.00 instead of 6.00 dB, 50 % less")));
}

TEST(ResultsChanges, ChooseWhatTakesClearlyMoreOffForAMegabyteFirst) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(worth_of_looks(plan, rows_of_grids(plan, 5.9, 4.0)), HasSubstr("azimuths first, 16 × 5"));
  EXPECT_THAT(worth_of_looks(plan, rows_of_grids(plan, 5.0, 5.9)), HasSubstr("elevations first, 8 × 6"));
  EXPECT_THAT(worth_of_looks(plan, rows_of_grids(plan, 5.6, 4.0)),
              HasSubstr("elevations and azimuths together, 16 × 6"));
}

TEST(ResultsChanges, ChooseNoLooksThatMakeMapsWorse) {
  const ResultsPlan plan = made_plan();
  auto rows = rows_of_grids(plan, 6.2, 6.1);
  rows.back() = made_row(rows.back().of, 6.3, 0.5, 25'000'000);
  const std::string text = worth_of_looks(plan, rows);
  EXPECT_THAT(text, AllOf(HasSubstr("More azimuths, 16 × 5 looks, add 0.10 dB to the RMS error"), HasSubstr("5 % more"),
                          HasSubstr("more looks bring nothing here")));
}

TEST(ResultsChanges, SayOfEachWhetherItWasKept) {
  const ResultsPlan plan = made_plan();
  for (const Change& change : changes(plan)) EXPECT_FALSE(change.kept.empty()) << change.contrast.name;
  auto rows = rows_of_grids(plan, 5.8, 4.0);
  ResultsCase bound = rows[0].of;
  bound.change = renormalized_change;
  rows.push_back(made_row(bound, 5.0, 0.4, 10'000'000));
  EXPECT_THAT(changes_table(plan, rows), HasSubstr("| a bound: needs the map from 16 × 6 |"));
}

// Two medians may be of different views: what a change brings is told view by view.
TEST(ResultsChanges, AreWeighedViewByView) {
  const ResultsPlan plan = made_plan();
  ResultsRow before = made_row(made_case(plan, Method::LevelGround, ViewKind::HeldOut), 5.0, 0.5);
  ResultsRow after = made_row(made_case(plan, Method::OwnGround, ViewKind::HeldOut), 6.0, 0.5);
  for (const auto& [view, before_db, after_db] : {std::tuple(0U, 2.0, 1.9), {1U, 5.0, 6.1}, {2U, 5.0, 4.9}}) {
    before.at_views[view].tested.rms_db = before_db;
    after.at_views[view].tested.rms_db = after_db;
  }
  before.at_views.pop_back();
  std::ranges::reverse(after.at_views);
  const PairedFall fall = fall_between(before, after, &product::CellComparison::rms_db);
  EXPECT_EQ(fall.views, 3U) << "of a view that only one was measured at there is no difference";
  EXPECT_EQ(fall.better, 2U);
  EXPECT_NEAR(fall.mean, -0.3, 1e-12);
  EXPECT_NEAR(fall.median, 0.1, 1e-12);
  EXPECT_THAT(changes_table(plan, {before, after}), HasSubstr("| -0.30 | 2 of 3 | kept, costs here |\n"));
}

TEST(ResultsChanges, SayOfWhatWasKeptWhereItPaysLittle) {
  const ResultsPlan plan = made_plan();
  const auto table = [&](double before_db, double after_db) {
    return changes_table(plan, {made_row(made_case(plan, Method::LevelGround, ViewKind::HeldOut), before_db, 0.5),
                                made_row(made_case(plan, Method::OwnGround, ViewKind::HeldOut), after_db, 0.5)});
  };
  EXPECT_THAT(table(6.0, 5.0), HasSubstr("| kept |\n"));
  EXPECT_THAT(table(6.0, 5.99), HasSubstr("| kept, pays little here |\n"));
}

}  // namespace
}  // namespace sigmascape::cli
