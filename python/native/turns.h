#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <sys/types.h>

namespace sigmascape::python {

/// Who may use a thing that keeps state from call to call, and threads of its own: one caller at a time, and in the
/// process that made it alone, for a child that is forked off has none of the threads.
class Turns {
 public:
  /// `name`: of the thing, as errors tell it.
  explicit Turns(std::string name);

  [[nodiscard]] bool are_of_this_process() const;
  /// Throws Error in any process but the one that made this.
  void check_process() const;

  /// Waits for the callers before, and heeds Ctrl-C meanwhile. Call it without the GIL: they may want it to end. Throws
  /// Error as check_process does.
  void lock();
  void unlock();

 private:
  std::string name_;
  pid_t made_in_;
  std::mutex guard_;
  std::condition_variable given_up_;
  bool is_taken_ = false;
};

}  // namespace sigmascape::python
