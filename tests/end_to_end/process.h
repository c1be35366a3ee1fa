#pragma once

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace sigmascape::end_to_end {

struct Ended {
  int code = -1;        ///< −1: killed
  std::string printed;  ///< on standard output, and after that what was said
  std::string said;     ///< on standard error
  long peak_memory_kib = 0;
  /// What standard output holds.
  [[nodiscard]] nlohmann::json json() const {
    return nlohmann::json::parse(printed.begin(), printed.end() - static_cast<std::ptrdiff_t>(said.size()));
  }
};

/// A command line run by a shell of its own, its output in two files.
class Process {
 public:
  Process(const std::string& line, std::filesystem::path output) : output_(std::move(output)), pid_(::fork()) {
    if (pid_ != 0) return;
    const std::string whole = fmt::format("exec > '{}' 2> '{}'; {}", output_.string(), errors().string(), line);
    ::execl("/bin/bash", "bash", "-c", whole.c_str(), nullptr);
    ::_exit(127);
  }
  void kill() const { ::kill(pid_, SIGKILL); }
  [[nodiscard]] Ended ended() const {
    int status = 0;
    struct rusage usage {};
    ::wait4(pid_, &status, 0, &usage);
    const std::string said = content_of(errors());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(output_) + said, said, usage.ru_maxrss};
  }

 private:
  [[nodiscard]] std::filesystem::path errors() const { return output_.string() + ".errors"; }
  static std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path output_;
  pid_t pid_;
};

}  // namespace sigmascape::end_to_end
