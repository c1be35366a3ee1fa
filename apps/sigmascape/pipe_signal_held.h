#pragma once

#include <csignal>

namespace sigmascape::cli {

/// While it lives, what this thread writes into a pipe that nobody reads fails and does not end the program. For the
/// output of a command that end is right, as before a `head` that has seen enough; for what is said beside it, it is
/// not.
class PipeSignalHeld {
 public:
  PipeSignalHeld() noexcept;
  ~PipeSignalHeld();
  PipeSignalHeld(const PipeSignalHeld&) = delete;
  PipeSignalHeld& operator=(const PipeSignalHeld&) = delete;

 private:
  sigset_t pipe_{}, former_{};
  bool was_pending_ = false;
};

}  // namespace sigmascape::cli
