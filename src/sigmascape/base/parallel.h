#pragma once

#include <cstddef>
#include <functional>

namespace sigmascape {

/// Far more than processors, fewer than what systems refuse.
inline constexpr unsigned most_threads = 1024;

/// The number of threads to use when asked for `wanted`: that many, `most_threads` at most, or one per hardware thread
/// when it is zero.
[[nodiscard]] unsigned thread_count(unsigned wanted);

/// Calls `body(index, worker)` once for every index below `count`, spread over threads that take the next index when
/// free; `worker` numbers the calling thread from 0, so that it may keep scratch space of its own. Returns when all are
/// done. The first exception stops the handing out of indices and is thrown again here. So does an Interruption that is
/// wanted (interruption.h).
void parallel_for(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t index, unsigned worker)>& body);

}  // namespace sigmascape
