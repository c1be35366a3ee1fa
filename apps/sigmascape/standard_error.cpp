#include "standard_error.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>

namespace sigmascape::cli {
namespace {

/// While it lives, what this thread writes into a pipe that nobody reads fails and does not end the program. For
/// standard output that end is right, as before a `head` that has seen enough.
class PipeSignalHeld {
 public:
  PipeSignalHeld() noexcept {
    ::sigemptyset(&pipe_);
    ::sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    ::sigemptyset(&pending);
    ::sigpending(&pending);
    was_pending_ = ::sigismember(&pending, SIGPIPE) == 1;
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &former_);
  }
  ~PipeSignalHeld() {
    const timespec at_once{};
    // One that was on its way before is not of this writing.
    while (!was_pending_ && ::sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
    }
    ::pthread_sigmask(SIG_SETMASK, &former_, nullptr);
  }
  PipeSignalHeld(const PipeSignalHeld&) = delete;
  PipeSignalHeld& operator=(const PipeSignalHeld&) = delete;

 private:
  sigset_t pipe_{}, former_{};
  bool was_pending_ = false;
};

}  // namespace

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
