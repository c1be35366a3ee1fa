#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>

namespace sigmascape {

/// What ends a piece of work that was told to stop. No Error: nothing was wrong.
class Interrupted final : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "the work was told to stop"; }
};

/// While it lives, the parallel loops that its thread runs, and those within them on other threads, can be told to
/// stop, and so can loops that heed it: `is_wanted` is asked some twenty times a second, always on the thread that made
/// this, and from when it says so every loop throws Interrupted before its next index. What `is_wanted` throws ends the
/// loops as well. They nest: the innermost is asked. Make and destroy it on one thread.
class Interruption {
 public:
  explicit Interruption(std::function<bool()> is_wanted);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// That of the loop this thread works in, or nullptr.
  [[nodiscard]] static Interruption* current();
  /// For loops: throws Interrupted when it is time to stop.
  void poll();
  /// The same for loops that are not parallel, such as those that read files: a look at the clock where this thread can
  /// be told to stop, nothing elsewhere.
  static void heed() {
    if (Interruption* const wanted = current()) wanted->poll();
  }

  /// Makes a helping thread belong to the loop that it helps.
  class Membership {
   public:
    explicit Membership(Interruption* of);
    ~Membership();
    Membership(const Membership&) = delete;
    Membership& operator=(const Membership&) = delete;

   private:
    Interruption* before_;
  };

 private:
  using Clock = std::chrono::steady_clock;

  std::function<bool()> is_wanted_;
  std::thread::id owner_ = std::this_thread::get_id();
  std::atomic<bool> stops_{false};
  Clock::time_point asked_ = {};
  Membership membership_;
};

}  // namespace sigmascape
