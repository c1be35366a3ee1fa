#include "recorded_locks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>

#if !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#include <dlfcn.h>
#include <pthread.h>
#define SIGMASCAPE_LOCKS_ARE_RECORDED
#endif

namespace sigmascape::render {
namespace {

struct Locked {
  std::atomic<const void*> mutex{nullptr};
  std::atomic<bool> by_caller{false};
};
std::array<Locked, 1U << 20U> locked;
std::atomic<std::size_t> count{0};
std::atomic<bool> is_recording{false};
thread_local bool is_caller = false;

#ifdef SIGMASCAPE_LOCKS_ARE_RECORDED
void record(const void* mutex) {
  if (!is_recording) return;
  const std::size_t place = count.fetch_add(1);
  if (place >= locked.size()) return;
  locked[place].by_caller = is_caller;
  locked[place].mutex = mutex;
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
  count = 0;
  is_caller = true;
  is_recording = true;
  work();
  is_recording = false;
  is_caller = false;
  LockedMutexes result;
  const std::size_t last = std::min(count.load(), locked.size());
  for (std::size_t place = 0; place < last; ++place) {
    (locked[place].by_caller ? result.by_caller : result.by_others).insert(locked[place].mutex);
  }
  result.by_others.erase(nullptr);  // recorded while this was read
  return result;
}

}  // namespace sigmascape::render

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
  sigmascape::render::record(mutex);
  return lock(mutex);
}
#endif
