#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "progress_rate.h"

#include "sigmascape/base/progress.h"

namespace sigmascape::cli {

/// Whether it is what the program itself writes messages to, wherever that goes.
[[nodiscard]] bool is_own_stream(const std::filesystem::path& file);

/// Writes the progress of a bake for machines: a JSON object a line, flushed line by line, when a stage of it begins,
/// at each look or other unit that is finished, and every ten seconds within long ones. How many looks are there, as
/// far as that is known, stands in every line, whatever the stage; what the work waits for in those written while it
/// does.
class ProgressLog final : public ProgressListener {
 public:
  /// Adds to a log that is there: a share that starts again goes on in its own. What the program itself writes to is
  /// written through that. Throws Error when the file holds something else or cannot be written.
  explicit ProgressLog(const std::filesystem::path& file);
  ~ProgressLog() override;
  ProgressLog(const ProgressLog&) = delete;
  ProgressLog& operator=(const ProgressLog&) = delete;

  /// Whether every line was written. A disk that fills up meanwhile does not end the bake, nor does a reader who goes.
  [[nodiscard]] bool is_whole() const { return is_whole_; }

  /// Throws Error when not even the first line can be written.
  void advanced(std::string_view task, double done, double total, std::string_view unit) override;
  void measured(std::string_view task, std::string_view quantity, double value) override;
  void waiting(std::string_view task, std::string_view what) override;

 private:
  /// Nothing is waited for where `waits_for` is empty.
  void write_line(std::string_view waits_for = {});

  std::filesystem::path file_name_;
  std::FILE* file_;
  ProgressRate rate_;
  std::string task_, unit_;
  std::optional<double> looks_done_, looks_total_;
  double last_done_ = -1.0, last_seconds_ = 0.0;
  bool has_lines_ = false, is_whole_ = true;
};

/// Tells two listeners.
class ProgressToTwo final : public ProgressListener {
 public:
  ProgressToTwo(ProgressListener& first, ProgressListener& second) : first_(first), second_(second) {}
  void advanced(std::string_view task, double done, double total, std::string_view unit) override {
    first_.advanced(task, done, total, unit);
    second_.advanced(task, done, total, unit);
  }
  void measured(std::string_view task, std::string_view quantity, double value) override {
    first_.measured(task, quantity, value);
    second_.measured(task, quantity, value);
  }
  void waiting(std::string_view task, std::string_view what) override {
    first_.waiting(task, what);
    second_.waiting(task, what);
  }

 private:
  ProgressListener& first_;
  ProgressListener& second_;
};

}  // namespace sigmascape::cli
