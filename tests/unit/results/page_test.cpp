#include "results/page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <tuple>
#include <utility>

#include "made_report.h"

namespace sigmascape::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Of the paper's method at a held-out view, with nothing measured.
ViewResult unmeasured_view() {
  return {.of = made_case(made_plan(), Method::Paper, ViewKind::HeldOut),
          .view = {},
          .atlas = {},
          .comparison = {},
          .noise_floor = {},
          .by_level = {},
          .noise_by_level = {}};
}

TEST(ResultsPage, OpensWithTheVerdictTheFirstTableItsSpeedAndItsLimitsBeforeWordsAndFigures) {
  ResultsReport report = made_report(true);
  ResultsCase traced{.scene = report.plan.scene_name(), .method = Method::Traced, .grid = {}, .baked_samples = 16};
  ResultsCase look = made_case(report.plan, Method::OwnGround, ViewKind::HeldOut);
  look.grid = own_look;
  for (const ResultsCase& of : {traced, look}) report.rows.push_back(made_row(of, 4.0, 0.4));
  const std::string page = results_markdown(report);
  EXPECT_THAT(page, StartsWith("# How close the baked map is: Harbour\n"));
  std::size_t last = 0;
  for (const char* part : {"Maps rendered from baked textures",
                           "Such a map takes",
                           "Visina",
                           "its Figures 5 to 8",
                           "[Bilbao](../bilbao/README.md)",
                           "| *truth* |",
                           "\n## What tracing to the same error takes",
                           "\n## What limits the best of them",
                           "\n## The words of this page",
                           "## Figures 5 and 6",
                           "## How it was measured",
                           "## Every method and grid of looks, at 8 m cells",
                           "## Why",
                           "## Cheap wins",
                           "## Error by angle, bytes and cell size",
                           "## By cell size",
                           "## Bytes and time",
                           "## Settings",
                           "<details>",
                           "| view | azimuth"}) {
    const std::size_t place = page.find(part, last);
    EXPECT_NE(place, std::string::npos) << part << " is missing or not where it should be";
    if (place != std::string::npos) last = place;
  }
  EXPECT_THAT(page, Not(HasSubstr("](README.md)"))) << "a page links to itself";
}

TEST(ResultsPage, SharesRowsOfGridsThatAllNumbersAreTheSameFrom) {
  const std::string page = results_markdown(made_report(true));
  EXPECT_THAT(page, HasSubstr("| on grid (4) | paper | 8 × 4; 8 × 5 | 0.900 (0.900) | 8.00 (8.00) |"));
  EXPECT_THAT(page, HasSubstr("| 1.00; 2.00 |"));
  EXPECT_THAT(page, HasSubstr("| held out (4) | paper | 8 × 4 | 0.900 (0.900) | 9.00 (9.00) |"));
  EXPECT_THAT(page, HasSubstr("| held out (4) | paper | 8 × 5 | 0.900 (0.900) | 8.00 (8.00) |"));
}

TEST(ResultsPage, NamesScenesOnlyWhereThereAreTwo) {
  EXPECT_THAT(results_markdown(made_report(false)), HasSubstr("| hills | on grid (4) | paper |"));
  EXPECT_THAT(results_markdown(made_report(true)), Not(HasSubstr("place |")));
}

TEST(ResultsPage, SaysWhyItIsNotTheWholeOfThePapersScene) {
  EXPECT_THAT(results_markdown(made_report(false)),
              HasSubstr("a scene made up after the paper's, 400 m a side instead of the paper's 2 km "
                        "([why](../../decisions/0134-pages-of-four-hundred-metres.md))"));
  ResultsReport whole = made_report(false);
  whole.plan.scale = 1.0;
  EXPECT_THAT(results_markdown(whole), HasSubstr("a scene made up after the paper's, 2000 m a side, with"));
}

TEST(ResultsPage, HasEveryGridByCellSizeFoldedAway) {
  const std::string page = results_markdown(made_report(true));
  const std::size_t folded = page.find("<summary>The same from every grid of looks</summary>");
  ASSERT_NE(folded, std::string::npos);
  for (const auto& [looks, rms, store] : {std::tuple("8 × 4", "9.00", "1.00"), {"8 × 5", "8.00", "2.00"}}) {
    const std::size_t line =
        page.find(fmt::format("| held out | paper | {} | 8 | 0.900 (0.900) | {}", looks, rms), folded);
    ASSERT_NE(line, std::string::npos) << looks;
    EXPECT_THAT(page.substr(line, page.find('\n', line) - line), HasSubstr(fmt::format("| {} | ", store)));
  }
  EXPECT_EQ(page.find("| held out | paper | 8 × 4 | 8 |"), page.find("| held out | paper | 8 × 4 | 8 |", folded))
      << "in the open table stands the paper's grid alone";
}

