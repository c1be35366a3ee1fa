#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/failed_lately.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/live/published.h"
#include "sigmascape/live/wishes.h"

namespace sigmascape::live {

struct CacheReport {
  std::size_t pages = 0;      ///< there now
  std::size_t bytes = 0;      ///< that they take
  std::uint64_t loaded = 0;   ///< since the start
  std::uint64_t renewed = 0;  ///< made anew, when some of what they had lacked could be had
  std::uint64_t evicted = 0;
  std::size_t absent = 0;   ///< pages that, when last asked for, the store did not have, or not whole
  std::size_t damaged = 0;  ///< files of the store, met so far, that are not as their items say
  /// Times that no page could give way, so that the budget is below what frames look at, or the system had no memory.
  std::uint64_t refused = 0;
};

/// Pages of ground, or of what stands on it, loaded behind the back of whoever renders and dropped when others are
/// wanted more.
///
/// A frame takes a view, which never changes under its hands, finds in it what is there, and afterwards says what it
/// would have liked. It waits neither for a page nor for any thread that deals with pages or with another frame. Any
/// number of renderers may share one cache.
///
/// A `Source` makes pages: it names their type `Source::Page`, fills one in any thread as its `key` says (false when it
/// cannot be had, which is tried again now and then), and tells how many bytes one takes at most, which never give way
/// to others once they are there, and how many files were found damaged.
///
/// A page may lack something for which something coarser stands in (`Source::lacks_something`). Its `another_try` is
/// due a while later; when a frame asks for it then, the source tells whether it can be better by now
/// (`can_be_better`), and only if so makes another from it (`renew`) that takes its place.
template <typename Source>
class TileCache {
 public:
  using Page = typename Source::Page;
  using Key = decltype(Page::key);

 private:
  using Entries = std::vector<std::shared_ptr<const Page>>;  // ordered by key

 public:
  /// Throws Error when the budget does not hold a single page, or when the system gives no thread to load them. One
  /// that gives fewer than `loaders` is made do with.
  TileCache(std::shared_ptr<const Source> source, std::size_t budget_bytes, unsigned loaders = 1,
            std::chrono::milliseconds patience = before_another_try);
  ~TileCache();
  TileCache(const TileCache&) = delete;
  TileCache& operator=(const TileCache&) = delete;

  /// What was there at one moment. Copies of it may be taken to other threads; none may outlive the cache.
  class View {
   public:
    /// Null when the page is not there. Marks it as wanted by this view's frame.
    [[nodiscard]] const Page* find(const Key& key) const;
    [[nodiscard]] std::uint64_t frame() const { return frame_; }

   private:
    friend class TileCache;
    typename Published<Entries>::Reading entries_;
    std::uint64_t frame_ = 0;
  };

  /// Call at the start of a frame; drop it at its end, for pages live while a view holds them.
  [[nodiscard]] View view();

  /// What a frame says at its end: Asker::request() hands over the pages to load, the dearest first. What whoever asked
  /// last wants comes first.
  using Asker = typename Wishes<Key>::Asker;
  /// For whoever renders, once: takes the memory for so many pages a frame.
  [[nodiscard]] Asker asker(std::size_t most_pages) { return wishes_.asker(most_pages); }

  // These are for callers who would rather wait than see less.

  /// Returns when all that was asked for is there or cannot be. Frames that others are at are given a second to let go
  /// of pages that have to give way. Throws Interrupted when this thread is told to stop.
  void wait_until_loaded();
  /// Asks for pages and waits for them.
  void load(std::span<const Key> wanted);

  [[nodiscard]] CacheReport report() const;
  /// How many pages the budget holds.
  [[nodiscard]] std::size_t most_pages() const { return budget_bytes_ / page_bytes_; }
  [[nodiscard]] const Source& source() const { return *source_; }

 private:
  using Entry = std::shared_ptr<const Page>;

