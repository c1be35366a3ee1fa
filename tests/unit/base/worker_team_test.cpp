#include "sigmascape/base/worker_team.h"

#include <atomic>
#include <gtest/gtest.h>
#include <new>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace sigmascape {
namespace {

TEST(WorkerTeam, DoesEveryIndexOnceEachRound) {
  WorkerTeam team(3);
  std::vector<int> done(1000, 0);
  for (int round = 0; round < 200; ++round) {
    team.run(done.size(), [&](std::size_t index, unsigned) { ++done[index]; });
  }
  for (const int times : done) EXPECT_EQ(times, 200);
}

TEST(WorkerTeam, NumbersItsMembersFromZero) {
  WorkerTeam team(4);
  EXPECT_EQ(team.size(), 4U);
  std::vector<std::atomic<int>> work(team.size());
  team.run(10000, [&](std::size_t, unsigned worker) { ++work.at(worker); });
  EXPECT_EQ(std::accumulate(work.begin(), work.end(), 0), 10000);
}

TEST(WorkerTeam, ReturnsWhenThereIsNothingToDo) {
  WorkerTeam team(2);
  team.run(0, [](std::size_t, unsigned) { FAIL(); });
}

TEST(WorkerTeam, OfOneWorksOnTheCallingThread) {
  WorkerTeam team(1);
  const auto caller = std::this_thread::get_id();
  team.run(5, [&](std::size_t, unsigned) { EXPECT_EQ(std::this_thread::get_id(), caller); });
}

TEST(WorkerTeam, HandsToTheCallerWhatAnyOfItsMembersThrew) {
  WorkerTeam team(3);
  for (unsigned thrower = 0; thrower < team.size(); ++thrower) {
    std::atomic<unsigned> arrived{0};
    const auto meet_and_throw = [&](std::size_t, unsigned worker) {
      ++arrived;
      while (arrived < team.size()) std::this_thread::yield();  // so that every member has one
      if (worker == thrower) throw std::bad_alloc();
    };
    EXPECT_THROW(team.run(team.size(), meet_and_throw), std::bad_alloc) << thrower;
    std::atomic<int> done{0};
    team.run(100, [&](std::size_t, unsigned) { ++done; });
    EXPECT_EQ(done, 100) << "the next round is whole";
  }
}

TEST(WorkerTeam, BeginsNothingMoreOnceOneThrew) {
  WorkerTeam team(1);
  int begun = 0;
  const auto throw_at_the_third = [&](std::size_t index, unsigned) {
    ++begun;
    if (index == 2) throw std::length_error("third");
  };
  EXPECT_THROW(team.run(10, throw_at_the_third), std::length_error);
  EXPECT_EQ(begun, 3);
}

}  // namespace
}  // namespace sigmascape
