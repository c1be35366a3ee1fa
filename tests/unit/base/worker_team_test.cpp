#include "sigmascape/base/worker_team.h"

#include <atomic>
#include <gtest/gtest.h>
#include <numeric>
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

}  // namespace
}  // namespace sigmascape
