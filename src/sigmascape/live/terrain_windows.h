#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "sigmascape/live/published.h"
#include "sigmascape/live/wishes.h"
#include "sigmascape/terrain/terrain_pyramid.h"
#include "sigmascape/terrain/terrain_window.h"

namespace sigmascape::live {

/// A piece of terrain that a frame needs, and of which level.
struct WindowWish {
  int level = 0;
  radar::Rectangle area;
};

/// A piece of terrain in one lattice; once it can be found it never changes.
struct GroundWindow {
  GroundWindow(std::size_t most_nodes_per_side) : nodes(most_nodes_per_side, terrain::WindowSlopes::None) {}

  terrain::TerrainWindow nodes;
  int level = 0;
  float error_m = 0.0F;  ///< by how much it may differ from that level, where tiles could not be had
  /// From when on tiles that could not be had are worth another try; nothing when it has all.
  std::optional<std::chrono::steady_clock::time_point> try_again_at = {};
  mutable std::atomic<std::uint64_t> last_wanted{0};

  [[nodiscard]] bool covers(const radar::Rectangle& area) const;
  [[nodiscard]] bool is_worth_another_try() const {
    return try_again_at && std::chrono::steady_clock::now() > *try_again_at;
  }
};

/// Terrain as frames want it, joined in lattices behind the back of whoever renders.
///
/// A frame takes a view, which never changes under its hands, finds in it the terrain that covers what it looks at, and
/// afterwards says what it would have liked. It never waits for any other thread. Windows are somewhat larger than what
/// was asked for, so that a radar that moves needs a new one only now and then. Any number of renderers may share them.
class TerrainWindows {
  using Entries = std::vector<std::shared_ptr<const GroundWindow>>;

 public:
  /// The budget is that of all windows together; one holds a ninth of it at most.
  TerrainWindows(std::shared_ptr<terrain::TerrainPyramid> pyramid, std::size_t budget_bytes);
  ~TerrainWindows();
  TerrainWindows(const TerrainWindows&) = delete;
  TerrainWindows& operator=(const TerrainWindows&) = delete;

  /// What was there at one moment. Must not outlive the windows.
  class View {
   public:
    /// Of the windows that cover the area the one whose level comes nearest to the wish, the finer of two and the one
    /// with the lesser error; null when there is none. Marks it as wanted by this view's frame.
    [[nodiscard]] const GroundWindow* find(const WindowWish& wish) const;

   private:
    friend class TerrainWindows;
    Published<Entries>::Reading entries_;
    std::uint64_t frame_ = 0;
  };

  /// Call at the start of a frame; drop it at its end, for windows live while a view holds them.
  [[nodiscard]] View view();

  /// What to wish for: of the area what there is terrain of, at the given level or the next coarser at which a window
  /// holds it.
  [[nodiscard]] WindowWish wish_for(int level, const radar::Rectangle& area) const;

  /// What a frame says at its end: Asker::request() hands over the windows to make, the dearest first. What whoever
  /// asked last wants comes first.
  using Asker = Wishes<WindowWish>::Asker;
  /// For whoever renders, once: takes the memory for so many windows a frame.
  [[nodiscard]] Asker asker(std::size_t most_windows) { return wishes_.asker(most_windows); }

  // These are for callers who would rather wait than see less.

  /// Returns when all that was asked for is there. Throws Interrupted when this thread is told to stop.
  void wait_until_loaded();
  /// Asks for windows and waits for them.
  void load(std::span<const WindowWish> wanted);

  /// Of all windows that are there.
  [[nodiscard]] std::size_t bytes() const;

 private:
  void make_windows();
  /// Null when there is no memory for it: frames ask again.
  [[nodiscard]] std::shared_ptr<const GroundWindow> made(const WindowWish& wish);
  [[nodiscard]] radar::Rectangle with_margin(const WindowWish& wish) const;
  // All of these with the guard held.
  [[nodiscard]] bool next_wish(WindowWish& wish);
  void publish(std::shared_ptr<const GroundWindow> window, const WindowWish& wish);

  std::shared_ptr<terrain::TerrainPyramid> pyramid_;
  std::size_t budget_bytes_, most_nodes_per_side_;

  mutable std::mutex guard_;
  std::condition_variable request_done_;
  Wishes<WindowWish> wishes_;
  Published<Entries> entries_;
  // No longer found; others share one that a frame may still read.
  std::vector<std::shared_ptr<const GroundWindow>> retired_;
  bool busy_ = false, stopping_ = false;
  std::atomic<std::uint64_t> frame_{0};
  std::jthread maker_;
};

}  // namespace sigmascape::live
