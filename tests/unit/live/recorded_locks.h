#pragma once

#include <functional>
#include <set>

namespace sigmascape::live {

/// Mutexes of the whole program, by address.
struct LockedMutexes {
  std::set<const void*> by_caller;  ///< locked by the thread that does the work
  std::set<const void*> by_others;  ///< meanwhile, by any other thread
};

/// Whether locks can be recorded: not under a sanitizer, which itself stands between a program and its locks.
[[nodiscard]] bool can_record_locks();

/// Does the work and tells what was locked.
[[nodiscard]] LockedMutexes locked_during(const std::function<void()>& work);

}  // namespace sigmascape::live
