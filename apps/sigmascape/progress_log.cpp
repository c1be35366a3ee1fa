#include "progress_log.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "number_or_null.h"
#include "pipe_signal_held.h"

#include "sigmascape/base/error.h"

namespace sigmascape::cli {
namespace {

constexpr double longest_silence_s = 10.0;

/// How every line begins, of which the killed writer of a log may have left a part.
constexpr std::string_view beginning = R"({"task":)";

/// Throws Error for a file that holds anything but a log, to which lines would be added.
void check_is_log(const std::filesystem::path& file) {
  std::error_code is_none;
  if (!std::filesystem::is_regular_file(file, is_none) || is_own_stream(file)) return;
  std::array<char, 2 * beginning.size() + 1> read{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(read.data(), read.size());
  const std::string_view found(read.data(), static_cast<std::size_t>(stream.gcount()));
  const std::string_view line = found.substr(0, found.find('\n'));
  const std::string_view next = found.substr(std::min(line.size() + 1, found.size()));
  const bool goes_on = next.starts_with(beginning) || beginning.starts_with(next);
  if (line.starts_with(beginning) || (beginning.starts_with(line) && goes_on)) return;
  throw Error(file.string(), "holds something else than the log of a bake", "give --json-log a file of its own");
}

/// The descriptor of the program's own that goes there, be it a file, a pipe, a socket or a terminal, or none.
std::optional<int> own_descriptor(const std::filesystem::path& file) {
  struct stat named {
  }, own{};
  if (::stat(file.c_str(), &named) != 0) return std::nullopt;
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) {
    const bool is_known = ::fstat(descriptor, &own) == 0;
    if (is_known && own.st_dev == named.st_dev && own.st_ino == named.st_ino) return descriptor;
  }
  return std::nullopt;
}

/// What the program writes to is not opened a second time, which would write over that, but shared.
std::FILE* opened(const std::filesystem::path& file) {
  if (const auto own = own_descriptor(file)) return ::fdopen(::dup(*own), "w");
  check_is_log(file);
  return std::fopen(file.c_str(), "a");
}

/// As the killed writer of a log may have left it.
bool ends_within_a_line(const std::filesystem::path& file) {
  std::error_code is_none;
  if (!std::filesystem::is_regular_file(file, is_none)) return false;
  std::ifstream stream(file, std::ios::binary);
  return stream.seekg(-1, std::ios::end) && stream.get() != '\n';
}

}  // namespace

bool is_own_stream(const std::filesystem::path& file) {
  return own_descriptor(file).has_value();
}

ProgressLog::ProgressLog(const std::filesystem::path& file) : file_name_(file), file_(opened(file)) {
  if (file_ == nullptr) {
    throw Error(file.string(), std::string("cannot be written (") + std::strerror(errno) + ")",
                "give --json-log a file in a folder that exists");
  }
  if (ends_within_a_line(file)) std::fputc('\n', file_);
}

ProgressLog::~ProgressLog() {
  const PipeSignalHeld held;
  std::fclose(file_);
}

void ProgressLog::advanced(std::string_view task, double done, double total, std::string_view unit) {
  if (task != task_) last_done_ = -1.0;
  task_ = task;
  unit_ = unit;
  rate_.advanced(task, done, total);
  if (unit == "looks") {
    looks_done_ = done;
    looks_total_ = total;
  }
  const bool finished_one = done == std::floor(done) && done != last_done_;
  if (!finished_one && rate_.seconds() - last_seconds_ < longest_silence_s) return;
  last_done_ = done;
  write_line();
}

void ProgressLog::measured(std::string_view, std::string_view quantity, double value) {
  rate_.measured(quantity, value);
}

void ProgressLog::waiting(std::string_view, std::string_view what) {
  if (rate_.seconds() - last_seconds_ >= longest_silence_s) write_line(what);
}

void ProgressLog::write_line(std::string_view waits_for) {
  last_seconds_ = rate_.seconds();
  nlohmann::ordered_json line{{"task", task_},
                              {"done", rate_.done()},
                              {"total", rate_.total()},
                              {"unit", unit_},
                              {"looks_done", number_or_null(looks_done_)},
                              {"looks_total", number_or_null(looks_total_)},
                              {"rays_per_second", number_or_null(rate_.rays_a_second())},
                              {"relative_standard_error", number_or_null(rate_.relative_standard_error())},
                              {"seconds", rate_.seconds()},
                              {"seconds_left", number_or_null(rate_.seconds_left())}};
  if (!waits_for.empty()) line["waits_for"] = waits_for;
  const std::string text = line.dump() + "\n";
  const PipeSignalHeld held;
  const bool is_written = std::fwrite(text.data(), 1, text.size(), file_) == text.size() && std::fflush(file_) == 0;
  if (is_written) {
    has_lines_ = true;
    return;
  }
  const int error = errno;
  std::clearerr(file_);
  is_whole_ = false;
  if (has_lines_) return;
  throw Error(file_name_.string(), std::string("cannot be written (") + std::strerror(error) + ")",
              "give --json-log a file on a disk that has room");
}

}  // namespace sigmascape::cli
