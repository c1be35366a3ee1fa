#include "sigmascape/render/page_cache.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <tuple>
#include <utility>

#include "sigmascape/base/error.h"

namespace sigmascape::render {
namespace {

using Entry = std::shared_ptr<const GroundPage>;

const PageKey& key_of(const Entry& entry) {
  return entry->key;
}

bool holds(const std::vector<PageKey>& keys, const PageKey& key) {
  return std::ranges::any_of(keys, [&key](const PageKey& other) { return other == key; });
}

/// Whether nobody reads the retired page any more.
bool is_let_go(const std::shared_ptr<GroundPage>& page) {
  if (page.use_count() != 1) return false;
  // That the count has fallen does not yet order what its last reader did before what is written into the page next.
  // To give back a share of one's own does.
  std::shared_ptr<GroundPage>(page).reset();
  return true;
}

}  // namespace

PageCache::PageCache(std::shared_ptr<const PageSource> source, const CacheOptions& options)
    : source_(std::move(source)), options_(options), entries_(std::make_shared<const Entries>()) {
  page_bytes_ = source_->most_bytes();
  if (most_pages() == 0) {
    throw Error("page cache", fmt::format("has a budget of {} bytes", options_.budget_bytes),
                fmt::format("a page of ground takes {} bytes; give some tens of them", page_bytes_));
  }
  for (unsigned loader = 0; loader < std::max(1U, options_.loaders); ++loader) {
    loaders_.emplace_back([this] { load_pages(); });
  }
}

PageCache::~PageCache() {
  {
    const std::lock_guard lock(guard_);
    stopping_ = true;
  }
  request_came_.notify_all();
}

PageCache::View PageCache::view() {
  View view;
  view.entries_ = entries_.load();
  view.frame_ = frame_.fetch_add(1) + 1;
  return view;
}

const GroundPage* PageCache::View::find(const PageKey& key) const {
  const auto found = std::ranges::lower_bound(*entries_, key, {}, key_of);
  if (found == entries_->end() || (*found)->key != key) return nullptr;
  (*found)->last_wanted.store(frame_, std::memory_order_relaxed);
  return found->get();
}

void PageCache::request(std::span<const PageKey> wanted, const void* asker) {
  const std::lock_guard lock(guard_);
  std::erase_if(wanted_, [asker](const Wish& wish) { return wish.asker == asker; });
  std::transform(wanted.rbegin(), wanted.rend(), std::back_inserter(wanted_), [asker](const PageKey& key) {
    return Wish{key, asker};
  });
  (wanted_.empty() ? request_done_ : request_came_).notify_all();
}

void PageCache::wait_until_loaded() {
  std::unique_lock lock(guard_);
  request_done_.wait(lock, [this] { return wanted_.empty() && loading_.empty(); });
}

CacheReport PageCache::report() const {
  const std::lock_guard lock(guard_);
  CacheReport report = report_;
  report.pages = entries_.load()->size();
  report.damaged = source_->damaged();
  report.bytes = (report.pages + retired_.size() + loading_.size()) * page_bytes_;
  return report;
}

void PageCache::load_pages() {
  std::unique_lock lock(guard_);
  while (true) {
    PageKey key;
    request_came_.wait(lock, [&] { return stopping_ || next_wanted(key); });
    if (stopping_) return;
    const std::shared_ptr<GroundPage> page = empty_page();
    if (!page) {
      // Everything there is looked at: what is wanted now has to wait until frames look elsewhere.
      ++report_.refused;
      wanted_.clear();
      request_done_.notify_all();
      continue;
    }
    loading_.push_back(key);
    lock.unlock();
    page->key = key;
    const bool found = source_->fill(*page);
    lock.lock();
    std::erase(loading_, key);
    if (found) {
      ++report_.loaded;
      page->last_wanted = frame_.load();
      publish(page);
    } else {
      ++report_.absent;
      absent_.push_back(key);
      retired_.push_back(page);
    }
    request_done_.notify_all();
  }
}

bool PageCache::next_wanted(PageKey& key) {
  const auto entries = entries_.load();
  while (!wanted_.empty()) {
    key = wanted_.back().key;
    wanted_.pop_back();
    const bool there = std::ranges::binary_search(*entries, key, {}, key_of);
    if (!there && !holds(loading_, key) && !holds(absent_, key)) return true;
  }
  request_done_.notify_all();
  return false;
}

std::shared_ptr<GroundPage> PageCache::empty_page() {
  const auto free_one = [this]() -> std::shared_ptr<GroundPage> {
    const auto free = std::ranges::find_if(retired_, is_let_go);
    if (free == retired_.end()) return nullptr;
    std::shared_ptr<GroundPage> page = std::move(*free);
    retired_.erase(free);
    return page;
  };
  if (auto page = free_one()) return page;
  const std::size_t pages = entries_.load()->size() + retired_.size() + loading_.size();
  if (pages < most_pages()) return std::make_shared<GroundPage>();
  drop_oldest_page();
  return free_one();
}

void PageCache::drop_oldest_page() {
  const auto entries = entries_.load();
  // Of equally old ones the finer goes: its parent can stand in for it. The coarsest have none and stay.
  const std::size_t coarsest = source_->levels() - 1;
  const auto oldest = std::ranges::min_element(*entries, {}, [coarsest](const Entry& entry) {
    const std::size_t level = entry->key.tile.level;
    return std::tuple(level == coarsest, entry->last_wanted.load(std::memory_order_relaxed), level);
  });
  if (oldest == entries->end() || (*oldest)->key.tile.level == coarsest ||
      (*oldest)->last_wanted.load(std::memory_order_relaxed) + 1 >= frame_.load())
    return;
  auto rest = std::make_shared<Entries>();
  rest->reserve(entries->size());
  std::ranges::copy_if(*entries, std::back_inserter(*rest), [&](const Entry& entry) { return entry != *oldest; });
  // Whoever found the page may read on; its memory is used again when the last of them has let go.
  retired_.push_back(std::const_pointer_cast<GroundPage>(*oldest));
  entries_.store(std::move(rest));
  ++report_.evicted;
}

void PageCache::publish(std::shared_ptr<GroundPage> page) {
  const auto entries = entries_.load();
  auto grown = std::make_shared<Entries>(*entries);
  const auto place = std::ranges::lower_bound(*grown, page->key, {}, key_of);
  grown->insert(place, std::move(page));
  entries_.store(std::move(grown));
}

}  // namespace sigmascape::render
