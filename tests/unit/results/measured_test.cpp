#include "results/measured.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "made_rows.h"
#include "scratch_folder.h"

#include "sigmascape/base/error.h"

namespace sigmascape::cli {
namespace {

using testing::HasSubstr;

constexpr double infinite = std::numeric_limits<double>::infinity();

ViewResult made_result(const ResultsPlan& plan, const PlannedView& view, Method method) {
  ViewResult result;
  result.of = made_case(plan, method, view.kind);
  result.view = view;
  result.atlas = {40, 1234567, 7654321, 0.1};
  result.of.change = finest_change;
  result.of.level_of_detail = 2;
  result.comparison.at = {{2.0, 40000, 1.0 / 3.0, 6.02, -0.25, 0.5, 0.75, 11},
                          {8.0, 2500, 0.9, 3.0, 0.125, 0.2, std::nan(""), 0}};
  result.noise_floor.at = {{8.0, 2500, 0.99, 1.0, 0.0, 0.01, 1.0, 0}};
  result.by_level = {{-infinite, -30.0, 7, 1.5}, {-30.0, infinite, 8, 2.5}};
  result.noise_by_level = {{-infinite, infinite, 15, 0.5}};
  result.trace_seconds = 1.25;
  result.render_ms = 2.5;
  if (view.is_repeated) result.without_noise = {.cell_m = 8.0, .cells = 2500, .correlation_db = 0.95, .rms_db = 1.0};
  return result;
}

MeasuredView made_view(const ResultsPlan& plan, const PlannedView& view) {
  return {.scene = plan.scene_name(),
          .view = view,
          .machines = {"a machine"},
          .results = {made_result(plan, view, Method::Paper), made_result(plan, view, Method::OwnGround)}};
}

class MeasuredViewsTest : public testing::Test {
 protected:
  [[nodiscard]] MeasuredViews views(const std::string& name) const {
    return {folder_.path(name), settings_of_views(plan_, "digest")};
  }
  [[nodiscard]] std::string refusal_of(MeasuredViews measured, const std::string& name) const {
    try {
      measured.take_over(folder_.path(name));
    } catch (const Error& error) {
      return error.what();
    }
    return "no refusal";
  }

