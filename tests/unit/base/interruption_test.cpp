#include "sigmascape/base/interruption.h"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>

#include "sigmascape/base/parallel.h"

namespace sigmascape {
namespace {

using namespace std::chrono_literals;

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

/// Who asks has nothing left to do, and another is at a piece that takes minutes.
TEST(Interruption, IsHeardWhileOthersAreAtTheLastPieces) {
  const auto begun = std::chrono::steady_clock::now();
  const Interruption interruption([&] { return std::chrono::steady_clock::now() - begun > 100ms; });
  const auto asking = std::this_thread::get_id();
  std::atomic<bool> is_other_at_work{false};
  EXPECT_THROW(parallel_for(2, 2,
                            [&](std::size_t, unsigned) {
                              if (std::this_thread::get_id() == asking) {
                                while (!is_other_at_work) std::this_thread::sleep_for(1ms);
                                return;
                              }
                              is_other_at_work = true;
                              while (std::chrono::steady_clock::now() - begun < 20s) {
                                std::this_thread::sleep_for(1ms);
                                Interruption::heed();
                              }
                            }),
               Interrupted);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, 10s);
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
