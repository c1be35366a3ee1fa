#include "sigmascape/bake/shard.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "scratch_folder.h"

namespace sigmascape::bake {
namespace {

TEST(Shard, EveryJobIsInExactlyOneShare) {
  for (const std::size_t count : {1U, 2U, 3U, 8U, 40U, 41U, 1000U}) {
    std::size_t smallest = 1000, largest = 0;
    std::vector<int> owners(400, 0);
    for (std::size_t index = 0; index < count; ++index) {
      std::size_t jobs = 0;
      for (std::size_t job = 0; job < owners.size(); ++job) {
        if (!Shard{index, count}.has(job)) continue;
        ++owners[job];
        ++jobs;
      }
      smallest = std::min(smallest, jobs);
      largest = std::max(largest, jobs);
    }
    EXPECT_EQ(std::ranges::count(owners, 1), 400) << count;
    EXPECT_LE(largest - smallest, 1U) << count;
  }
}

// 40 aspects a patch, eight azimuths at each of five elevations: a low one takes several times as long as a high one.
TEST(Shard, SharesGetAllElevationsAlike) {
  for (const std::size_t count : {5U, 8U, 20U, 40U}) {
    for (std::size_t index = 0; index < count; ++index) {
      std::vector<std::size_t> jobs(5, 0);
      for (std::size_t job = 0; job < 40 * 40; ++job) jobs[job % 40 / 8] += Shard{index, count}.has(job) ? 1 : 0;
      const auto [fewest, most] = std::ranges::minmax(jobs);
      EXPECT_LE(most - fewest, (most + fewest) / 4) << index << "/" << count;
    }
  }
}

TEST(Shard, IsReadAndRefused) {
  EXPECT_EQ(shard_from("0/1"), (Shard{0, 1}));
  EXPECT_EQ(shard_from("7/8"), (Shard{7, 8}));
  const auto message_for = [](const char* text) {
    return message_of_error([&] { static_cast<void>(shard_from(text)); });
  };
  EXPECT_THAT(message_for("5/3"), ::testing::HasSubstr("give 0/3 to 2/3"));
  EXPECT_THAT(message_for("8/8"), ::testing::HasSubstr("counted from 0"));
  EXPECT_THAT(message_for("0/0"), ::testing::HasSubstr("there are no shards"));
  for (const char* text : {"", "/", "3", "3/", "/3", "-1/3", "1/3/5", "1/3x", "1 /3", "99999999999999999999/3"}) {
    EXPECT_THAT(message_for(text), ::testing::HasSubstr("not two whole numbers")) << text;
  }
}

}  // namespace
}  // namespace sigmascape::bake
