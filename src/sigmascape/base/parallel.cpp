#include "sigmascape/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
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
  constexpr auto asking_time = std::chrono::milliseconds(50);
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  unsigned running = 0;
  std::condition_variable ended;

  Interruption* const interruption = Interruption::current();

  const auto fail = [&] {
    next.store(count);
    const std::lock_guard lock(guard);
    if (!failure) failure = std::current_exception();
  };
  const auto work = [&](unsigned worker) {
    const Interruption::Membership membership(interruption);
    try {
      for (std::size_t index = next.fetch_add(1); index < count; index = next.fetch_add(1)) {
        if (interruption != nullptr) interruption->poll();
        body(index, worker);
      }
    } catch (...) {
      fail();
    }
  };
  const auto help = [&](unsigned worker) {
    work(worker);
    const std::lock_guard lock(guard);
    --running;
    ended.notify_one();
  };
  // Who can be told to stop goes on asking while others are at their last pieces, which may take minutes.
  const auto ask_until_all_have_ended = [&] {
    bool is_heard = false;
    std::unique_lock lock(guard);
    while (running > 0 && !is_heard) {
      ended.wait_for(lock, asking_time);
      lock.unlock();
      try {
        interruption->poll();
      } catch (...) {
        fail();
        is_heard = true;
      }
      lock.lock();
    }
  };

  const auto helpers =
      static_cast<unsigned>(std::min<std::size_t>(thread_count(threads), std::max<std::size_t>(count, 1)));
  {
    std::vector<std::jthread> pool;
    for (unsigned worker = 1; worker < helpers; ++worker) {
      try {
        const std::lock_guard lock(guard);
        pool.emplace_back(help, worker);
        ++running;
      } catch (const std::exception&) {
        break;  // The system gives no more threads: those that there are do the work.
      }
    }
    work(0);
    if (interruption != nullptr) ask_until_all_have_ended();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace sigmascape
