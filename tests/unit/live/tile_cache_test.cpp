#include "sigmascape/live/tile_cache.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <gtest/gtest.h>
#include <new>
#include <span>
#include <system_error>
#include <thread>
#include <vector>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/live/shortage.h"

namespace sigmascape::live {
namespace {

using Key = std::uint64_t;

/// A page of numbers that follow from its key.
struct NumberPage {
  Key key = 0;
  std::vector<std::uint64_t> numbers;
  bool lacks_something = false;
  mutable AnotherTry another_try;
  mutable std::atomic<std::uint64_t> last_wanted{0};

  [[nodiscard]] static std::size_t level() { return 0; }
  [[nodiscard]] bool is_as_named() const {
    return std::ranges::count(numbers, hashed(key, 1)) == std::ssize(numbers) && !numbers.empty();
  }
};

struct NumberSource {
  using Page = NumberPage;

  bool fill(NumberPage& page) const {
    before_filling();
    if (is_out()) return false;
    page.numbers.resize(256);
    for (std::uint64_t& number : page.numbers) number = hashed(page.key, 1);
    page.lacks_something = is_short_of(page.key);
    return true;
  }
  static bool lacks_something(const NumberPage& page) { return page.lacks_something; }
  bool can_be_better(const NumberPage& page) const { return !is_short_of(page.key); }
  bool renew(const NumberPage&, NumberPage& page) const { return fill(page); }
  static bool stays(const NumberPage&) { return false; }
  static std::size_t most_bytes() { return 1; }
  [[nodiscard]] std::size_t damaged() const { return asked_for_damage(); }

