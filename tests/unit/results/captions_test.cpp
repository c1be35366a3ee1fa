#include "results/captions.h"

#include <gmock/gmock.h>

#include "made_rows.h"

namespace sigmascape::cli {
namespace {

/// Of the paper's method at the view of Figure 8.
ViewResult paper_result(const ResultsPlan& plan) {
  ViewResult result{.of = made_case(plan, Method::Paper, ViewKind::Paper),
                    .view = plan.views.front(),
                    .atlas = {.looks = 40, .store_bytes = 26'840'000, .memory_bytes = 35'790'000},
                    .comparison = {},
                    .noise_floor = {},
                    .by_level = {},
                    .noise_by_level = {},
                    .trace_seconds = 19.49,
                    .render_ms = 128.0};
  result.comparison.at = {{.cell_m = summary_cell_m, .correlation_db = 0.82, .rms_db = 8.6}};
  return result;
}

TEST(ResultsCaptions, SayHowCloseAMapComesAndWhatItTakes) {
  ViewResult view = paper_result(made_plan());
  EXPECT_EQ(caption_of(view),
            "paper, 8 × 5: correlation 0.820, 8.60 dB RMS at 8 m cells; 0.13 s, 26.84 MB stored, 35.79 MB in memory");
  view.noise_floor.at = {{.cell_m = summary_cell_m, .correlation_db = 0.985, .rms_db = 1.79}};
  EXPECT_THAT(caption_of(view), ::testing::HasSubstr("8.60 dB RMS at 8 m cells (two traced maps: 1.79 dB); 0.13 s"));
  view.comparison.at.clear();
  EXPECT_EQ(caption_of(view), "paper, 8 × 5: 0.13 s, 26.84 MB stored, 35.79 MB in memory") << "maps too small";
}

TEST(ResultsCaptions, SayWhatTheTracedMapTakes) {
  ViewResult view = paper_result(made_plan());
  view.view.traced_samples = 512;
  EXPECT_EQ(traced_caption(view, 1'640'000),
            "Path-traced from the full scene, the mean of two maps: 19.5 s for each of 512 rays a cell, 1.64 MB of "
            "acceleration structures in memory");
}

TEST(ResultsCaptions, AreOfTheViewWithWhateverRaysItWasTraced) {
  const ResultsPlan plan = made_plan();
  ViewResult changed = paper_result(plan), elsewhere = changed, wanted = changed;
  changed.of.change = halves_change;
  elsewhere.view.azimuth_deg += 1.0;
  wanted.view.traced_samples *= 4;
  const std::vector<ViewResult> views{changed, elsewhere, wanted};
  const std::string grid = plan.paper_grid().name();
  EXPECT_EQ(find_view(views, plan, plan.views.front(), Method::Paper, grid), &views[2]);
  EXPECT_EQ(find_view(views, plan, plan.views.front(), Method::OwnGround, grid), nullptr);
}

}  // namespace
}  // namespace sigmascape::cli
