#include "recorded_locks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>

#if !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#include <dlfcn.h>
#include <pthread.h>
#define SIGMASCAPE_LOCKS_ARE_RECORDED
#endif

namespace sigmascape::live {
namespace {

// A mutex's address, whose lowest bit says that the caller locked it: one word, so that who is preempted while he
// writes leaves no mutex under another's name.
using Locked = std::atomic<std::uintptr_t>;
constexpr std::uintptr_t by_caller_bit = 1;
static_assert(alignof(std::mutex) > by_caller_bit);

std::array<Locked, 1U << 20U> locked;
std::atomic<std::size_t> recorded{0};
std::atomic<bool> is_recording{false};
thread_local bool is_caller = false;

#ifdef SIGMASCAPE_LOCKS_ARE_RECORDED
void record(const void* mutex) {
  if (!is_recording) return;
  const std::size_t place = recorded.fetch_add(1);
  if (place >= locked.size()) return;
  locked[place] = reinterpret_cast<std::uintptr_t>(mutex) | (is_caller ? by_caller_bit : 0U);
}
#endif

}  // namespace

bool can_record_locks() {
#ifdef SIGMASCAPE_LOCKS_ARE_RECORDED
  return true;
#else
  return false;
#endif
}

LockedMutexes locked_during(const std::function<void()>& work) {
  recorded = 0;
  is_caller = true;
  is_recording = true;
  work();
  is_recording = false;
  is_caller = false;
  LockedMutexes result;
  const std::size_t last = std::min(recorded.load(), locked.size());
  for (std::size_t place = 0; place < last; ++place) {
    const std::uintptr_t entry = locked[place].exchange(0);
    if (entry == 0) continue;  // claimed, and not yet written
    auto& mutexes = (entry & by_caller_bit) != 0 ? result.by_caller : result.by_others;
    mutexes.insert(reinterpret_cast<const void*>(entry & ~by_caller_bit));
  }
  return result;
}

}  // namespace sigmascape::live

#ifdef SIGMASCAPE_LOCKS_ARE_RECORDED
/// Stands before the system's own.
extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  using Lock = int (*)(pthread_mutex_t*);
  static std::atomic<Lock> system{nullptr};
  Lock lock = system;
  if (lock == nullptr) {
    lock = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
    system = lock;
  }
  sigmascape::live::record(mutex);
  return lock(mutex);
}
#endif
