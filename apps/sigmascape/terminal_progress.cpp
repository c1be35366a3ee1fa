#include "terminal_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include "standard_error.h"
#include "words.h"

namespace sigmascape::cli {
namespace {

constexpr double quiet_seconds = 2.0;
constexpr std::chrono::milliseconds refresh_time{200}, log_time{60'000};

}  // namespace

TerminalProgress::TerminalProgress() : is_terminal_(isatty(STDERR_FILENO) != 0) {}
TerminalProgress::~TerminalProgress() {
  erase_line();
}

void TerminalProgress::erase_line() {
  if (line_shown_) say("\r\033[K");
  line_shown_ = false;
}

std::string TerminalProgress::line(double seconds_left) const {
  const auto rays = rate_.rays_a_second();
  const auto error = rate_.relative_standard_error();
  return fmt::format(
      "{}: {:.1f} of {:.0f} {}, {}{}, {} left", task_, rate_.done(), rate_.total(), unit_,
      rays ? fmt::format("{:.2f} million rays a second", *rays / 1e6) : fmt::format("{:.3g} a second", rate_.rate()),
      error ? fmt::format(", error {:.1f} %", 100.0 * *error) : "", duration_text(seconds_left));
}

void TerminalProgress::advanced(std::string_view task, double done, double total, std::string_view unit) {
  if (task != task_) erase_line();
  task_ = task;
  unit_ = unit;
  rate_.advanced(task, done, total);
  if (done >= total) return erase_line();
  const auto left = rate_.seconds_left();
  if (left && may_show()) show(line(*left));
}

void TerminalProgress::waiting(std::string_view task, std::string_view what) {
  if (may_show()) show(fmt::format("{}: waits for {}", task, what));
}

bool TerminalProgress::may_show() const {
  if (is_terminal_ && rate_.seconds() < quiet_seconds) return false;
  return Clock::now() - shown_ >= (is_terminal_ ? refresh_time : log_time);
}

void TerminalProgress::show(const std::string& line) {
  shown_ = Clock::now();
  say(is_terminal_ ? "\r\033[K" + line : line + "\n");
  line_shown_ = is_terminal_;
}

void TerminalProgress::measured(std::string_view, std::string_view quantity, double value) {
  rate_.measured(quantity, value);
}

}  // namespace sigmascape::cli
