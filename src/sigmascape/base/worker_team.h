#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace sigmascape {

/// Threads that stand ready for work that comes many times a second: starting a loop neither creates threads nor
/// allocates. For work that comes once, parallel_for is enough.
class WorkerTeam {
 public:
  /// A team of so many threads, the caller of run() among them; 0: one a hardware thread.
  explicit WorkerTeam(unsigned threads = 0);
  ~WorkerTeam();
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;

  [[nodiscard]] unsigned size() const { return static_cast<unsigned>(helpers_.size()) + 1; }

  /// Calls `body(index, worker)` once for every index below `count`, each on the thread that is free first, and returns
  /// when all are done. What `body` throws ends the round: indices that no thread has taken yet are left out, and the
  /// first that was thrown reaches the caller when all threads have stopped. `body` must not call run(). One caller at
  /// a time.
  template <typename Body>
  void run(std::size_t count, Body body) {
    run_erased(
        count, [](void* context, std::size_t index, unsigned worker) { (*static_cast<Body*>(context))(index, worker); },
        &body);
  }

 private:
  using Call = void (*)(void* context, std::size_t index, unsigned worker);

  void run_erased(std::size_t count, Call call, void* context);
  void take_indices(unsigned worker);
  void serve(unsigned worker);

  std::mutex guard_;
  std::condition_variable work_is_there_, work_is_done_;
  std::uint64_t round_ = 0;  // of work; a new number wakes the helpers
  std::size_t busy_ = 0;     // helpers that have not finished this round
  bool dismissed_ = false;
  Call call_ = nullptr;
  void* context_ = nullptr;
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_{0};
  std::exception_ptr thrown_;  // first of this round
  std::vector<std::jthread> helpers_;
};

}  // namespace sigmascape
