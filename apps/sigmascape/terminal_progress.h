#pragma once

#include <chrono>
#include <string>

#include "progress_rate.h"

#include "sigmascape/base/progress.h"

namespace sigmascape::cli {

/// Shows work on the terminal as one line with its rate and the time left, for a bake also rays a second and the mean
/// error so far, once it has taken longer than two seconds. Where standard error is not a terminal, as in the log of a
/// job, a line is written when a minute has gone by since the last, so that work of less than a minute says nothing.
/// What it waits for is told in the same way.
class TerminalProgress final : public ProgressListener {
 public:
  TerminalProgress();
  ~TerminalProgress() override;
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  void advanced(std::string_view task, double done, double total, std::string_view unit) override;
  void measured(std::string_view task, std::string_view quantity, double value) override;
  void waiting(std::string_view task, std::string_view what) override;

 private:
  using Clock = std::chrono::steady_clock;

  void erase_line();
  /// Whether the last line is so old that another may follow.
  [[nodiscard]] bool may_show() const;
  void show(const std::string& line);
  [[nodiscard]] std::string line(double seconds_left) const;

  bool is_terminal_;
  bool line_shown_ = false;
  std::string task_, unit_;
  ProgressRate rate_;
  Clock::time_point shown_ = Clock::now();
};

}  // namespace sigmascape::cli
