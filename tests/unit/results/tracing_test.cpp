#include "results/tracing.h"

#include <gmock/gmock.h>

#include "made_rows.h"

namespace sigmascape::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

ResultsRow traced_row(const ResultsPlan& plan, std::uint32_t samples, double rms_db, double milliseconds) {
  ResultsRow row = made_row(
      {.scene = plan.scene_name(), .method = Method::Traced, .grid = {}, .baked_samples = samples}, rms_db, 0.5);
  row.render_ms = milliseconds;
  return row;
}

ResultsRow baked_row(const ResultsPlan& plan, double rms_db, double milliseconds, double bake_seconds) {
  ResultsRow row = made_row(made_case(plan, Method::OwnGround, ViewKind::HeldOut), rms_db, 0.5);
  row.render_ms = milliseconds;
  row.atlas.bake_seconds = bake_seconds;
  return row;
}

TEST(ResultsTracing, SaysFromHowManyMapsOnABakePays) {
  const ResultsPlan plan = made_plan();
  // 95 s of bake, and 2.0 − 0.1 s saved by every map.
  const std::string text =
      tracing_section(plan, {traced_row(plan, 16, 8.0, 500.0), traced_row(plan, 64, 4.0, 2000.0),
                             traced_row(plan, 256, 2.0, 8000.0), baked_row(plan, 5.0, 100.0, 95.0)});
  EXPECT_THAT(text,
              AllOf(HasSubstr("| path-traced |  | 16 | 0.900 (0.900) | 8.00 (8.00) |"),
                    HasSubstr("- ours, on its own ground, 8 × 5: 5.00 dB in 0.10 s. Of the traced maps that of 64 "
                              "rays a cell comes as close, 4.00 dB in 2.0 s, 20.0 times as long: from 50 maps on "
                              "the bake is the shorter way\n")));
}

TEST(ResultsTracing, SaysWhereNoneOfTheTracedMapsComesAsClose) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(
      tracing_section(plan, {traced_row(plan, 256, 3.0, 8000.0), baked_row(plan, 2.0, 100.0, 95.0)}),
      HasSubstr("None of these traced maps comes as close, that of 256 rays takes 8.0 s, 80.0 times as long\n"));
}

TEST(ResultsTracing, SaysNoNumberOfMapsWhereTracingTakesLess) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(tracing_section(plan, {traced_row(plan, 16, 3.0, 50.0), baked_row(plan, 5.0, 100.0, 95.0)}),
              HasSubstr("3.00 dB in 0.1 s, 0.5 times as long\n"));
}

TEST(ResultsTracing, IsSilentWithoutTracedMaps) {
  const ResultsPlan plan = made_plan();
  EXPECT_EQ(tracing_section(plan, {baked_row(plan, 5.0, 100.0, 95.0)}), "");
}

}  // namespace
}  // namespace sigmascape::cli
