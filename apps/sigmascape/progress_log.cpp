#include "progress_log.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "sigmascape/base/error.h"

namespace sigmascape::cli {
namespace {

constexpr double longest_silence_s = 10.0;

nlohmann::ordered_json number_or_null(std::optional<double> number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json(nullptr);
}

}  // namespace

ProgressLog::ProgressLog(const std::filesystem::path& file) : file_(std::fopen(file.c_str(), "a+")) {
  if (file_ == nullptr) {
    throw Error(file.string(), std::string("cannot be written (") + std::strerror(errno) + ")",
                "give --json-log a file in a folder that exists");
  }
  // A process that was killed may have left half a line.
  const bool ends_within_a_line = std::fseek(file_, -1, SEEK_END) == 0 && std::fgetc(file_) != '\n';
  std::fseek(file_, 0, SEEK_END);
  if (ends_within_a_line) std::fputc('\n', file_);
}

ProgressLog::~ProgressLog() {
  std::fclose(file_);
}

void ProgressLog::advanced(std::string_view task, double done, double total, std::string_view) {
  rate_.advanced(task, done, total);
  const bool finished_look = done == std::floor(done) && done != last_done_;
  if (!finished_look && rate_.seconds() - last_seconds_ < longest_silence_s) return;
  last_done_ = done;
  last_seconds_ = rate_.seconds();
  write_line(task);
}

void ProgressLog::measured(std::string_view, std::string_view quantity, double value) {
  rate_.measured(quantity, value);
}

void ProgressLog::write_line(std::string_view task) {
  const nlohmann::ordered_json line{{"task", task},
                                    {"looks_done", rate_.done()},
                                    {"looks_total", rate_.total()},
                                    {"rays_per_second", number_or_null(rate_.rays_a_second())},
                                    {"relative_standard_error", number_or_null(rate_.relative_standard_error())},
                                    {"seconds", rate_.seconds()},
                                    {"seconds_left", number_or_null(rate_.seconds_left())}};
  const std::string text = line.dump() + "\n";
  std::fwrite(text.data(), 1, text.size(), file_);
  std::fflush(file_);
}

}  // namespace sigmascape::cli
