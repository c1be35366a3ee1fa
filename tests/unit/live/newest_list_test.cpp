#include "sigmascape/live/newest_list.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace sigmascape::live {
namespace {

TEST(NewestList, IsFetchedOnce) {
  NewestList<int> list(2);
  EXPECT_FALSE(list.fetch());
  EXPECT_TRUE(list.fetched().empty());
  list.put(std::vector{1, 2});
  list.put(std::vector{3});
  EXPECT_TRUE(list.fetched().empty());
  EXPECT_TRUE(list.fetch());
  EXPECT_EQ(list.fetched(), std::vector{3});
  EXPECT_FALSE(list.fetch());
  EXPECT_EQ(list.fetched(), std::vector{3});
  list.put({});
  EXPECT_TRUE(list.fetch());
  EXPECT_TRUE(list.fetched().empty());
}

// A list that is written while it is read is half the one, half the other, and a race under the thread sanitizer.
TEST(NewestList, IsWholeWhileOthersAreWritten) {
  NewestList<int> list(64);
  const std::jthread writer([&list](const std::stop_token& stops) {
    std::vector<int> numbers(64);
    for (int i = 1; !stops.stop_requested(); ++i) {
      std::ranges::fill(numbers, i);
      list.put(numbers);
    }
  });
  int last = 0;
  for (int fetched = 0; fetched < 5000; ++fetched) {
    while (!list.fetch()) std::this_thread::yield();
    const std::vector<int>& numbers = list.fetched();
    ASSERT_EQ(std::ranges::count(numbers, numbers.front()), 64);
    ASSERT_GT(numbers.front(), last);
    last = numbers.front();
  }
}

}  // namespace
}  // namespace sigmascape::live
