#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace sigmascape::cli {

/// Where a piece of work stands and how fast it goes, by the clock: what listeners of progress show.
class ProgressRate {
 public:
  void advanced(std::string_view task, double done, double total) {
    if (task != task_) {
      *this = ProgressRate();
      task_ = task;
      // What the first report tells was there already or took no time to speak of; rates count from there.
      first_done_ = done;
    }
    done_ = done;
    total_ = total;
  }
  void measured(std::string_view quantity, double value) {
    if (quantity == "rays") rays_a_second_ = value / std::max(seconds(), 1e-9);
    if (quantity == "relative_standard_error") error_ = value;
  }

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  }
  /// Units of the work a second; 0 when none is known yet.
  [[nodiscard]] double rate() const { return (done_ - first_done_) / std::max(seconds(), 1e-9); }
  [[nodiscard]] std::optional<double> seconds_left() const {
    if (done_ >= total_) return 0.0;
    return rate() > 0.0 ? std::optional((total_ - done_) / rate()) : std::nullopt;
  }
  [[nodiscard]] double done() const { return done_; }
  [[nodiscard]] double total() const { return total_; }
  [[nodiscard]] std::optional<double> rays_a_second() const { return rays_a_second_; }
  [[nodiscard]] std::optional<double> relative_standard_error() const { return error_; }

 private:
  std::string task_;
  double first_done_ = 0.0, done_ = 0.0, total_ = 0.0;
  std::optional<double> rays_a_second_, error_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace sigmascape::cli
