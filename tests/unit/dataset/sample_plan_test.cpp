#include "sigmascape/dataset/sample_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "scratch_folder.h"

namespace sigmascape::dataset {
namespace {

DatasetSpec spec_of_cars() {
  DatasetSpec spec;
  spec.file = "spec.toml";
  spec.cells = 50;
  spec.cell_m = 2.0;
  spec.azimuth_rad = {1.0, 2.0};
  spec.elevation_rad = {0.2, 0.3};
  spec.slant_range_m = {10e3, 20e3};
  spec.targets = {{.name = "car", .number = {0.0, 3.0}, .rcs_db = {0.0, 10.0}, .size_m = 0.0, .height_m = 1.0}};
  return spec;
}
constexpr radar::Rectangle scene_extent{0.0, 0.0, 300.0, 200.0};

TEST(SamplePlan, DrawsEvenlyWithinItsRangesAndKeepsMapsInTheScene) {
  const DatasetSpec spec = spec_of_cars();
  const radar::Rectangle centres = centres_of(spec, scene_extent);
  double azimuths = 0.0;
  std::array<int, 5> numbers{};
  for (std::size_t i = 0; i < 4000; ++i) {
    const SamplePlan plan = plan_of(spec, centres, i);
    azimuths += plan.azimuth_rad / 4000.0;
    ASSERT_TRUE(plan.azimuth_rad >= 1.0 && plan.azimuth_rad <= 2.0);
    const radar::Rectangle area = plan.grid.extent();
    ASSERT_TRUE(area.west_m >= -1e-9 && area.south_m >= -1e-9 && area.east_m <= 300.0 + 1e-9 &&
                area.north_m <= 200.0 + 1e-9);
    ++numbers.at(plan.targets.size());
    for (const PlannedTarget& target : plan.targets) {
      ASSERT_TRUE(area.contains(target.position));
      ASSERT_TRUE(target.rcs_m2 >= 1.0 && target.rcs_m2 <= 10.0);
    }
  }
  // An even spread over [1, 2] has standard deviation 0.289; its mean of 4000 is good to 0.005.
  EXPECT_NEAR(azimuths, 1.5, 0.02);
  for (int n = 0; n < 4; ++n) EXPECT_NEAR(numbers[static_cast<std::size_t>(n)], 1000, 120) << n;
  EXPECT_EQ(numbers[4], 0);
}

TEST(SamplePlan, DependsOnSeedAndNumberAlone) {
  DatasetSpec spec = spec_of_cars();
  const radar::Rectangle centres = centres_of(spec, scene_extent);
  EXPECT_EQ(plan_of(spec, centres, 5).azimuth_rad, plan_of(spec, centres, 5).azimuth_rad);
  EXPECT_NE(plan_of(spec, centres, 5).azimuth_rad, plan_of(spec, centres, 6).azimuth_rad);
  const double before = plan_of(spec, centres, 5).azimuth_rad;
  spec.targets.clear();
  EXPECT_EQ(plan_of(spec, centres, 5).azimuth_rad, before) << "fewer targets move the radar";
  spec.seed = 2;
  EXPECT_NE(plan_of(spec, centres, 5).azimuth_rad, before);
}

TEST(SamplePlan, FramesOfASequenceShareWhatIsDrawnAndTargetsDriveOn) {
  DatasetSpec spec = spec_of_cars();
  spec.sequence = {.frames = 4, .interval_s = 2.0, .speed_mps = {100.0, 150.0}, .course_rad = {0.0, 6.0}};
  spec.targets[0].number = {3.0, 3.0};
  spec.targets[0].speed_mps = {5.0, 10.0};
  spec.targets[0].heading_rad = {0.0, 6.0};
  const radar::Rectangle centres = centres_of(spec, scene_extent);
  const SamplePlan first = plan_of(spec, centres, 4), third = plan_of(spec, centres, 6),
                   other = plan_of(spec, centres, 8);
  EXPECT_EQ(first.sequence, 1U);
  EXPECT_EQ(third.frame, 2U);
  EXPECT_EQ(third.time_s, 4.0);
  EXPECT_EQ(third.azimuth_rad, first.azimuth_rad);
  EXPECT_EQ(third.centre, first.centre);
  EXPECT_NE(other.azimuth_rad, first.azimuth_rad);
  EXPECT_NE(third.seed, first.seed) << "speckle and noise are drawn anew";
  EXPECT_GE(std::hypot(first.flight_mps.x, first.flight_mps.y), 100.0);
  ASSERT_EQ(third.targets.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const PlannedTarget &before = first.targets[k], &after = third.targets[k];
    EXPECT_EQ(after.track, before.track);
    EXPECT_EQ(after.rcs_m2, before.rcs_m2);
    const Vec2d way = after.position - before.position;
    EXPECT_NEAR(length(way), 4.0 * length(before.velocity_mps), 1e-9);
    EXPECT_GE(length(way), 20.0);
    EXPECT_LE(length(way), 40.0);
  }
}

TEST(SamplePlan, DrawsRadarsNoiseAndPlacesOfTargets) {
  DatasetSpec spec = spec_of_cars();
  spec.radar_ranges.range_resolution_m = Range{2.0, 4.0};
  spec.noise_sigma0_db = Range{-40.0, -30.0};
  spec.targets[0].number = {2.0, 2.0};
  spec.targets[0].east_m = Range{-10.0, 10.0};
  spec.targets[0].north_m = Range{20.0, 30.0};
  const radar::Rectangle centres = centres_of(spec, scene_extent);
  double finest = 9.0, coarsest = 0.0;
  for (std::size_t i = 0; i < 500; ++i) {
    const SamplePlan plan = plan_of(spec, centres, i);
    finest = std::min(finest, plan.range_resolution_m);
    coarsest = std::max(coarsest, plan.range_resolution_m);
    EXPECT_EQ(plan.frequency_hz, spec.radar.radar.frequency_hz) << "what is not drawn is the file's";
    EXPECT_TRUE(*plan.noise_sigma0_db >= -40.0 && *plan.noise_sigma0_db <= -30.0);
    for (const PlannedTarget& target : plan.targets) {
      const Vec2d off = target.position - plan.centre;
      EXPECT_TRUE(std::abs(off.x) <= 10.0 && off.y >= 20.0 && off.y <= 30.0);
    }
  }
  EXPECT_TRUE(finest >= 2.0 && finest < 2.1 && coarsest <= 4.0 && coarsest > 3.9);
}

TEST(SamplePlan, RefusesMapsThatDoNotFit) {
  DatasetSpec spec = spec_of_cars();
  spec.target_east_m = Range{10.0, 100.0};
  EXPECT_NE(message_of_error([&] { (void)centres_of(spec, scene_extent); }).find("stay within 50.0 and 250.0"),
            std::string::npos);
  // What is advised is not refused.
  const radar::Rectangle uneven{-127.957, -127.957, 124.144, 124.144};
  EXPECT_NE(message_of_error([&] { (void)centres_of(spec, uneven); }).find("stay within -77.9 and 74.1"),
            std::string::npos);
  spec.target_east_m = Range{-77.9, 74.1};
  EXPECT_NO_THROW((void)centres_of(spec, uneven));
  spec.cells = 101;
  EXPECT_NE(message_of_error([&] { (void)centres_of(spec, scene_extent); }).find("larger than the scene"),
            std::string::npos);
}

}  // namespace
}  // namespace sigmascape::dataset
