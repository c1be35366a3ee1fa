#pragma once

#include <chrono>
#include <string>

#include "progress_rate.h"

#include "sigmascape/base/progress.h"

namespace sigmascape::cli {

/// Shows work on the terminal as one line with its rate and the time left, for a bake also rays a second and the mean
/// error so far, once it has taken longer than two seconds.
/// Says nothing when standard error is not a terminal.
class TerminalProgress final : public ProgressListener {
 public:
  TerminalProgress();
  ~TerminalProgress() override;
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  void advanced(std::string_view task, double done, double total, std::string_view unit) override;
  void measured(std::string_view task, std::string_view quantity, double value) override;

 private:
  using Clock = std::chrono::steady_clock;

  void erase_line();

  bool is_terminal_;
  bool line_shown_ = false;
  std::string task_;
  ProgressRate rate_;
  Clock::time_point shown_;
};

}  // namespace sigmascape::cli