  [[nodiscard]] static const Key& key_of(const Entry& entry) { return entry->key; }
  [[nodiscard]] bool is_loading(const Key& key) const { return std::ranges::find(loading_, key) != loading_.end(); }
  void load_pages();
  /// From a former one, where there is one. Nothing when there is no memory for what it takes.
  [[nodiscard]] std::optional<bool> filled(Page& page, const Entry& former) const;
  [[nodiscard]] bool can_be_better(const Page& page) const;
  // All of these with the guard held.
  /// Null when it is not there.
  [[nodiscard]] Entry there(const Key& key) const;
  /// What `work` gives back, which is called while others may have the guard, but not load this page. It must not
  /// throw.
  template <typename Work>
  auto away_with(const Key& key, std::unique_lock<std::mutex>& lock, Work work);
  /// Loads the page, or makes it anew, while others may have the guard.
  void load_one(const Key& key, std::unique_lock<std::mutex>& lock);
  void wait_for_loaders(std::unique_lock<std::mutex>& lock);
  [[nodiscard]] bool next_wanted(Key& key);
  /// Null when there is none: all are looked at, or give way once the frames of now are done. To one that is to be made
  /// anew one other gives way, to one that is not there as many as are wanted.
  [[nodiscard]] std::shared_ptr<Page> empty_page(bool is_anew);
  /// Drops up to so many pages that no frame has looked at lately.
  void drop_oldest_pages(std::size_t most);
  void drop(std::span<const Entry> pages);
  /// In place of one of the same key.
  void publish(std::shared_ptr<Page> page);

  std::shared_ptr<const Source> source_;
  std::size_t budget_bytes_;

