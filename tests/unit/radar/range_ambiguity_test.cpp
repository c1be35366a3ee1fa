#include "sigmascape/radar/range_ambiguity.h"

#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

TEST(RangeAmbiguity, UnambiguousRangeOfOneKilohertzIs150Kilometres) {
  EXPECT_DOUBLE_EQ(unambiguous_range_m(1000.0), 149'896.229);
}

TEST(RangeAmbiguity, FoldsIntoTheIntervalAfterTheGateOpens) {
  const double fold_m = unambiguous_range_m(10e3);  // 14 989.6 m
  EXPECT_DOUBLE_EQ(apparent_range_m(20e3, 0.0, 10e3), 20e3 - fold_m);
  EXPECT_DOUBLE_EQ(apparent_range_m(20e3, 18e3, 10e3), 20e3);
  EXPECT_DOUBLE_EQ(apparent_range_m(2e3, 18e3, 10e3), 2e3 + 2.0 * fold_m);
  EXPECT_DOUBLE_EQ(apparent_range_m(100e3, 18e3, 10e3), 100e3 - 5.0 * fold_m);
  EXPECT_EQ(times_around(20e3, 0.0, 10e3), 1);
  EXPECT_EQ(times_around(20e3, 18e3, 10e3), 0);
  EXPECT_EQ(times_around(2e3, 18e3, 10e3), -2);
}

TEST(RangeAmbiguity, FoldsToTheNearestOfAllPlacesInATrain) {
  const double fold_m = unambiguous_range_m(10e3);
  EXPECT_DOUBLE_EQ(folded_near_m(20e3, 18e3, 10e3), 20e3);
  EXPECT_NEAR(folded_near_m(20e3, 4e3, 10e3), 20e3 - fold_m, 1e-9);
  EXPECT_NEAR(folded_near_m(2e3, 33e3, 10e3), 2e3 + 2.0 * fold_m, 1e-9);
}

// A pulse of 10 µs is 1499 m long: from a third of that range a third of the echo is heard.
TEST(RangeAmbiguity, EclipsedNearThePulsesOnly) {
  const double pulse_m = speed_of_light_mps * 10e-6 / 2.0, fold_m = unambiguous_range_m(1000.0);
  const auto part = [](double range_m) { return uneclipsed_part(range_m, 10e-6, 1000.0); };
  EXPECT_NEAR(part(0.0), 0.0, 1e-9);
  EXPECT_NEAR(part(pulse_m / 3.0), 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(part(pulse_m), 1.0, 1e-9);
  EXPECT_NEAR(part(fold_m / 2.0), 1.0, 1e-9);
  EXPECT_NEAR(part(fold_m - pulse_m / 4.0), 0.25, 1e-9);
  EXPECT_NEAR(part(fold_m + pulse_m / 2.0), 0.5, 1e-6);
}

}  // namespace
}  // namespace sigmascape::radar