  std::function<std::size_t()> asked_for_damage = [] { return std::size_t{0}; };
  std::function<void()> before_filling = [] {};
  std::function<bool()> is_out = [] { return false; };
  std::function<bool(Key)> is_short_of = [](Key) { return false; };
};

using Cache = TileCache<NumberSource>;

/// Looks at pages in frame after frame as a renderer does. Returns how often one was not what it should be.
std::size_t wrong_pages_of(Cache& cache, std::uint64_t seed, const std::stop_token& stops) {
  constexpr Key keys = 64;
  constexpr std::size_t pages_a_frame = 6;
  Cache::Asker asker;
  std::vector<Key> wanted;
  std::size_t wrong = 0;
  for (int frame = 0; !stops.stop_requested(); ++frame) {
    // Renderers come and go.
    if (frame % 50 == 0) asker = cache.asker(pages_a_frame);
    const Cache::View view = cache.view();
    const Cache::View copy = view;
    wanted.clear();
    std::array<const NumberPage*, pages_a_frame> there{};
    const auto key_of = [&](std::size_t i) { return hashed(seed, frame / 4, i) % keys; };
    for (std::size_t i = 0; i < pages_a_frame; ++i) {
      there[i] = (i % 2 == 0 ? view : copy).find(key_of(i));
      if (there[i] == nullptr) wanted.push_back(key_of(i));
    }
    asker.request(wanted);
    // They stay as they are as long as the view does, whatever is loaded meanwhile.
    for (int look = 0; look < 3; ++look) {
      std::this_thread::yield();
      for (std::size_t i = 0; i < pages_a_frame; ++i) {
        if (there[i] != nullptr && (there[i]->key != key_of(i) || !there[i]->is_as_named())) ++wrong;
      }
    }
  }
  return wrong;
}

TEST(TileCache, PagesStayWhileAViewHoldsThemWhateverOthersDo) {
  constexpr std::size_t most_pages = 24;
  Cache cache(std::make_shared<const NumberSource>(), most_pages, 2);
  std::array<std::size_t, 3> wrong{};
  {
    std::vector<std::jthread> renderers;
    for (std::size_t i = 0; i < wrong.size(); ++i) {
      renderers.emplace_back([&, i](const std::stop_token& stops) { wrong[i] = wrong_pages_of(cache, i, stops); });
    }
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (CacheReport now; now.evicted < 2000 && std::chrono::steady_clock::now() < deadline; now = cache.report()) {
      EXPECT_LE(now.bytes, most_pages);
      std::this_thread::yield();
    }
  }
  EXPECT_EQ(wrong, (std::array<std::size_t, 3>{}));
  EXPECT_GE(cache.report().evicted, 2000U);
}

TEST(TileCache, MakesRoomForWhatIsWanted) {
  Cache cache(std::make_shared<const NumberSource>(), 2);
  for (Key key = 0; key < 20; ++key) {
    cache.load(std::array<Key, 1>{key});
    const Cache::View view = cache.view();
    const NumberPage* const page = view.find(key);
    ASSERT_NE(page, nullptr) << key;
    EXPECT_TRUE(page->is_as_named()) << key;
    // It grows old.
    (void)cache.view();
    (void)cache.view();
  }
  EXPECT_EQ(cache.report().evicted, 18U);
  EXPECT_EQ(cache.report().refused, 0U);
}

TEST(TileCache, KeepsAPageForWhoeverLooksAtIt) {
  Cache cache(std::make_shared<const NumberSource>(), 2);
  cache.load(std::array<Key, 2>{7, 8});
  Cache::View view = cache.view();
  const NumberPage* const seven = view.find(7);
  ASSERT_NE(seven, nullptr);
  ASSERT_NE(view.find(8), nullptr);
  // Frames that look at nothing make these pages old, but they are still looked at by the first.
  (void)cache.view();
  (void)cache.view();
  cache.load(std::array<Key, 1>{9});
  EXPECT_EQ(cache.view().find(9), nullptr);
  EXPECT_TRUE(seven->is_as_named());
  EXPECT_EQ(seven->key, 7U);
  view = {};
  cache.load(std::array<Key, 1>{9});
  EXPECT_NE(cache.view().find(9), nullptr);
  EXPECT_EQ(cache.report().refused, 0U) << "pages gave way";
}

TEST(TileCache, RefusesWhatIsWantedBesideAllThatFramesLookAt) {
  Cache cache(std::make_shared<const NumberSource>(), 2);
  cache.load(std::array<Key, 2>{7, 8});
  const Cache::View view = cache.view();
  ASSERT_NE(view.find(7), nullptr);
  ASSERT_NE(view.find(8), nullptr);
  cache.load(std::array<Key, 1>{9});
  EXPECT_EQ(cache.report().refused, 1U);
  EXPECT_EQ(cache.report().evicted, 0U);
}

// A renderer without a pause: there always is a frame that holds all pages that were there when it began.
TEST(TileCache, MakesRoomForAllThatIsWantedWithinAFrame) {
  Cache cache(std::make_shared<const NumberSource>(), 8);
  cache.load(std::array<Key, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  (void)cache.view();
  (void)cache.view();
  const std::array<Key, 4> wanted{10, 11, 12, 13};
  Cache::View frame = cache.view();
  cache.load(wanted);
  frame = cache.view();
  cache.load(wanted);
  frame = cache.view();
  for (const Key key : wanted) EXPECT_NE(frame.find(key), nullptr) << key;
  EXPECT_EQ(cache.report().evicted, 4U);
  EXPECT_EQ(cache.report().refused, 0U);
}

// Another's frame looks at all pages when somebody asks for one more, and is done a little later.
TEST(TileCache, WhoWaitsGivesFramesTimeToLetGo) {
  Cache cache(std::make_shared<const NumberSource>(), 2);
  cache.load(std::array<Key, 2>{7, 8});
  Cache::View frame = cache.view();
  (void)cache.view();
  (void)cache.view();
  const std::jthread renderer([&frame] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    frame = {};
  });
  cache.load(std::array<Key, 1>{9});
  EXPECT_NE(cache.view().find(9), nullptr);
  EXPECT_EQ(cache.report().refused, 0U);
}

TEST(TileCache, AsksAgainForWhatCouldNotBeHad) {
  std::atomic<bool> is_out = true;
  std::atomic<int> asked = 0;
  auto source = std::make_shared<NumberSource>();
  source->is_out = [&] {
    ++asked;
    return is_out.load();
  };
  const std::array<Key, 1> wanted{5};
  {
    Cache patient(source, 4, 1, std::chrono::hours(1));
    patient.load(wanted);
    patient.load(wanted);
    EXPECT_EQ(asked, 1) << "not at once";
    EXPECT_EQ(patient.report().absent, 1U);
  }
  Cache cache(source, 4, 1, std::chrono::milliseconds(0));
  cache.load(wanted);
  EXPECT_EQ(cache.view().find(5), nullptr);
  EXPECT_EQ(cache.report().absent, 1U);
  is_out = false;
  cache.load(wanted);
  EXPECT_NE(cache.view().find(5), nullptr);
  EXPECT_EQ(cache.report().absent, 0U);
}

/// A source that is short of something for all pages as long as it is told to be.
std::shared_ptr<NumberSource> short_source(const std::atomic<bool>& is_short) {
  auto source = std::make_shared<NumberSource>();
  source->is_short_of = [&is_short](Key) { return is_short.load(); };
  return source;
}

constexpr std::chrono::milliseconds at_once{0};

TEST(TileCache, MakesAnewWhatLackedSomethingOnceThatCanBeHad) {
  std::atomic<bool> is_short = true;
  const std::array<Key, 2> wanted{5, 6};
  Cache cache(short_source(is_short), 4, 1, at_once);
  cache.load(wanted);
  {
    const Cache::View view = cache.view();
    ASSERT_NE(view.find(5), nullptr);
    EXPECT_TRUE(view.find(5)->another_try.is_due());
    is_short = false;
    // A frame that looks at the former pages has them as they were.
    cache.load(wanted);
    EXPECT_TRUE(view.find(5)->lacks_something);
    EXPECT_TRUE(view.find(5)->is_as_named());
  }
  const Cache::View view = cache.view();
  for (const Key key : wanted) {
    ASSERT_NE(view.find(key), nullptr) << key;
    EXPECT_FALSE(view.find(key)->lacks_something) << key;
    EXPECT_FALSE(view.find(key)->another_try.is_due()) << key;
    EXPECT_TRUE(view.find(key)->is_as_named()) << key;
  }
  EXPECT_EQ(cache.report().renewed, 2U);
  EXPECT_EQ(cache.report().loaded, 2U);
  EXPECT_EQ(cache.report().pages, 2U);
}

TEST(TileCache, LeavesWhatLacksSomethingAloneForAWhile) {
  std::atomic<bool> is_short = true;
  Cache cache(short_source(is_short), 4, 1, std::chrono::hours(1));
  const std::array<Key, 1> wanted{5};
  cache.load(wanted);
  is_short = false;
  EXPECT_FALSE(cache.view().find(5)->another_try.is_due());
  cache.load(wanted);
  EXPECT_EQ(cache.report().renewed, 0U);
}

TEST(TileCache, GivesNothingUpForWhatIsNeverThere) {
  const std::atomic<bool> is_short = true;
  Cache cache(short_source(is_short), 2, 1, at_once);
  const std::array<Key, 1> wanted{5};
  cache.load(std::array<Key, 2>{5, 6});
  const NumberPage* const five = cache.view().find(5);
  for (int again = 0; again < 6; ++again) {
    (void)cache.view();
    cache.load(wanted);
  }
  EXPECT_EQ(cache.view().find(5), five);
  EXPECT_NE(cache.view().find(6), nullptr);
  EXPECT_EQ(cache.report().renewed + cache.report().evicted + cache.report().refused, 0U);
}

TEST(TileCache, MakesAnewAPageThatFillsTheCacheAlone) {
  std::atomic<bool> is_short = true;
  Cache cache(short_source(is_short), 1, 1, at_once);
  const std::array<Key, 1> wanted{5};
  cache.load(wanted);
  is_short = false;
  ASSERT_NE(cache.view().find(5), nullptr);
  cache.load(wanted);
  // Whatever gave way, a frame later it is asked for again.
  cache.load(wanted);
  const Cache::View view = cache.view();
  ASSERT_NE(view.find(5), nullptr);
  EXPECT_FALSE(view.find(5)->lacks_something);
  EXPECT_EQ(cache.report().refused, 0U);
  EXPECT_LE(cache.report().bytes, 1U);
}

// The system's own exceptions, of a link that leads nowhere or a disk that is gone, are thrown in the loader's thread.
TEST(TileCache, GoesOnWhateverASourceThrows) {
  std::atomic<bool> is_gone = true;
  auto source = std::make_shared<NumberSource>();
  source->before_filling = [&] {
    if (is_gone) throw std::filesystem::filesystem_error("status", std::make_error_code(std::errc::io_error));
  };
  Cache cache(source, 4, 1, at_once);
  cache.load(std::array<Key, 1>{5});
  EXPECT_EQ(cache.view().find(5), nullptr);
  EXPECT_EQ(cache.report().absent, 1U);
  is_gone = false;
  cache.load(std::array<Key, 1>{5});
  EXPECT_NE(cache.view().find(5), nullptr);
}

TEST(TileCache, GoesOnWhereThereIsNoMemoryForAPage) {
  std::atomic<bool> is_short = true;
  auto source = std::make_shared<NumberSource>();
  source->before_filling = [&] {
    if (is_short) throw std::bad_alloc();
  };
  Cache cache(source, 4);
  cache.load(std::array<Key, 2>{5, 6});
  EXPECT_EQ(cache.view().find(5), nullptr);
  EXPECT_GE(cache.report().refused, 1U);
  is_short = false;
  cache.load(std::array<Key, 2>{5, 6});
  EXPECT_NE(cache.view().find(5), nullptr);
  EXPECT_NE(cache.view().find(6), nullptr);
}

TEST(TileCache, WhoWaitsCanBeToldToStop) {
  std::promise<void> go_on;
  const std::shared_future<void> may_go_on = go_on.get_future().share();
  auto source = std::make_shared<NumberSource>();
  source->before_filling = [&] { may_go_on.wait(); };
  Cache cache(source, 8);
  {
    const Interruption interruption([] { return true; });
    EXPECT_THROW(cache.load(std::array<Key, 1>{1}), Interrupted);
  }
  go_on.set_value();
}

// A thread that has locked what loaders lock is stopped there.
TEST(TileCache, AFrameGoesOnWhileTheCacheIsLocked) {
  std::promise<void> is_locked, unlock;
  const std::shared_future<void> may_unlock = unlock.get_future().share();
  auto source = std::make_shared<NumberSource>();
  source->asked_for_damage = [&] {
    is_locked.set_value();
    may_unlock.wait();
    return std::size_t{0};
  };
  Cache cache(source, 8);
  cache.load(std::array<Key, 1>{1});
  Cache::Asker asker = cache.asker(1);
  const std::jthread reporter([&cache] { (void)cache.report(); });
  is_locked.get_future().wait();
  auto frame = std::async(std::launch::async, [&] {
    const Cache::View view = cache.view();
    asker.request(std::array<Key, 1>{2});
    return view.find(1) != nullptr;
  });
  const bool waited = frame.wait_for(std::chrono::seconds(20)) != std::future_status::ready;
  unlock.set_value();
  EXPECT_FALSE(waited);
  EXPECT_TRUE(frame.get());
  cache.wait_until_loaded();
  EXPECT_NE(cache.view().find(2), nullptr);
}

}  // namespace
}  // namespace sigmascape::live
