#include "sigmascape/base/interruption.h"

#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>

#include "sigmascape/base/parallel.h"

namespace sigmascape {
namespace {

/// A loop that only an interruption ends: indices for years.
void endless(std::atomic<std::size_t>& done, unsigned threads) {
  parallel_for(std::size_t{1} << 50U, threads, [&](std::size_t, unsigned) { done.fetch_add(1); });
}

TEST(Interruption, EndsTheLoopsOfAllThreadsThatWorkForIt) {
  for (const unsigned threads : {1U, 3U}) {
    std::atomic<std::size_t> done{0};
    int asked = 0;
    const Interruption interruption([&] { return ++asked > 2; });
    EXPECT_THROW(endless(done, threads), Interrupted);
    EXPECT_EQ(asked, 3);
    EXPECT_GT(done.load(), 0U);
  }
}

TEST(Interruption, ReachesLoopsWithinLoopsOnOtherThreads) {
  std::atomic<std::size_t> done{0};
  int asked = 0;
  const auto asking = std::this_thread::get_id();
  const Interruption interruption([&] {
    EXPECT_EQ(std::this_thread::get_id(), asking);
    return ++asked > 1;
  });
  EXPECT_THROW(parallel_for(4, 4, [&](std::size_t, unsigned) { endless(done, 1); }), Interrupted);
}

TEST(Interruption, PassesOnWhatTheQuestionThrows) {
  std::atomic<std::size_t> done{0};
  const Interruption interruption([]() -> bool { throw std::out_of_range("enough"); });
  EXPECT_THROW(endless(done, 1), std::out_of_range);
}

TEST(Interruption, IsForgottenAfterwards) {
  {
    const Interruption interruption([] { return true; });
  }
  std::size_t done = 0;
  parallel_for(10, 1, [&](std::size_t, unsigned) { ++done; });
  EXPECT_EQ(done, 10U);
}

}  // namespace
}  // namespace sigmascape