TEST(ResultsPage, HasTimeAndMemoryOfTracingBesideThoseOfMaps) {
  ResultsReport report = made_report(true);
  for (ResultsRow& row : report.rows) {
    row.trace_seconds = 19.49;
    row.render_ms = 128.0;
    row.atlas.looks = 40;
    row.atlas.memory_bytes = 35'790'000;
    row.atlas.bake_seconds = 100.0;
  }
  ResultsCase usual = made_case(report.plan, Method::OwnGround, ViewKind::HeldOut), traced = usual;
  usual.baked_samples = 0;
  usual.change = adaptive_change;
  traced.method = Method::Traced;
  for (const ResultsCase& of : {usual, traced}) report.rows.push_back(made_row(of, 4.0, 0.4));
  const std::string page = results_markdown(report);
  EXPECT_THAT(page, HasSubstr("| ours, on its own ground, rays where the noise is | 8 × 5 | "));
  EXPECT_THAT(page, Not(HasSubstr("| path-traced | 8 × 5 | "))) << "few rays are no grid";
  EXPECT_THAT(page, HasSubstr("| *path-traced*, 1024 rays a cell | | | | 1.00 | | | 19.5 |"));
  EXPECT_THAT(page, HasSubstr("| paper | 8 × 5 | 40 | 2.00 | 35.79 | 100 | 2.5 | 0.128 |"));
  EXPECT_THAT(page, HasSubstr("the scene has 1000 within the square"));
}

TEST(ResultsPage, PlotsHaveTheLeastErrorThatCanBeShown) {
  ResultsReport report = made_report(false);
  ViewResult view{.of = made_case(report.plan, Method::Paper, ViewKind::HeldOut),
                  .view = report.plan.views.back(),
                  .atlas = {},
                  .comparison = {},
                  .noise_floor = {},
                  .by_level = {},
                  .noise_by_level = {}};
  view.comparison.at = {{.cell_m = summary_cell_m, .rms_db = 5.0}};
  report.views = {view};
  for (const auto& [name, plot] : plots_of(report)) {
    const PlotSeries& floor = plot.series.back();
    EXPECT_EQ(floor.name, "least that can be shown") << name;
    ASSERT_FALSE(floor.points.empty()) << name;
    for (const auto& [x, rms_db] : floor.points)
      EXPECT_EQ(rms_db, 1.0) << name << ", half of what two traced maps differ by";
  }
}

TEST(ResultsPage, PlotOfBytesHasTheDefaultBakeAndTheGridsOfItsPoints) {
  ResultsReport report = made_report(true);
  ResultsCase usual = made_case(report.plan, Method::OwnGround, ViewKind::HeldOut);
  usual.baked_samples = 0;
  usual.change = adaptive_change;
  report.rows.push_back(made_row(usual, 4.5, 0.4, 3'000'000));
  const auto plots = plots_of(report);
  const Plot& plot = plots.at(1).second;
  ASSERT_EQ(plots.at(1).first, "error_by_bytes.svg");
  const auto series_of = [&](const std::string& name) {
    return std::ranges::find(plot.series, name, &PlotSeries::name);
  };
  const auto ours = series_of("ours, on its own ground"), as_usual = series_of("the same, rays where the noise is");
  ASSERT_NE(ours, plot.series.end());
  ASSERT_NE(as_usual, plot.series.end());
  EXPECT_EQ(ours->labels, (std::vector<std::string>{"8 × 4", "8 × 5"}));
  EXPECT_EQ(as_usual->points, (std::vector{std::pair(3.0, 4.5)}));
}

TEST(ResultsPage, NamesTheGridThatDistancesAreFrom) {
  const ResultsReport report = made_report(true);
  EXPECT_THAT(plots_of(report).front().second.title, HasSubstr("nearest look of the 8 × 5 grid"));
  EXPECT_THAT(results_markdown(report), HasSubstr("| from the nearest look of 8 × 5 [°] |"));
}

