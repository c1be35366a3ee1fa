#include "sigmascape/terrain/obstacle_sweep.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::terrain {
namespace {

constexpr radar::Obstacle nothing{};

// Ground rises or falls away from the observer by β: the shadow of a height h ends h / (tan ψ + tan β) behind it, ψ
// that of the line of sight over its top.
TEST(ObstacleSweep, ShadowsEndWhereTheSlopePutsThem) {
  for (const double slope : {-0.1, 0.0, 0.1}) {
    ObstacleSweep sweep(1000.0);
    const double foot_m = 4000.0, height_m = 12.0, step_m = 0.5;
    const auto ground_at = [&](double distance_m) { return slope * (distance_m - foot_m); };
    const double tangent = (1000.0 - height_m) / foot_m;
    double hidden_m = 0.0;
    for (double d = foot_m - 200.0; d < foot_m + 200.0; d += step_m) {
      const bool stands_here = d == foot_m;
      const auto obstacle = stands_here ? radar::Obstacle{.solid_top_m = static_cast<float>(height_m)} : nothing;
      const Sight sight = sweep.advance(d, ground_at(d), obstacle, step_m);
      EXPECT_EQ(sight.hidden_m, 0.0);
      if (sight.ground == 0.0) hidden_m += step_m;
    }
    EXPECT_NEAR(hidden_m, height_m / (tangent + slope), 1.0) << slope;
  }
}

// κ s through a crown that the line of sight crosses, nothing lost under its base or over its top.
TEST(ObstacleSweep, CrownsLetAPartThrough) {
  const radar::Obstacle crown{.crown_base_m = 2.0F, .crown_top_m = 10.0F, .crown_extinction_per_m = 0.2F};
  ObstacleSweep sweep(1000.0);
  const double step_m = 0.25, start_m = 2000.0, wide_m = 6.0, tangent = 0.5;
  for (double d = 1900.0; d < 2060.0; d += step_m) {
    const bool in_crown = d >= start_m && d < start_m + wide_m;
    const Sight sight = sweep.advance(d, 0.0, in_crown ? crown : nothing, step_m);
    if (in_crown) continue;
    // The line of sight to d passes the crown's columns at heights (d − column) · tan ψ.
    const double past_m = d - start_m;
    const double first = std::max(0.0, past_m - 10.0 / tangent), last = std::min(wide_m, past_m - 2.0 / tangent);
    const double way_m = past_m < 0.0 ? 0.0 : std::max(0.0, last - first) * std::sqrt(1.0 + tangent * tangent);
    EXPECT_NEAR(sight.ground, std::exp(-0.2 * way_m), 0.2 * 3.0 * step_m) << past_m;
  }
}

// Within plants that stand everywhere, however low and however steeply they are looked at, e^−κh/sin ψ of the ground is
// seen.
TEST(ObstacleSweep, EvenPlantsHideTheirGroundWhateverTheStep) {
  for (const radar::Obstacle& plants :
       {radar::Obstacle{.crown_base_m = 0.2F, .crown_top_m = 2.0F, .crown_extinction_per_m = 0.5F},
        {.crown_base_m = 0.0F, .crown_top_m = 2.0F, .crown_extinction_per_m = 0.5F},
        {.crown_base_m = 2.0F, .crown_top_m = 8.0F, .crown_extinction_per_m = 0.15F}}) {
    for (const double elevation_deg : {10.0, 30.0, 45.0, 60.0}) {
      for (const double step_m : {1.0, 2.0, 4.0}) {
        const double psi = radians_from_deg(elevation_deg), middle_m = 2000.0 / std::tan(psi);
        ObstacleSweep sweep(2000.0);
        double seen = 0.0;
        int places = 0;
        for (double d = middle_m - 100.0; d < middle_m + 40.0; d += step_m) {
          const Sight sight = sweep.advance(d, 0.0, plants, step_m);
          if (d < middle_m) continue;
          seen += sight.ground;
          ++places;
        }
        const double depth =
            static_cast<double>(plants.crown_extinction_per_m * (plants.crown_top_m - plants.crown_base_m)) /
            std::sin(psi);
        EXPECT_NEAR(std::log(seen / places), -depth, std::max(0.3, 0.08 * depth))
            << plants.crown_base_m << " m, " << elevation_deg << "°, " << step_m << " m";
      }
    }
  }
}

TEST(PartWithinACrown, IsThatOfTheStride) {
  const radar::Obstacle crown{.crown_base_m = 2.0F, .crown_top_m = 10.0F, .crown_extinction_per_m = 0.2F};
  EXPECT_EQ(part_within(crown, 5.0, 0.0), 1.0);
  EXPECT_EQ(part_within(crown, 1.0, 0.0), 0.0);
  EXPECT_NEAR(part_within(crown, 5.0, 1.0), 1.0, 1e-12);
  EXPECT_NEAR(part_within(crown, 2.0, 1.0), 0.5, 1e-12);
  EXPECT_NEAR(part_within(crown, 6.0, 16.0), 0.25, 1e-12);
  EXPECT_NEAR(part_within(crown, 14.0, 3.0), 0.0, 1e-12);
}

TEST(ObstacleSweep, WhatACrownAddsItTakesAway) {
  ObstacleSweep sweep(500.0);
  for (std::uint64_t i = 0; i < 400; ++i) {
    const float top = 20.0F * unit_float(hashed(1, i));
    sweep.advance(1000.0 + static_cast<double>(i), 0.0, {.crown_top_m = top, .crown_extinction_per_m = 0.37F}, 1.0);
  }
  EXPECT_LT(sweep.advance(1400.0, 0.0, nothing, 1.0).ground, 1e-3);
  EXPECT_EQ(sweep.advance(1600.0, 0.0, nothing, 1.0).ground, 1.0);
}

// Seen from 100 m, a ridge of 50 m at 1000 m hides the foot of what stands 10 m below its line of sight.
TEST(ObstacleSweep, TopsRiseAboveARidge) {
  ObstacleSweep sweep(100.0);
  EXPECT_EQ(sweep.advance(1000.0, 50.0, nothing, 1.0).ground, 1.0);
  const double line_m = 100.0 - 0.05 * 1200.0;
  const Sight sight = sweep.advance(1200.0, line_m - 10.0, {.solid_top_m = 40.0F}, 1.0);
  EXPECT_EQ(sight.ground, 0.0);
  EXPECT_NEAR(sight.hidden_m, 10.0, 1e-6);
  EXPECT_NEAR(part_above(sight.hidden_m, 40.0), 0.75, 1e-6);
  EXPECT_EQ(part_above(sight.hidden_m, 5.0), 0.0);
  EXPECT_EQ(part_above(sight.hidden_m, 0.0), 0.0);
  EXPECT_EQ(part_above(0.0, 0.0), 1.0);
}

}  // namespace
}  // namespace sigmascape::terrain
