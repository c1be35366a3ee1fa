#include "terminal_progress.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

#include "words.h"

namespace sigmascape::cli {
namespace {

constexpr double quiet_seconds = 2.0;
constexpr auto refresh_time = std::chrono::milliseconds(200);

}  // namespace

TerminalProgress::TerminalProgress() : is_terminal_(isatty(STDERR_FILENO) != 0) {}
TerminalProgress::~TerminalProgress() {
  erase_line();
}

void TerminalProgress::erase_line() {
  if (line_shown_) fmt::print(stderr, "\r\033[K");
  line_shown_ = false;
}

void TerminalProgress::advanced(std::string_view task, double done, double total, std::string_view unit) {
  if (!is_terminal_) return;
  if (task != task_) {
    erase_line();
    task_ = task;
    shown_ = Clock::now();
  }
  rate_.advanced(task, done, total);
  if (done >= total) return erase_line();
  const auto now = Clock::now();
  const auto left = rate_.seconds_left();
  if (rate_.seconds() < quiet_seconds || now - shown_ < refresh_time || !left) return;
  shown_ = now;
  fmt::print(stderr, "\r\033[K{}: {:.1f} of {:.0f} {}", task, done, total, unit);
  if (const auto rays = rate_.rays_a_second()) {
    fmt::print(stderr, ", {:.2f} million rays a second", *rays / 1e6);
  } else {
    fmt::print(stderr, ", {:.3g} a second", rate_.rate());
  }
  if (const auto error = rate_.relative_standard_error()) fmt::print(stderr, ", error {:.0f} %", 100.0 * *error);
  fmt::print(stderr, ", {} left", duration_text(*left));
  std::fflush(stderr);
  line_shown_ = true;
}

void TerminalProgress::measured(std::string_view, std::string_view quantity, double value) {
  rate_.measured(quantity, value);
}

}  // namespace sigmascape::cli
