#pragma once

#include <csignal>
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
  int code = -1;  ///< −1: killed
  std::string printed;
  long peak_memory_kib = 0;
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(printed); }
};

/// A command line run by a shell of its own, its output in a file.
class Process {
 public:
  Process(const std::string& line, std::filesystem::path output) : output_(std::move(output)), pid_(::fork()) {
    if (pid_ != 0) return;
    const std::string whole = fmt::format("exec > '{}' 2>&1; {}", output_.string(), line);
    ::execl("/bin/bash", "bash", "-c", whole.c_str(), nullptr);
    ::_exit(127);
  }
  void kill() const { ::kill(pid_, SIGKILL); }
  [[nodiscard]] Ended ended() const {
    int status = 0;
    struct rusage usage {};
    ::wait4(pid_, &status, 0, &usage);
    std::ifstream file(output_, std::ios::binary);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, {std::istreambuf_iterator<char>(file), {}}, usage.ru_maxrss};
  }

 private:
  std::filesystem::path output_;
  pid_t pid_;
};

}  // namespace sigmascape::end_to_end
