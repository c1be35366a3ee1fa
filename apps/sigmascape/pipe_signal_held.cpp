#include "pipe_signal_held.h"

#include <cerrno>
#include <ctime>

namespace sigmascape::cli {

PipeSignalHeld::PipeSignalHeld() noexcept {
  ::sigemptyset(&pipe_);
  ::sigaddset(&pipe_, SIGPIPE);
  sigset_t pending;
  ::sigemptyset(&pending);
  ::sigpending(&pending);
  was_pending_ = ::sigismember(&pending, SIGPIPE) == 1;
  ::pthread_sigmask(SIG_BLOCK, &pipe_, &former_);
}

PipeSignalHeld::~PipeSignalHeld() {
  const timespec at_once{};
  // One that was on its way before is not of this writing.
  while (!was_pending_ && ::sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
  }
  ::pthread_sigmask(SIG_SETMASK, &former_, nullptr);
}

}  // namespace sigmascape::cli
