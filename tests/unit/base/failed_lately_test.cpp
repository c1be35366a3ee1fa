#include "sigmascape/base/failed_lately.h"

#include <chrono>
#include <gtest/gtest.h>

namespace sigmascape {
namespace {

TEST(FailedLately, HoldsWhatFailedAMomentAgo) {
  FailedLately<int> failed(std::chrono::hours(1));
  EXPECT_FALSE(failed.holds(7));
  failed.add(7);
  failed.add(7);
  EXPECT_TRUE(failed.holds(7));
  EXPECT_FALSE(failed.holds(8));
  EXPECT_EQ(failed.size(), 1U);
  failed.erase(7);
  EXPECT_FALSE(failed.holds(7));
  EXPECT_EQ(failed.size(), 0U);
}

TEST(FailedLately, LetsAskAgainWhenPatienceEndsAndStillCounts) {
  FailedLately<int> failed(std::chrono::milliseconds(0));
  failed.add(7);
  EXPECT_FALSE(failed.holds(7));
  EXPECT_EQ(failed.size(), 1U);
}

}  // namespace
}  // namespace sigmascape
