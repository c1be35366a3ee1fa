#include "results/tracing.h"

#include <gmock/gmock.h>
#include <utility>

#include "made_rows.h"
#include "words.h"

namespace sigmascape::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

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
  // 95 s of bake, and 2.0 − 0.1 s saved by every map, or 0.5 − 0.1 s.
  const std::string text =
      tracing_section(plan, {traced_row(plan, 16, 8.0, 500.0), traced_row(plan, 64, 4.0, 2000.0),
                             traced_row(plan, 256, 2.0, 8000.0), baked_row(plan, 5.0, 100.0, 95.0)});
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("| path-traced |  | 16 | 0.900 (0.900) | 8.00 (8.00) |"),
            HasSubstr("- ours, on its own ground, 8 × 5: 5.00 dB in 0.10 s. A traced map as close takes between "
                      "0.50 s and 2.0 s, 5.0 to 20 times as long: with 16 rays a cell it has 8.00 dB, with 64 4.00 "
                      "dB; from 50 to 238 maps on the bake is the shorter way\n")));
}

TEST(ResultsTracing, SaysWhereNoneOfTheTracedMapsComesAsClose) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(tracing_section(plan, {traced_row(plan, 256, 3.0, 8000.0), baked_row(plan, 2.0, 100.0, 95.0)}),
              HasSubstr("None of these traced maps comes as close: that of 256 rays a cell has 3.00 dB in 8.0 s, 80 "
                        "times as long\n"));
}

TEST(ResultsTracing, SaysNoNumberOfMapsWhereTracingTakesLess) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(
      tracing_section(
          plan, {traced_row(plan, 4, 8.0, 20.0), traced_row(plan, 16, 3.0, 50.0), baked_row(plan, 5.0, 100.0, 95.0)}),
      HasSubstr("0.20 to 0.50 times as long: with 4 rays a cell it has 8.00 dB, with 16 3.00 dB: here the bake does "
                "not pay\n"));
}

TEST(ResultsTracing, SaysTheLeastNumberOfMapsWhereTracingMayTakeLess) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(tracing_section(plan, {traced_row(plan, 4, 8.0, 50.0), traced_row(plan, 16, 3.0, 2000.0),
                                     baked_row(plan, 5.0, 100.0, 95.0)}),
              HasSubstr("; from 50 maps on at the earliest the bake is the shorter way\n"));
}

// Where 16 rays do, 2 may: what a bake saves is not known, and a number of maps would be too small.
TEST(ResultsTracing, SaysNoRatioWhereTheFewestRaysThatWereTracedAreEnough) {
  const ResultsPlan plan = made_plan();
  EXPECT_THAT(tracing_section(plan, {traced_row(plan, 16, 3.0, 1900.0), traced_row(plan, 64, 2.0, 8000.0),
                                     baked_row(plan, 5.0, 400.0, 95.0)}),
              AllOf(HasSubstr("16 rays a cell is closer already, 3.00 dB in 1.9 s, and fewer were not traced\n"),
                    Not(HasSubstr("times as long")), Not(HasSubstr("shorter way"))));
}

TEST(ResultsTracing, ThereAreNoFewerRaysThanOne) {
  const ResultsPlan plan = made_plan();
  const auto said_of_one_ray = [&](double milliseconds) {
    return tracing_section(plan, {traced_row(plan, 1, 3.0, milliseconds), baked_row(plan, 5.0, 400.0, 96.0)});
  };
  EXPECT_THAT(said_of_one_ray(2000.0), HasSubstr("a single ray a cell is closer, 3.00 dB in 2.0 s, 5.0 times as long; "
                                                 "from 60 maps on the bake is the shorter way\n"));
  EXPECT_THAT(said_of_one_ray(200.0), HasSubstr("0.50 times as long: here the bake does not pay\n"));
}

TEST(ResultsTracing, HasTheTruthBesideTheErrors) {
  const ResultsPlan plan = made_plan();
  ResultsRow traced = traced_row(plan, 16, 8.0, 500.0);
  traced.trace_seconds = 81.2;
  const std::string text = tracing_section(plan, {traced});
  EXPECT_THAT(text, HasSubstr("| *truth* | | 1024 to 6144 | 0.900 (0.900) | 2.00 (2.00) |"));
  EXPECT_THAT(text, HasSubstr("| 81 with 1024 |\n"));
}

// Views that were measured before maps of so few rays were have none.
TEST(ResultsTracing, LeavesOutRaysThatOnlySomeOfTheViewsWereTracedWith) {
  const ResultsPlan plan = made_plan();
  ResultsRow some = traced_row(plan, 4, 4.0, 300.0);
  some.views = 3;
  const std::string text =
      tracing_section(plan, {some, traced_row(plan, 16, 3.0, 1900.0), baked_row(plan, 5.0, 400.0, 95.0)});
  EXPECT_THAT(text, AllOf(Not(HasSubstr("| path-traced |  | 4 |")), HasSubstr("of 16 rays a cell is closer already")));
}

TEST(ResultsTracing, IsSilentWithoutTracedMaps) {
  const ResultsPlan plan = made_plan();
  EXPECT_EQ(tracing_section(plan, {baked_row(plan, 5.0, 100.0, 95.0)}), "");
}

TEST(ResultsTracing, SpeedIsToldAtEqualError) {
  const ResultsPlan plan = made_plan();
  const auto said_beside = [&](const ResultsRow& few, const ResultsRow& more, double rms_db) {
    const ResultsRow way = baked_row(plan, rms_db, 360.0, 95.0);
    return speed_at_equal_error(plan, {few, more, way}, way);
  };
  const ResultsRow few = traced_row(plan, 64, 4.0, 3900.0), more = traced_row(plan, 256, 2.0, 15480.0);
  EXPECT_EQ(
      said_beside(few, more, 2.5),
      "takes 0.36 s of processor time, a path-traced one as close between 3.9 s and 15 s, 11 to 43 times as long: "
      "64 rays a cell are too few, 256 more than enough.");
  EXPECT_THAT(said_beside(traced_row(plan, 1, 4.0, 500.0), traced_row(plan, 4, 2.0, 900.0), 2.5),
              HasSubstr("1 ray a cell is too few, 4 more than enough."));
  EXPECT_EQ(said_beside(few, more, 5.0),
            "takes 0.36 s of processor time; a path-traced one of 64 rays a cell is closer already, and "
            "takes 3.9 s (fewer were not traced).");
  EXPECT_EQ(said_beside(few, more, 1.0),
            "takes 0.36 s of processor time; no path-traced map of up to 256 rays a cell is as close, and "
            "that one takes 15 s, 43 times as long.");
  const ResultsRow alone = baked_row(plan, 5.0, 18.0, 95.0);
  EXPECT_EQ(speed_at_equal_error(plan, {alone}, alone), "takes 0.018 s of processor time.");
}

}  // namespace
}  // namespace sigmascape::cli
