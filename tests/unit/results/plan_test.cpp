#include "results/plan.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <utility>

#include "made_rows.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::cli {
namespace {

TEST(ResultsPlan, SpacesAsManyElevationsOverTheSameSpanEvenlyInTheCotangent) {
  const ResultsPlan plan = made_plan();
  const LookGrid even = plan.even_in_cotangent();
  const auto& elevations_deg = even.elevations_deg;
  ASSERT_EQ(elevations_deg.size(), plan.paper_grid().elevations_deg.size());
  EXPECT_EQ(even.azimuths, plan.paper_grid().azimuths);
  EXPECT_EQ(elevations_deg.front(), 5.0);
  EXPECT_EQ(elevations_deg.back(), 37.0);
  const auto cotangent = [&](std::size_t i) { return 1.0 / std::tan(radians_from_deg(elevations_deg[i])); };
  for (std::size_t i = 2; i < elevations_deg.size(); ++i)
    EXPECT_NEAR(cotangent(i - 1) - cotangent(i), cotangent(0) - cotangent(1), 0.02) << i;
}

TEST(ResultsPlan, TellsGridsOfAsManyLooksApart) {
  const ResultsPlan plan = made_plan();
  EXPECT_EQ(plan.paper_grid().name(), "8 × 5");
  EXPECT_EQ(plan.even_in_cotangent().name(), "8 × 5 in cot ψ");
}

TEST(ResultsPlan, WantsRaysOfWhatIsHeldAgainst) {
  ResultsOptions options;
  options.traced_samples = 0;
  EXPECT_THROW(static_cast<void>(results_plan(options)), Error);
  options.traced_samples = 1;
  EXPECT_NO_THROW(static_cast<void>(results_plan(options)));
}

TEST(ResultsPlan, LooksAtNoViewOfTheGridTwice) {
  ResultsOptions options;
  options.held_out = 0;
  options.on_grid = 32;  // all of 8 × 4
  std::set<std::pair<double, double>> views;
  for (const PlannedView& view : results_plan(options).views) {
    if (view.kind == ViewKind::OnGrid) views.insert({view.azimuth_deg, view.elevation_deg});
  }
  EXPECT_EQ(views.size(), 32U);
  options.on_grid = 33;
  EXPECT_THROW(static_cast<void>(results_plan(options)), Error);
}

}  // namespace
}  // namespace sigmascape::cli
