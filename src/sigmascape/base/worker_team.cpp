#include "sigmascape/base/worker_team.h"

#include <exception>
#include <utility>

#include "sigmascape/base/parallel.h"

namespace sigmascape {

WorkerTeam::WorkerTeam(unsigned threads) {
  const unsigned members = thread_count(threads);
  helpers_.reserve(members - 1);
  for (unsigned worker = 1; worker < members; ++worker) {
    try {
      helpers_.emplace_back([this, worker] { serve(worker); });
    } catch (const std::exception&) {
      return;  // There are no more threads, or no memory for them: those that there are do the work.
    }
  }
}

WorkerTeam::~WorkerTeam() {
  {
    const std::lock_guard lock(guard_);
    dismissed_ = true;
  }
  work_is_there_.notify_all();
}

void WorkerTeam::run_erased(std::size_t count, Call call, void* context) {
  {
    const std::lock_guard lock(guard_);
    call_ = call;
    context_ = context;
    count_ = count;
    next_.store(0, std::memory_order_relaxed);
    busy_ = helpers_.size();
    ++round_;
  }
  work_is_there_.notify_all();
  take_indices(0);
  std::unique_lock lock(guard_);
  work_is_done_.wait(lock, [this] { return busy_ == 0; });
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

void WorkerTeam::take_indices(unsigned worker) {
  try {
    for (std::size_t index = next_.fetch_add(1, std::memory_order_relaxed); index < count_;
         index = next_.fetch_add(1, std::memory_order_relaxed)) {
      call_(context_, index, worker);
    }
  } catch (...) {
    next_.store(count_, std::memory_order_relaxed);
    const std::lock_guard lock(guard_);
    if (!thrown_) thrown_ = std::current_exception();
  }
}

void WorkerTeam::serve(unsigned worker) {
  std::uint64_t served = 0;
  while (true) {
    {
      std::unique_lock lock(guard_);
      work_is_there_.wait(lock, [&] { return dismissed_ || round_ != served; });
      if (dismissed_) return;
      served = round_;
    }
    take_indices(worker);
    const std::lock_guard lock(guard_);
    if (--busy_ == 0) work_is_done_.notify_one();
  }
}

}  // namespace sigmascape
