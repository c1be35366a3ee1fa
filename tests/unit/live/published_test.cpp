#include "sigmascape/live/published.h"

#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <gtest/gtest.h>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace sigmascape::live {
namespace {

using Numbers = std::array<int, 16>;

Numbers all(int number) {
  Numbers numbers{};
  numbers.fill(number);
  return numbers;
}

// A lack of order between the threads shows under the thread sanitizer as well.
TEST(Published, IsReadWholeWhileItIsReplaced) {
  constexpr int readers = 3, reads = 100000;
  Published<Numbers> published(all(1));
  std::atomic<int> torn{0}, gone_back{0}, at_work{readers};
  {
    std::vector<std::jthread> threads;
    for (int reader = 0; reader < readers; ++reader) {
      threads.emplace_back([&] {
        Published<Numbers>::Reading kept;
        int last = 0;
        for (int read = 0; read < reads; ++read) {
          const auto now = published.load();
          const int number = now->front();
          if (number < last) ++gone_back;
          last = number;
          // Some are held while others come and go, and read again at the end.
          if (read % 7 == 0) kept = now;
          if (*now != all(number) || *kept != all(kept->front())) ++torn;
        }
        --at_work;
      });
    }
    for (int i = 2; at_work > 0; ++i) {
      published.store(all(i));
      if (i % 3 == 0) published.forget_unread();
    }
  }
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(gone_back, 0);
}

TEST(Published, StaysAsItIsForWhoeverReads) {
  using Shared = std::shared_ptr<const int>;
  Published<Shared> published(std::make_shared<const int>(0));
  const std::weak_ptr<const int> first = published.newest();
  auto reading = published.load();
  auto copy = reading;
  for (int i = 1; i < 10; ++i) {
    published.store(std::make_shared<const int>(i));
    published.forget_unread();
  }
  EXPECT_EQ(**reading, 0);
  reading = {};
  published.forget_unread();
  EXPECT_EQ(**copy, 0);
  const auto moved = std::move(copy);
  published.forget_unread();
  EXPECT_EQ(**moved, 0);
  EXPECT_FALSE(first.expired());
  EXPECT_EQ(**published.load(), 9);
}

TEST(Published, WhatNobodyReadsIsLetGo) {
  using Shared = std::shared_ptr<const int>;
  Published<Shared> published(std::make_shared<const int>(0));
  const std::weak_ptr<const int> first = published.newest();
  auto reading = published.load();
  published.store(std::make_shared<const int>(1));
  published.forget_unread();
  EXPECT_FALSE(first.expired());
  reading = published.load();
  published.forget_unread();
  EXPECT_TRUE(first.expired());
  published.forget_unread();
  EXPECT_EQ(**published.load(), 1) << "the newest stays";
}

/// A value that stops in the middle of being replaced until it is told to go on.
struct Slow {
  Slow() = default;
  Slow(int value, std::promise<void>& begin, std::shared_future<void> end)
      : number(value), has_begun(&begin), may_end(std::move(end)) {}
  Slow(const Slow&) = delete;
  Slow& operator=(const Slow&) = delete;
  Slow(Slow&&) = default;
  Slow& operator=(Slow&& other) noexcept {
    if (other.has_begun != nullptr) {
      other.has_begun->set_value();
      other.may_end.wait();
    }
    number = other.number;
    return *this;
  }
  ~Slow() = default;

  int number = 0;
  std::promise<void>* has_begun = nullptr;
  std::shared_future<void> may_end;
};

TEST(Published, IsReadWhileTheOneWhoReplacesStandsStill) {
  Published<Slow> published{Slow()};
  std::promise<void> has_begun, end;
  std::jthread writer([&] { published.store(Slow(1, has_begun, end.get_future().share())); });
  has_begun.get_future().wait();
  auto read = std::async(std::launch::async, [&published] { return published.load()->number; });
  const bool waited = read.wait_for(std::chrono::seconds(20)) != std::future_status::ready;
  end.set_value();
  EXPECT_FALSE(waited);
  EXPECT_EQ(read.get(), 0);
  writer.join();
  EXPECT_EQ(published.load()->number, 1);
}

}  // namespace
}  // namespace sigmascape::live
