#include "terminal_progress.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace sigmascape::cli {
namespace {

constexpr auto quiet_time = std::chrono::seconds(2);
constexpr auto refresh_time = std::chrono::milliseconds(200);

std::string duration_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace

TerminalProgress::TerminalProgress() : is_terminal_(isatty(STDERR_FILENO) != 0) {}
TerminalProgress::~TerminalProgress() {
  erase_line();
}

void TerminalProgress::begin(std::string_view task, double done) {
  erase_line();
  task_ = task;
  // What the first report tells was there already or took no time to speak of; rates count from there.
  first_done_ = done;
  started_ = shown_ = Clock::now();
}

void TerminalProgress::erase_line() {
  if (line_shown_) fmt::print(stderr, "\r\033[K");
  line_shown_ = false;
}

void TerminalProgress::advanced(std::string_view task, double done, double total, std::string_view unit) {
  if (!is_terminal_) return;
  if (task != task_) begin(task, done);
  const auto now = Clock::now();
  if (done >= total) return erase_line();
  if (now - started_ < quiet_time || now - shown_ < refresh_time) return;
  shown_ = now;
  const double rate = (done - first_done_) / std::chrono::duration<double>(now - started_).count();
  if (rate <= 0.0) return;
  fmt::print(stderr, "\r\033[K{}: {:.1f} of {:.0f} {}, {:.3g} a second, {} left", task, done, total, unit, rate,
             duration_text((total - done) / rate));
  std::fflush(stderr);
  line_shown_ = true;
}

}  // namespace sigmascape::cli
