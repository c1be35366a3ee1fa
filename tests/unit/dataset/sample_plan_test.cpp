#include "sigmascape/dataset/sample_plan.h"

#include <array>
#include <gtest/gtest.h>

#include "scratch_folder.h"

namespace sigmascape::dataset {
namespace {

DatasetSpec example() {
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
constexpr radar::Rectangle extent{0.0, 0.0, 300.0, 200.0};

TEST(SamplePlan, DrawsEvenlyWithinItsRangesAndKeepsMapsInTheScene) {
  const DatasetSpec spec = example();
  const radar::Rectangle centres = centres_of(spec, extent);
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
  DatasetSpec spec = example();
  const radar::Rectangle centres = centres_of(spec, extent);
  EXPECT_EQ(plan_of(spec, centres, 5).azimuth_rad, plan_of(spec, centres, 5).azimuth_rad);
  EXPECT_NE(plan_of(spec, centres, 5).azimuth_rad, plan_of(spec, centres, 6).azimuth_rad);
  const double before = plan_of(spec, centres, 5).azimuth_rad;
  spec.targets.clear();
  EXPECT_EQ(plan_of(spec, centres, 5).azimuth_rad, before) << "fewer targets move the radar";
  spec.seed = 2;
  EXPECT_NE(plan_of(spec, centres, 5).azimuth_rad, before);
}

TEST(SamplePlan, RefusesMapsThatDoNotFit) {
  DatasetSpec spec = example();
  spec.target_east_m = Range{10.0, 100.0};
  EXPECT_NE(message_of_error([&] { (void)centres_of(spec, extent); }).find("stay within 50.0 and 250.0"),
            std::string::npos);
  spec.cells = 101;
  EXPECT_NE(message_of_error([&] { (void)centres_of(spec, extent); }).find("larger than the scene"), std::string::npos);
}

}  // namespace
}  // namespace sigmascape::dataset