  ScratchFolder folder_;
  ResultsPlan plan_ = made_plan();
};

// JSON of the results is the numbers that a page is made of.
TEST_F(MeasuredViewsTest, KeepAllThatAPageIsMadeOf) {
  MeasuredViews kept = views("measured.json");
  std::vector<ViewResult> all;
  for (const PlannedView& view : plan_.views) {
    const MeasuredView made = made_view(plan_, view);
    all.insert(all.end(), made.results.begin(), made.results.end());
    kept.add(made);
  }
  MeasuredViews again = views("measured.json");
  again.go_on();
  std::vector<ViewResult> read;
  for (const PlannedView& view : plan_.views) {
    const MeasuredView* found = again.find(plan_.scene_name(), view);
    ASSERT_NE(found, nullptr) << view.description();
    EXPECT_EQ(found->machines, std::vector<std::string>{"a machine"});
    EXPECT_EQ(found->results.front().by_level.front().from_db, -infinite);
    EXPECT_EQ(found->results.front().by_level.back().to_db, infinite);
    read.insert(read.end(), found->results.begin(), found->results.end());
  }
  EXPECT_EQ(results_json(plan_, rows_of(read), read), results_json(plan_, rows_of(all), all));
}

TEST_F(MeasuredViewsTest, AViewIsFoundByAllThatDecidesIt) {
  MeasuredViews kept = views("measured.json");
  const PlannedView& view = plan_.views.front();
  kept.add(made_view(plan_, view));
  EXPECT_NE(kept.find(plan_.scene_name(), view), nullptr);
  EXPECT_EQ(kept.find("level", view), nullptr);
  EXPECT_EQ(kept.find(plan_.scene_name(), view.from_afar()), nullptr);
  EXPECT_EQ(kept.find(plan_.scene_name(), plan_.views.back()), nullptr);
}

TEST_F(MeasuredViewsTest, AnotherRunsAreTakenOverAndKept) {
  MeasuredViews other = views("other.json");
  other.add(made_view(plan_, plan_.views.front()));
  MeasuredViews here = views("here.json");
  here.add(made_view(plan_, plan_.views.back()));
  here.take_over(folder_.path("other.json"));
  here.write();
  MeasuredViews again = views("here.json");
  again.go_on();
  EXPECT_NE(again.find(plan_.scene_name(), plan_.views.front()), nullptr);
  EXPECT_NE(again.find(plan_.scene_name(), plan_.views.back()), nullptr);
  // Beside a page lie its own alone.
  const MeasuredView* const told = again.find(plan_.scene_name(), plan_.views.back());
  again.write(folder_.path("told.json"), std::vector<const MeasuredView*>{told});
  EXPECT_EQ(results_kept_in(folder_.path("told.json")).size(), told->results.size());
}

TEST_F(MeasuredViewsTest, AViewIsMeasuredAnewWithMoreRaysWhileOthersStay) {
  MeasuredViews kept = views("measured.json");
  kept.add(made_view(plan_, plan_.views.front()));
  kept.add(made_view(plan_, plan_.views.back()));
  PlannedView finer = plan_.views.back();
  finer.traced_samples *= 5;
  EXPECT_EQ(kept.find(plan_.scene_name(), finer), nullptr);
  kept.add(made_view(plan_, finer));
  MeasuredViews again = views("measured.json");
  again.go_on();
  for (const PlannedView& wanted : {finer, plan_.views.back()}) {
    const MeasuredView* found = again.find(plan_.scene_name(), wanted);
    ASSERT_NE(found, nullptr) << "more rays than wanted are enough";
    EXPECT_EQ(found->view.traced_samples, finer.traced_samples) << "a page has each view once";
  }
  EXPECT_NE(again.find(plan_.scene_name(), plan_.views.front()), nullptr);
}

// Their looks are baked with as many rays as their maps are traced with, so that more are another measurement.
TEST_F(MeasuredViewsTest, AViewOnTheGridIsFoundByItsOwnRaysAlone) {
  MeasuredViews kept = views("measured.json");
  PlannedView on_grid = plan_.views.front();
  on_grid.kind = ViewKind::OnGrid;
  PlannedView fewer = on_grid;
  fewer.traced_samples /= 2;
  kept.add(made_view(plan_, on_grid));
  EXPECT_NE(kept.find(plan_.scene_name(), on_grid), nullptr);
  EXPECT_EQ(kept.find(plan_.scene_name(), fewer), nullptr);
}

TEST_F(MeasuredViewsTest, OfTwoRunsEachViewIsThatWithMoreRays) {
  PlannedView finer = plan_.views.back();
  finer.traced_samples *= 5;
  MeasuredViews few = views("few.json"), many = views("many.json");
  few.add(made_view(plan_, plan_.views.back()));
  many.add(made_view(plan_, finer));
  few.take_over(folder_.path("many.json"));
  many.take_over(folder_.path("few.json"));
  for (const MeasuredViews* either : {&few, &many}) {
    const MeasuredView* found = either->find(plan_.scene_name(), plan_.views.back());
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->view.traced_samples, finer.traced_samples);
  }
}

/// On the grid, where looks are baked again with as many rays, each number of rays is a measurement of its own.
TEST_F(MeasuredViewsTest, OfTwoRunsViewsOnTheGridAreKeptFromBoth) {
  const auto place = std::ranges::find(plan_.views, ViewKind::OnGrid, &PlannedView::kind);
  ASSERT_NE(place, plan_.views.end());
  PlannedView finer = *place;
  finer.traced_samples *= 5;
  MeasuredViews few = views("few.json"), many = views("many.json");
  few.add(made_view(plan_, *place));
  many.add(made_view(plan_, finer));
  many.take_over(folder_.path("few.json"));
  EXPECT_NE(many.find(plan_.scene_name(), finer), nullptr);
  EXPECT_NE(many.find(plan_.scene_name(), *place), nullptr);
}

TEST_F(MeasuredViewsTest, WhatDoesNotFitIsRefusedOrWrittenOver) {
  MeasuredViews kept = views("measured.json");
  kept.add(made_view(plan_, plan_.views.front()));
  ResultsPlan fewer = plan_;
  fewer.bounces = 3;
  const auto settings = settings_of_views(fewer, "digest");
  EXPECT_THAT(refusal_of({folder_.path("x.json"), settings}, "measured.json"),
              HasSubstr("was measured with bounces 8, not 3"));
  EXPECT_THAT(refusal_of({folder_.path("x.json"), settings_of_views(plan_, "another")}, "measured.json"),
              HasSubstr("was measured with scene"));
  EXPECT_THAT(refusal_of(views("x.json"), "absent.json"), HasSubstr("cannot be read"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("x.json"))) << "nothing was taken over";
  MeasuredViews anew(folder_.path("measured.json"), settings);
  anew.go_on();
  EXPECT_EQ(anew.find(plan_.scene_name(), plan_.views.front()), nullptr);
}

TEST_F(MeasuredViewsTest, ResultsOfAnotherRunAreReadWhateverItsSettings) {
  ResultsPlan other = plan_;
  other.bounces = 3;
  MeasuredViews kept{folder_.path("other.json"), settings_of_views(other, "another")};
  kept.add(made_view(plan_, plan_.views.front()));
  const auto results = results_kept_in(folder_.path("other.json"));
  const auto made = made_view(plan_, plan_.views.front()).results;
  EXPECT_EQ(results_json(plan_, rows_of(results), results), results_json(plan_, rows_of(made), made));
}

TEST_F(MeasuredViewsTest, NoResultsAreReadFromWhatIsAbsentDamagedOrOfAnotherForm) {
  EXPECT_TRUE(results_kept_in(folder_.path("absent.json")).empty());
  for (const char* text :
       {"", "{}", "[1, 2", R"({"settings": 1, "views": 2})", R"({"settings": {"form": 4}, "views": []})"})
    EXPECT_TRUE(results_kept_in(folder_.write("damaged.json", text)).empty()) << text;
  auto settings = settings_of_views(plan_, "digest");
  settings["form"] = settings.at("form").get<int>() - 1;
  MeasuredViews kept{folder_.path("older.json"), settings};
  kept.add(made_view(plan_, plan_.views.front()));
  EXPECT_TRUE(results_kept_in(folder_.path("older.json")).empty());
}

// Maps of fewer rays are traced from now on; views that were measured without them stay as they are.
TEST_F(MeasuredViewsTest, AViewIsKeptWithWhicheverFewRaysItWasTraced) {
  MeasuredViews kept = views("measured.json");
  MeasuredView old = made_view(plan_, plan_.views.front());
  for (const std::uint32_t samples : {16U, 64U, 256U}) {
    ViewResult& traced = old.results.emplace_back(made_result(plan_, plan_.views.front(), Method::Traced));
    traced.of.baked_samples = samples;
  }
  kept.add(old);
  MeasuredViews again = views("measured.json");
  again.go_on();
  const MeasuredView* found = again.find(plan_.scene_name(), plan_.views.front());
  ASSERT_NE(found, nullptr) << "it would be measured anew";
  EXPECT_EQ(found->results.size(), old.results.size());
}

TEST_F(MeasuredViewsTest, ADamagedFileIsNamed) {
  for (const char* text : {"", "{}", "[1, 2", R"({"settings": 1, "views": 2})"}) {
    folder_.write("damaged.json", text);
    EXPECT_THAT(refusal_of(views("x.json"), "damaged.json"), HasSubstr("damaged.json")) << text;
  }
}

}  // namespace
}  // namespace sigmascape::cli
