#include "standard_error.h"

#include <cstdio>
#include <mutex>
#include <set>

#include "pipe_signal_held.h"

namespace sigmascape::cli {
void say(std::string_view text) noexcept {
  const PipeSignalHeld held;
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
  std::clearerr(stderr);
}

void warn(const std::string& what) {
  static std::mutex guard;
  static std::set<std::string> said;
  const std::lock_guard lock(guard);
  if (said.insert(what).second) say("warning: " + what + "\n");
}

}  // namespace sigmascape::cli
