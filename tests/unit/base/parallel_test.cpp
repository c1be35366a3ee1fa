#include "sigmascape/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <mutex>
#include <set>
#include <stdexcept>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace sigmascape {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (const unsigned threads : {0U, 1U, 2U, 3U, 8U, 33U}) {
    for (const std::size_t count : {0UL, 1UL, 2UL, 7UL, 1000UL}) {
      std::vector<std::atomic<int>> visits(count);
      parallel_for(count, threads, [&](std::size_t index, unsigned) { ++visits[index]; });
      EXPECT_TRUE(std::ranges::all_of(visits, [](const auto& n) { return n == 1; }))
          << threads << " threads, " << count;
    }
  }
}

TEST(ParallelFor, WorkerNumbersTellThreadsApart) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    std::vector<std::set<std::thread::id>> seen(threads);
    std::mutex guard;
    parallel_for(200, threads, [&](std::size_t, unsigned worker) {
      const std::lock_guard lock(guard);
      ASSERT_LT(worker, threads);
      seen[worker].insert(std::this_thread::get_id());
    });
    std::set<std::thread::id> all;
    std::size_t used = 0;
    for (const auto& ids : seen) {
      EXPECT_LE(ids.size(), 1U);
      used += ids.size();
      all.insert(ids.begin(), ids.end());
    }
    EXPECT_EQ(all.size(), used);
  }
}

// Address space for a few stacks more and no others.
TEST(ParallelFor, MakesDoWithTheThreadsThatThereAre) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need more address space than a limit can leave";
#endif
  const auto all_done_in_little_room = [] {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t room = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{64} << 20U);
    const rlimit limit{room, room};
    setrlimit(RLIMIT_AS, &limit);
    std::atomic<int> done = 0;
    parallel_for(1000, 200, [&](std::size_t, unsigned) { ++done; });
    std::_Exit(done == 1000 ? 0 : 1);
  };
  EXPECT_EXIT(all_done_in_little_room(), ::testing::ExitedWithCode(0), "");
}

TEST(ParallelFor, ThrowsAgainWhatTheBodyThrew) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    try {
      parallel_for(100, threads, [](std::size_t index, unsigned) {
        if (index == 3) throw std::runtime_error("three");
      });
      FAIL() << "nothing was thrown with " << threads << " threads";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "three");
    }
  }
}

TEST(ParallelFor, StopsAfterAnException) {
  constexpr std::size_t count = 1'000'000;
  for (const unsigned threads : {1U, 4U}) {
    std::atomic<std::size_t> visits{0};
    EXPECT_THROW(parallel_for(count, threads,
                              [&](std::size_t index, unsigned) {
                                ++visits;
                                if (index == 0) throw std::runtime_error("first");
                                std::this_thread::yield();
                              }),
                 std::runtime_error);
    EXPECT_LT(visits, count) << threads << " threads";
    EXPECT_TRUE(threads > 1 || visits == 1);
  }
}

TEST(ThreadCount, IsWhatIsAskedForOrAtLeastOne) {
  EXPECT_EQ(thread_count(7), 7U);
  EXPECT_GE(thread_count(0), 1U);
}

}  // namespace
}  // namespace sigmascape