  mutable std::mutex guard_;
  std::condition_variable request_done_;
  Wishes<Key> wishes_;
  Published<Entries> entries_;
  std::vector<std::shared_ptr<Page>> retired_;  // no longer found; others share one that a frame may still read
  std::vector<Key> loading_;                    // or looked after
  std::size_t in_hand_ = 0;                     // pages that are being filled
  FailedLately<Key> absent_;
  std::atomic<std::uint64_t> frame_{0};
  std::size_t page_bytes_ = 0;  // of one
  CacheReport report_;
  bool stopping_ = false;
  std::vector<std::jthread> loaders_;
};

template <typename Source>
TileCache<Source>::TileCache(std::shared_ptr<const Source> source, std::size_t budget_bytes, unsigned loaders,
                             std::chrono::milliseconds patience)
    : source_(std::move(source)), budget_bytes_(budget_bytes), entries_(Entries()), absent_(patience) {
  page_bytes_ = source_->most_bytes();
  if (most_pages() == 0) {
    throw Error("page cache", fmt::format("has a budget of {} bytes", budget_bytes_),
                fmt::format("a page of ground takes {} bytes; give some tens of them", page_bytes_));
  }
  for (unsigned loader = 0; loader < std::max(1U, loaders); ++loader) {
    try {
      loaders_.emplace_back([this] { load_pages(); });
    } catch (const std::exception&) {  // no thread, or no memory for one
      if (loaders_.empty()) throw Error("page cache", "gets no thread from the system", "allow more threads");
      return;
    }
  }
}

template <typename Source>
TileCache<Source>::~TileCache() {
  {
    const std::lock_guard lock(guard_);
    stopping_ = true;
  }
  wishes_.ring();
}

template <typename Source>
typename TileCache<Source>::View TileCache<Source>::view() {
  View view;
  view.entries_ = entries_.load();
  view.frame_ = frame_.fetch_add(1) + 1;
  return view;
}

template <typename Source>
const typename TileCache<Source>::Page* TileCache<Source>::View::find(const Key& key) const {
  const auto found = std::ranges::lower_bound(*entries_, key, {}, &key_of);
  if (found == entries_->end() || (*found)->key != key) return nullptr;
  (*found)->last_wanted.store(frame_, std::memory_order_relaxed);
  return found->get();
}

template <typename Source>
void TileCache<Source>::wait_until_loaded() {
  using namespace std::chrono_literals;
  const auto long_enough = std::chrono::steady_clock::now() + 1s;
  std::unique_lock lock(guard_);
  wait_for_loaders(lock);
  while (wishes_.has_put_off() && std::chrono::steady_clock::now() < long_enough) {
    lock.unlock();
    Interruption::heed();
    std::this_thread::sleep_for(1ms);
    wishes_.renew();
    lock.lock();
    wait_for_loaders(lock);
  }
}

template <typename Source>
void TileCache<Source>::wait_for_loaders(std::unique_lock<std::mutex>& lock) {
  using namespace std::chrono_literals;
  while (!request_done_.wait_for(lock, 50ms, [this] { return wishes_.empty() && loading_.empty(); })) {
    lock.unlock();
    Interruption::heed();
    lock.lock();
  }
}

template <typename Source>
void TileCache<Source>::load(std::span<const Key> wanted) {
  Asker caller = asker(wanted.size());
  caller.request(wanted);
  wait_until_loaded();
}

template <typename Source>
CacheReport TileCache<Source>::report() const {
  const std::lock_guard lock(guard_);
  CacheReport report = report_;
  report.pages = entries_.newest().size();
  report.absent = absent_.size();
  report.damaged = source_->damaged();
  report.bytes = (report.pages + retired_.size() + in_hand_) * page_bytes_;
  return report;
}

template <typename Source>
void TileCache<Source>::load_pages() {
  std::unique_lock lock(guard_);
  while (!stopping_) {
    const std::uint32_t calls = wishes_.calls();
    Key key;
    if (!next_wanted(key)) {
      request_done_.notify_all();
      lock.unlock();
      wishes_.wait_beyond(calls);
      lock.lock();
      continue;
    }
    load_one(key, lock);
    request_done_.notify_all();
  }
}

template <typename Source>
typename TileCache<Source>::Entry TileCache<Source>::there(const Key& key) const {
  const Entries& entries = entries_.newest();
  const auto found = std::ranges::lower_bound(entries, key, {}, &key_of);
  return found != entries.end() && (*found)->key == key ? *found : nullptr;
}

template <typename Source>
template <typename Work>
auto TileCache<Source>::away_with(const Key& key, std::unique_lock<std::mutex>& lock, Work work) {
  loading_.push_back(key);
  lock.unlock();
  const auto result = work();
  lock.lock();
  std::erase(loading_, key);
  return result;
}

template <typename Source>
void TileCache<Source>::load_one(const Key& key, std::unique_lock<std::mutex>& lock) try {
  const Entry former = there(key);
  if (former && !away_with(key, lock, [&] { return can_be_better(*former); })) {
    return former->another_try.after(absent_.patience());
  }
  if (there(key) != former) return;  // it gave way meanwhile
  const std::shared_ptr<Page> page = empty_page(former != nullptr);
  if (!page && retired_.empty()) {
    // Everything there is looked at. A page that is to be made anew gives way to itself, and is read as one that is not
    // there.
    if (former && !source_->stays(*former)) {
      drop({&former, 1});
      return wishes_.put_off();
    }
    // What is wanted now has to wait until frames look elsewhere, and ask again.
    if (former) former->another_try.after(absent_.patience());
    ++report_.refused;
    return wishes_.clear();
  }
  // What gave way is still looked at.
  if (!page) return wishes_.put_off();
  retired_.reserve(retired_.size() + 1);
  loading_.reserve(loading_.size() + 1);
  page->key = key;
  ++in_hand_;
  const std::optional<bool> found = away_with(key, lock, [&] { return filled(*page, former); });
  --in_hand_;
  if (!found) throw std::bad_alloc();
  if (*found) {
    page->last_wanted = frame_.load();
    if (source_->lacks_something(*page)) {
      page->another_try.after(absent_.patience());
    } else {
      page->another_try.never();
    }
    publish(page);
    absent_.erase(key);
    ++(former ? report_.renewed : report_.loaded);
  } else {
    retired_.push_back(page);
    if (former) {
      former->another_try.after(absent_.patience());
    } else {
      absent_.add(key);
    }
  }
} catch (const std::bad_alloc&) {
  // There may be memory when frames ask again.
  ++report_.refused;
  wishes_.clear();
}

template <typename Source>
std::optional<bool> TileCache<Source>::filled(Page& page, const Entry& former) const try {
  return former ? source_->renew(*former, page) : source_->fill(page);
} catch (const std::bad_alloc&) {
  return std::nullopt;
} catch (const std::exception&) {  // the system's own, of a disk that is gone: frames go on without the page
  return false;
}

template <typename Source>
bool TileCache<Source>::can_be_better(const Page& page) const try {
  return source_->can_be_better(page);
} catch (const std::exception&) {
  return false;
}

template <typename Source>
bool TileCache<Source>::next_wanted(Key& key) {
  while (wishes_.take(key)) {
    if (is_loading(key)) continue;
    const Entry found = there(key);
    if (found ? found->another_try.is_due() : !absent_.holds(key)) return true;
  }
  return false;
}

template <typename Source>
std::shared_ptr<typename TileCache<Source>::Page> TileCache<Source>::empty_page(bool is_anew) {
  const auto free_one = [this]() -> std::shared_ptr<Page> {
    entries_.forget_unread();
    const auto free = std::ranges::find_if(retired_, [](const auto& page) { return page.use_count() == 1; });
    if (free == retired_.end()) return nullptr;
    std::shared_ptr<Page> page = std::move(*free);
    retired_.erase(free);
    return page;
  };
  if (auto page = free_one()) return page;
  const std::size_t pages = entries_.newest().size() + retired_.size() + in_hand_;
  if (pages < most_pages()) return std::make_shared<Page>();
  if (retired_.empty()) drop_oldest_pages(1);
  if (auto page = free_one()) return page;
  // What gave way is still read. When frames are done with it, there is room for all that is wanted.
  const auto is_absent = [this](const Key& key) { return there(key) == nullptr; };
  const std::size_t wanted = 1 + (is_anew ? 0 : wishes_.count_if(is_absent));
  if (retired_.size() < wanted) drop_oldest_pages(wanted - retired_.size());
  return nullptr;
}

template <typename Source>
void TileCache<Source>::drop_oldest_pages(std::size_t most) {
  struct Aged {
    std::uint64_t last_wanted;
    std::size_t level;
    Entry entry;
  };
  std::vector<Aged> old;
  for (const Entry& entry : entries_.newest()) {
    const std::uint64_t last_wanted = entry->last_wanted.load(std::memory_order_relaxed);
    if (!source_->stays(*entry) && last_wanted + 1 < frame_.load()) old.push_back({last_wanted, entry->level(), entry});
  }
  // Of equally old ones the finer goes: its parent can stand in for it.
  std::ranges::stable_sort(old, {}, [](const Aged& page) { return std::tuple(page.last_wanted, page.level); });
  old.resize(std::min(old.size(), most));
  std::vector<Entry> dropped;
  for (Aged& page : old) dropped.push_back(std::move(page.entry));
  drop(dropped);
}

template <typename Source>
void TileCache<Source>::drop(std::span<const Entry> pages) {
  if (pages.empty()) return;
  Entries rest = entries_.newest();
  for (const Entry& page : pages) std::erase(rest, page);
  retired_.reserve(retired_.size() + pages.size());
  entries_.store(std::move(rest));
  // Whoever found one may read on; its memory is used again when the last of them has let go.
  for (const Entry& page : pages) retired_.push_back(std::const_pointer_cast<Page>(page));
  report_.evicted += pages.size();
}

template <typename Source>
void TileCache<Source>::publish(std::shared_ptr<Page> page) {
  Entries grown = entries_.newest();
  const auto place = std::ranges::lower_bound(grown, page->key, {}, &key_of);
  Entry former;
  if (place != grown.end() && (*place)->key == page->key) {
    former = std::exchange(*place, std::move(page));
  } else {
    grown.insert(place, std::move(page));
  }
  entries_.store(std::move(grown));
  if (former) retired_.push_back(std::const_pointer_cast<Page>(former));
}

}  // namespace sigmascape::live
