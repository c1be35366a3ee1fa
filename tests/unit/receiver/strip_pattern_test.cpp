#include "sigmascape/receiver/strip_pattern.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

/// One-way power at ±3 widths, of a beam that is weak to one side and weaker to the other.
constexpr double clockwise = 1e-1, counter_clockwise = 1e-3;

/// A table is clockwise from the axis. What is ahead of a beam to the left lies clockwise of it: ahead of west is
/// north.
TEST(StripPattern, WhatIsAheadLiesClockwiseToTheLeftAlone) {
  const double width_rad = radians_from_deg(1.0);
  const radar::AntennaCut cut(
      radar::TabulatedBeam{{{-3.0, counter_clockwise}, {-0.5, 0.5}, {0.0, 1.0}, {0.5, 0.5}, {3.0, clockwise}}},
      width_rad);
  const double ahead = std::sin(3.0 * width_rad);
  for (const bool looks_left : {true, false}) {
    const StripPattern pattern(cut, 0.0, looks_left);
    EXPECT_NEAR(pattern.voltage(ahead, 0.0, 0.0), looks_left ? clockwise : counter_clockwise, 1e-6) << looks_left;
    EXPECT_NEAR(pattern.voltage(-ahead, 0.0, 0.0), looks_left ? counter_clockwise : clockwise, 1e-6) << looks_left;
    EXPECT_NEAR(pattern.voltage(0.0, ahead, 0.0), 1.0 / (looks_left ? clockwise : counter_clockwise), 1e-2);
  }
}

}  // namespace
}  // namespace sigmascape::receiver
