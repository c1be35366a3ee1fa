#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "sigmascape/render/ground_page.h"
#include "sigmascape/render/page_source.h"
#include "sigmascape/render/published.h"

namespace sigmascape::render {

struct CacheOptions {
  std::size_t budget_bytes = std::size_t{512} << 20U;  ///< of all pages together
  unsigned loaders = 1;                                ///< threads that read and decode
  /// How closely a texture is looked at before its first tile is read. Content takes some milliseconds of a loader a
  /// texture, and finds what has been altered.
  atlas::Scrutiny scrutiny = atlas::Scrutiny::Content;
};

struct CacheReport {
  std::size_t pages = 0;     ///< there now
  std::size_t bytes = 0;     ///< that they take
  std::uint64_t loaded = 0;  ///< since the start
  std::uint64_t evicted = 0;
  std::uint64_t absent = 0;   ///< pages asked for that the store does not have, or not whole
  std::size_t damaged = 0;    ///< textures of the store, met so far, that are not as their items say
  std::uint64_t refused = 0;  ///< times that no page could give way: the budget is below what one frame looks at
};

/// Pages of ground, loaded behind the back of whoever renders and dropped when others are wanted more.
///
/// A frame takes a view, which never changes under its hands, finds in it what is there, and afterwards says what it
/// would have liked. It never waits for a page. Pages of the coarsest level stay once they are there, so that something
/// can stand in for what is missing. Any number of renderers may share one cache.
class PageCache {
  using Entries = std::vector<std::shared_ptr<const GroundPage>>;  // ordered by key

 public:
  /// Throws Error when the budget does not hold a single page.
  PageCache(std::shared_ptr<const PageSource> source, const CacheOptions& options);
  ~PageCache();
  PageCache(const PageCache&) = delete;
  PageCache& operator=(const PageCache&) = delete;

  /// What was there at one moment.
  class View {
   public:
    /// Null when the page is not there. Marks it as wanted by this view's frame.
    [[nodiscard]] const GroundPage* find(const PageKey& key) const;
    [[nodiscard]] std::uint64_t frame() const { return frame_; }

   private:
    friend class PageCache;
    std::shared_ptr<const Entries> entries_;
    std::uint64_t frame_ = 0;
  };

  /// Call at the start of a frame; drop it at its end, for pages live while a view holds them.
  [[nodiscard]] View view();

  /// Pages to load, the dearest first, in place of those that the same asker wanted before. For the end of a frame: the
  /// list is locked while it is handed over, never while pages are read.
  void request(std::span<const PageKey> wanted, const void* asker = nullptr);

  /// Returns when all that was asked for is there or cannot be: for callers who would rather wait than see less.
  void wait_until_loaded();

  [[nodiscard]] CacheReport report() const;
  /// How many pages the budget holds.
  [[nodiscard]] std::size_t most_pages() const { return options_.budget_bytes / page_bytes_; }
  [[nodiscard]] const PageSource& source() const { return *source_; }

 private:
  void load_pages();
  // All of these with the guard held.
  [[nodiscard]] bool next_wanted(PageKey& key);
  [[nodiscard]] std::shared_ptr<GroundPage> empty_page();
  void drop_oldest_page();
  void publish(std::shared_ptr<GroundPage> page);

  std::shared_ptr<const PageSource> source_;
  CacheOptions options_;

  mutable std::mutex guard_;
  std::condition_variable request_came_, request_done_;
  Published<Entries> entries_;
  std::vector<std::shared_ptr<GroundPage>> retired_;  // no longer found, perhaps still read by a frame
  struct Wish {
    PageKey key;
    const void* asker;
  };
  std::vector<Wish> wanted_;  // from its end: whoever asked last comes first
  std::vector<PageKey> loading_, absent_;
  std::atomic<std::uint64_t> frame_{0};
  std::size_t page_bytes_ = 0;  // of one
  CacheReport report_;
  bool stopping_ = false;
  std::vector<std::jthread> loaders_;
};

}  // namespace sigmascape::render
