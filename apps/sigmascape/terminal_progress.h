#pragma once

#include <chrono>
#include <string>

#include "sigmascape/base/progress.h"

namespace sigmascape::cli {

/// Shows work on the terminal as one line with its rate and the time left, once it has taken longer than two seconds.
/// Says nothing when standard error is not a terminal.
class TerminalProgress final : public ProgressListener {
 public:
  TerminalProgress();
  ~TerminalProgress() override;
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  void advanced(std::string_view task, double done, double total, std::string_view unit) override;

 private:
  using Clock = std::chrono::steady_clock;

  void begin(std::string_view task, double done);
  void erase_line();

  bool is_terminal_;
  bool line_shown_ = false;
  std::string task_;
  double first_done_ = 0.0;
  Clock::time_point started_;
  Clock::time_point shown_;
};

}  // namespace sigmascape::cli
