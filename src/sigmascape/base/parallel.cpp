#include "sigmascape/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "sigmascape/base/interruption.h"

namespace sigmascape {

unsigned thread_count(unsigned wanted) {
  return wanted != 0 ? std::min(wanted, most_threads) : std::max(1U, std::thread::hardware_concurrency());
}

void parallel_for(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t index, unsigned worker)>& body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_guard;

  Interruption* const interruption = Interruption::current();

  const auto work = [&](unsigned worker) {
    const Interruption::Membership membership(interruption);
    try {
      for (std::size_t index = next.fetch_add(1); index < count; index = next.fetch_add(1)) {
        if (interruption != nullptr) interruption->poll();
        body(index, worker);
      }
    } catch (...) {
      next.store(count);
      const std::lock_guard lock(failure_guard);
      if (!failure) failure = std::current_exception();
    }
  };

  const auto helpers =
      static_cast<unsigned>(std::min<std::size_t>(thread_count(threads), std::max<std::size_t>(count, 1)));
  {
    std::vector<std::jthread> pool;
    for (unsigned worker = 1; worker < helpers; ++worker) {
      try {
        pool.emplace_back(work, worker);
      } catch (const std::exception&) {
        break;  // The system gives no more threads: those that there are do the work.
      }
    }
    work(0);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace sigmascape