TEST(ResultsPage, SaysAtHowManyViewsAnAimIsReached) {
  ResultsReport report = made_report(true);
  ResultsRow& ours = report.rows[3];
  ASSERT_EQ(ours.of, made_case(report.plan, Method::OwnGround, ViewKind::OnGrid));
  ours.cells.front().median.correlation_db = 0.955;
  ours.cells.front().worst.bias_db = 1.31;
  const auto with_biases_db = [&](const std::array<double, 4>& biases_db) {
    for (std::size_t view = 0; view < biases_db.size(); ++view) ours.at_views[view].tested.bias_db = biases_db[view];
    return results_markdown(report);
  };
  for (const auto& [view, correlation] : {std::pair(0U, 0.93), {1U, 0.95}, {2U, 0.96}, {3U, 0.97}})
    ours.at_views[view].tested.correlation_db = correlation;
  EXPECT_THAT(with_biases_db({1.31, -0.67, 0.3, -0.4}),
              HasSubstr("| 0.955 | 0.95 | reached, 3 of 4 | 0.00 (+1.31) | ±0.3 | missed, 1 of 4 |"))
      << "biases of opposite signs do not make up for one another";
  EXPECT_THAT(with_biases_db({1.31, -0.38, 0.2, 0.1}), HasSubstr("| ±0.3 | reached, 2 of 4 |"))
      << "of two views in the middle the mean counts";
}

TEST(ResultsPage, SaysWhereBakesAreOfMorePatchesThanOne) {
  EXPECT_THAT(results_markdown(made_report(true)), HasSubstr("the square lies on 4 patches of 500 m"));
  ResultsReport one = made_report(true);
  one.patches = 1;
  EXPECT_THAT(results_markdown(one), Not(HasSubstr("patches of 500 m")));
}

TEST(ResultsPage, SaysNoOverlapOfFewCellsInShadow) {
  ViewResult view = unmeasured_view();
  const auto iou_of = [&](std::vector<std::size_t> shadow_cells) {
    std::vector<ViewResult> views;
    for (const std::size_t cells : shadow_cells) {
      view.comparison.at =
          view.noise_floor.at = {{.cell_m = 8.0, .shadow_iou = cells < 20 ? 0.0 : 0.6, .shadow_cells = cells}};
      views.push_back(view);
    }
    return rows_of(views).front().cells.front().median.shadow_iou;
  };
  EXPECT_TRUE(std::isnan(iou_of({0, product::least_shadow_cells - 1})));
  EXPECT_EQ(iou_of({product::least_shadow_cells}), 0.0);
  EXPECT_EQ(iou_of({0, 1, 2, 30}), 0.6) << "views without shadow have no part in the median";
}

TEST(ResultsPage, TracedMapsDecideWhichViewsHaveShadows) {
  std::vector<ViewResult> views;
  for (const auto& [traced_cells, overlap] : {std::pair{product::least_shadow_cells, 0.5}, {std::size_t{0}, 0.0}}) {
    ViewResult& view = views.emplace_back(unmeasured_view());
    view.noise_floor.at = {{.cell_m = 8.0, .shadow_iou = 0.8, .shadow_cells = traced_cells}};
    view.comparison.at = {{.cell_m = 8.0, .shadow_iou = overlap, .shadow_cells = 100}};
  }
  const ResultsCell cell = rows_of(views).front().cells.front();
  EXPECT_EQ(cell.median.shadow_iou, 0.5);
  EXPECT_EQ(cell.worst.shadow_iou, 0.5);
}

TEST(ResultsPage, CountsViewsThatAgreeAndTimesMapsOfAllViewsByAsManyRays) {
  std::vector<ViewResult> views;
  for (const auto& [rays, seconds, agreement] :
       {std::tuple{100U, 10.0, 0.98}, {600U, 66.0, least_agreement}, {100U, 12.0, 0.9899}}) {
    ViewResult& view = views.emplace_back(unmeasured_view());
    view.view.traced_samples = rays;
    view.trace_seconds = seconds;
    view.comparison.at = view.noise_floor.at = {{.cell_m = summary_cell_m, .correlation_db = agreement}};
  }
  const ResultsRow row = rows_of(views).front();
  EXPECT_EQ(row.agreeing_views, 1U);
  EXPECT_EQ(row.rays.text(), "100 to 600");
  EXPECT_DOUBLE_EQ(row.trace_seconds, 11.0);
  EXPECT_EQ((TracedRays{100, 100}).text(), "100");
}

}  // namespace
}  // namespace sigmascape::cli
