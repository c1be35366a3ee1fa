#include "results/claims.h"

#include <gmock/gmock.h>

#include "made_report.h"

namespace sigmascape::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(ResultsClaims, StandBesideWhatWasMeasuredOfThem) {
  ResultsReport report = made_report(false);
  report.plan.scale = 0.2;
  for (ResultsRow& row : report.rows) {
    row.render_ms = row.of.method == Method::Paper ? 135.0 : 197.0;
    row.atlas.looks = 32;
    row.atlas.bake_seconds = row.of.method == Method::Paper ? 208.0 : 291.2;
    row.atlas.store_bytes = row.of.method == Method::Paper ? 21'474'836 : 5'450'000;
    row.cells.front().median.bias_db = row.of.method == Method::Paper ? 0.94 : 0.35;
    row.cells.front().worst.bias_db = row.of.method == Method::Paper ? -8.7 : 2.92;
  }
  for (const Method method : {Method::Paper, Method::OwnGround}) {
    ResultsRow& row = report.rows.emplace_back(made_row(made_case(report.plan, method, ViewKind::Paper), 7.0, 0.7));
    row.cells.front().median.correlation_db = method == Method::Paper ? 0.743 : 0.913;
    row.cells.front().floor_median.correlation_db = 0.989;
    row.cells.front().floor_median.shadow_iou = 0.57;
  }
  EXPECT_THAT(claims_section(report),
              AllOf(HasSubstr("by eye, in Figure 8 | at that view the correlation of dB at 8 m cells is 0.743, of ours "
                              "0.913, of two traced maps 0.989 |\n"),
                    HasSubstr("there the shadow IoU is 0.50, of ours 0.50, of two traced maps 0.57 |\n"),
                    HasSubstr("median (worst): +0.94 (-8.70) dB, of ours +0.35 (+2.92) dB |\n"),
                    HasSubstr("to the order of milliseconds\" | 135 ms a map, ours 197 ms |\n"),
                    HasSubstr("fractions of the time\" | a map takes 0.14 s of processor time. |\n"),
                    HasSubstr("| 6.5 s for 400 m a side, ours 9.1 s |\n"),
                    // 400 m of the paper's 2 km: a 25th of its area.
                    HasSubstr("32 looks, 8 × 4, take 537 MB on the 2 km of the paper, ours 136 MB, from 21.47 and 5.45 "
                              "MB here"),
                    HasSubstr("| 10 % of the vertices |\n")));
}

TEST(ResultsClaims, ThatNothingWasMeasuredForAreLeftOut) {
  const std::string text = claims_section(made_report(false));
  EXPECT_THAT(text, AllOf(HasSubstr("conservation of power"), Not(HasSubstr("very strong correlation"))));
}

TEST(ResultsClaims, AreOfThePapersSceneAlone) {
  EXPECT_EQ(claims_section(made_report(true)), "");
  ResultsReport real = made_report(false);
  real.plan.materials = scene::PaperMaterials::Itu;
  EXPECT_EQ(claims_section(real), "");
}

}  // namespace
}  // namespace sigmascape::cli
