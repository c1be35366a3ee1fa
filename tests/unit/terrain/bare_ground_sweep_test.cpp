#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/hash.h"
#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::terrain {
namespace {

/// A sweep over ground on which nothing stands.
class BareGroundSweep {
 public:
  explicit BareGroundSweep(double observer_height_m) : sweep_(observer_height_m) {}
  bool advance(double distance_m, double height_m) {
    return sweep_.advance(distance_m, height_m, {}, 1.0).ground == 1.0;
  }

 private:
  ObstacleSweep sweep_;
};

TEST(BareGroundSweep, LevelGroundIsSeenThroughout) {
  BareGroundSweep sweep(100.0);
  for (int i = 1; i < 10'000; ++i) EXPECT_TRUE(sweep.advance(10.0 * i, 0.0)) << i;
}

TEST(BareGroundSweep, AWallHidesGroundToItsShadowsEnd) {
  // 20 m tall at 1000 m, seen from 500 m: the shadow ends where 500/d = 480/1000.
  BareGroundSweep sweep(500.0);
  for (double d = 10.0; d < 1000.0; d += 1.0) sweep.advance(d, 0.0);
  ASSERT_TRUE(sweep.advance(1000.0, 20.0));
  const double end_m = 1000.0 * 500.0 / 480.0;
  for (double d = 1001.0; d < 1100.0; d += 1.0) EXPECT_EQ(sweep.advance(d, 0.0), d >= end_m) << d;
}

TEST(BareGroundSweep, NothingAboveTheLineOfSightIsHidden) {
  BareGroundSweep sweep(500.0);
  sweep.advance(1000.0, 20.0);
  EXPECT_FALSE(sweep.advance(1010.0, 15.0));
  EXPECT_TRUE(sweep.advance(1010.0, 15.3));
}

TEST(BareGroundSweep, LooksUpAtMountainsAboveTheObserver) {
  BareGroundSweep sweep(100.0);
  EXPECT_TRUE(sweep.advance(1000.0, 300.0));
  EXPECT_FALSE(sweep.advance(2000.0, 499.0));
  EXPECT_TRUE(sweep.advance(2000.0, 501.0));
}

// A point is seen when no nearer one reaches above the straight line to it.
TEST(BareGroundSweep, AgreesWithEveryLineOfSight) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<double> heights;
    for (std::uint64_t i = 0; i < 200; ++i) heights.push_back(60.0 * static_cast<double>(unit_float(hashed(seed, i))));
    const double observer = 80.0;
    BareGroundSweep sweep(observer);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const double far = 10.0 * static_cast<double>(i + 1);
      bool seen = true;
      for (std::size_t k = 0; k < i; ++k) {
        const double near = 10.0 * static_cast<double>(k + 1);
        seen = seen && observer + (heights[i] - observer) * near / far >= heights[k];
      }
      EXPECT_EQ(sweep.advance(far, heights[i]), seen) << seed << " " << i;
    }
  }
}

}  // namespace
}  // namespace sigmascape::terrain
