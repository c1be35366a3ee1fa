#include "results/columns.h"

#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace sigmascape::cli {
namespace {

constexpr double not_defined = std::numeric_limits<double>::quiet_NaN();

TEST(ResultsColumns, WhatRoundsToNothingHasNoSign) {
  EXPECT_EQ(signed_text(-0.004, 2), "0.00");
  EXPECT_EQ(signed_text(+0.004, 2), "0.00");
  EXPECT_EQ(signed_text(-0.006, 2), "-0.01");
  EXPECT_EQ(signed_text(+0.006, 2), "+0.01");
  EXPECT_EQ(number_text(-0.0004, 3), "0.000");
  EXPECT_EQ(number_text(-0.25, 2), "-0.25");
}

TEST(ResultsColumns, TwoDigitsThatCountAreAlwaysWritten) {
  for (const auto& [value, text] : {std::pair(0.0, "0"),
                                    {0.0181, "0.018"},
                                    {0.428, "0.43"},
                                    {0.0996, "0.10"},
                                    {1.0, "1.0"},
                                    {1.94, "1.9"},
                                    {9.96, "10"},
                                    {15.48, "15"},
                                    {238.03, "238"},
                                    {-0.25, "-0.25"}})
    EXPECT_EQ(two_digits(value), text);
  EXPECT_EQ(two_digits(not_defined), "–");
}

TEST(ResultsColumns, WhatIsNotDefinedIsADash) {
  EXPECT_EQ(number_text(not_defined, 2), "–");
  EXPECT_EQ(signed_text(not_defined, 2), "–");
}

TEST(ResultsColumns, RoundingHidesNotOnWhichSideOfAnAimAValueLies) {
  EXPECT_EQ(decimals_that_tell(0.9896, 0.99, 3), 4);
  EXPECT_EQ(decimals_that_tell(0.98996, 0.99, 3), 5);
  EXPECT_EQ(decimals_that_tell(0.9904, 0.99, 3), 3);
  EXPECT_EQ(decimals_that_tell(0.99, 0.99, 3), 3);
  EXPECT_EQ(decimals_that_tell(0.985, 0.99, 3), 3);
  EXPECT_EQ(decimals_that_tell(not_defined, 0.99, 3), 3);
}

TEST(ResultsColumns, WorstValuesStandInBracketsWhereViewsAreSeveral) {
  const product::CellComparison median{
      .correlation_db = 0.9, .rms_db = 2.0, .bias_db = -0.001, .l1 = 0.1, .shadow_iou = 0.5};
  product::CellComparison worst = median;
  worst.rms_db = 3.0;
  worst.shadow_iou = not_defined;
  EXPECT_EQ(metrics_text(median, worst, 2, 2), "0.900 (0.900) | 2.00 (3.00) | 0.00 (0.00) | 0.100 (0.100) | 0.50 (–)");
  EXPECT_EQ(metrics_text(median, worst, 24, 5),
            "0.900 (0.900) | 2.00 (3.00) | 0.00 (0.00) | 0.100 (0.100) | 0.50 (–) of 5");
  EXPECT_EQ(metrics_text(median, worst, 1, 1), "0.900 | 2.00 | 0.00 | 0.100 | 0.50");
}

TEST(ResultsColumns, ScenesAreToldApartWhereThereAreTwo) {
  ResultsPlan plan;
  EXPECT_EQ(SceneColumn(plan).cell("hills"), " hills |");
  plan.scene_file = "place.toml";
  EXPECT_EQ(SceneColumn(plan).head() + SceneColumn(plan).rule() + SceneColumn(plan).cell("place"), "");
}

}  // namespace
}  // namespace sigmascape::cli
