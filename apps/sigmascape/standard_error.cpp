#include "standard_error.h"

#include <cstdio>

#include "pipe_signal_held.h"

namespace sigmascape::cli {
void say(std::string_view text) noexcept {
  const PipeSignalHeld held;
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
  std::clearerr(stderr);
}

void warn(const std::string& what) {
  say("warning: " + what + "\n");
}

}  // namespace sigmascape::cli
