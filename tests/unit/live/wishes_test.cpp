#include "sigmascape/live/wishes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

#include "counted_allocations.h"

namespace sigmascape::live {
namespace {

/// All that is wanted, in order.
std::vector<int> all_taken(Wishes<int>& wishes) {
  std::vector<int> all;
  for (int wish = 0; wishes.take(wish);) all.push_back(wish);
  return all;
}

using List = std::array<int, 3>;

TEST(Wishes, TheLastListCountsAndItsFirstComesFirst) {
  Wishes<int> wishes;
  auto asker = wishes.asker(3);
  EXPECT_TRUE(wishes.empty());
  asker.request(List{1, 2, 3});
  asker.request(List{4, 5, 6});
  int first = 0;
  ASSERT_TRUE(wishes.take(first));
  EXPECT_EQ(first, 4);
  EXPECT_FALSE(wishes.empty());
  asker.request(List{7, 8, 9});
  EXPECT_EQ(all_taken(wishes), (std::vector{7, 8, 9}));
  EXPECT_TRUE(wishes.empty());
  asker.request(List{1, 2, 3});
  asker.request({});
  EXPECT_TRUE(wishes.empty());
}

TEST(Wishes, WhoeverAskedLastComesFirst) {
  Wishes<int> wishes;
  auto one = wishes.asker(3), other = wishes.asker(3);
  other.request(List{4, 5, 6});
  EXPECT_FALSE(wishes.empty());
  one.request(List{1, 2, 3});
  EXPECT_EQ(all_taken(wishes), (std::vector{1, 2, 3, 4, 5, 6}));
  one.request(List{1, 2, 3});
  EXPECT_FALSE(wishes.empty());
  other.request(List{4, 5, 6});
  EXPECT_EQ(all_taken(wishes), (std::vector{4, 5, 6, 1, 2, 3}));
}

TEST(Wishes, GoWithTheirAskerOrWhenTheyAreCleared) {
  Wishes<int> wishes;
  auto stays = wishes.asker(3);
  stays.request(List{1, 2, 3});
  {
    auto goes = wishes.asker(3);
    goes.request(List{4, 5, 6});
    EXPECT_FALSE(wishes.empty());
  }
  EXPECT_EQ(all_taken(wishes), (std::vector{1, 2, 3}));
  stays.request(List{1, 2, 3});
  wishes.clear();
  EXPECT_TRUE(wishes.empty());
  stays.request(List{7, 8, 9});
  EXPECT_EQ(all_taken(wishes), (std::vector{7, 8, 9}));
}

TEST(Wishes, AskingTakesNoMemory) {
  Wishes<int> wishes;
  auto asker = wishes.asker(3);
  const std::size_t before = allocations();
  for (int i = 0; i < 10; ++i) {
    asker.request(List{i, i, i});
    int first = 0;
    if (i % 3 > 0) (void)wishes.take(first);
  }
  EXPECT_EQ(allocations(), before);
}

void raise_to(std::atomic<int>& most, int number) {
  int before = most;
  while (before < number && !most.compare_exchange_weak(before, number)) continue;
}

TEST(Wishes, AreCountedUnlessTakenOrPutOff) {
  Wishes<int> wishes;
  Wishes<int>::Asker asker = wishes.asker(4);
  asker.request(std::array{1, 2, 3, 5});
  const auto is_odd = [](int wish) { return wish % 2 == 1; };
  EXPECT_EQ(wishes.count_if(is_odd), 3U);
  int wish = 0;
  ASSERT_TRUE(wishes.take(wish));
  EXPECT_EQ(wishes.count_if(is_odd), 2U);
  EXPECT_EQ(wishes.size(), 3U);
  wishes.put_off();
  EXPECT_EQ(wishes.count_if(is_odd), 0U);
  wishes.renew();
  EXPECT_EQ(wishes.count_if(is_odd), 3U);
}

// Askers ask, come and go while two others load.
TEST(Wishes, NoneIsSleptThroughWhileAskersComeAndGo) {
  constexpr int lists = 4000;
  Wishes<int> wishes;
  std::atomic<bool> stops{false};
  std::array<std::atomic<int>, 2> last_taken{};
  std::atomic<int> slept_through{0};
  std::vector<std::jthread> loaders;
  for (int loader = 0; loader < 2; ++loader) {
    loaders.emplace_back([&] {
      while (!stops) {
        const std::uint32_t calls = wishes.calls();
        for (int wish = 0; wishes.take(wish);)
          raise_to(last_taken[static_cast<std::size_t>(wish / lists)], wish % lists);
        wishes.wait_beyond(calls);
      }
    });
  }
  {
    std::vector<std::jthread> askers;
    for (int number = 0; number < 2; ++number) {
      askers.emplace_back([&, number] {
        const std::atomic<int>& newest = last_taken[static_cast<std::size_t>(number)];
        Wishes<int>::Asker asker;
        for (int list = 1; list < lists && slept_through == 0; ++list) {
          if (list % 100 == 1) asker = wishes.asker(1);
          asker.request(std::array{number * lists + list});
          if (list % 3 == 0) continue;  // the next one takes its place, or is taken after it
          const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
          while (newest < list && slept_through == 0) {
            if (std::chrono::steady_clock::now() > deadline) ++slept_through;
            std::this_thread::yield();
          }
        }
      });
    }
  }
  stops = true;
  wishes.ring();
  loaders.clear();
  EXPECT_EQ(slept_through, 0);
}

}  // namespace
}  // namespace sigmascape::live
