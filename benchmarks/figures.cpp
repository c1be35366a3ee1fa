#include "figures.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "sigmascape/base/machine_name.h"

namespace sigmascape::bench {
namespace {

std::string first_line_of(const std::string& command) {
  const auto close = [](std::FILE* stream) { pclose(stream); };
  const std::unique_ptr<std::FILE, decltype(close)> stream(popen(command.c_str(), "r"), close);
  std::array<char, 256> line{};
  if (!stream || std::fgets(line.data(), line.size(), stream.get()) == nullptr) return "unknown";
  std::string text = line.data();
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

[[noreturn]] void give_up(std::string_view message) {
  fmt::print(stderr, "{}\n", message);
  std::exit(1);
}

}  // namespace

Figures::Figures(std::optional<std::filesystem::path> file)
    : file_(std::move(file)),
      machine_(machine_name()),
      commit_(first_line_of("git -C '" SIGMASCAPE_SOURCE_DIR "' describe --always --dirty 2> /dev/null")) {
  if (!file_) return;
  if (file_->has_parent_path()) std::filesystem::create_directories(file_->parent_path());
  if (!std::ofstream(*file_, std::ios::trunc)) give_up(fmt::format("{} cannot be written", file_->string()));
}

void Figures::add(std::string_view name, double value, std::string_view unit, std::string_view note) {
  fmt::print("{:<44} {:>12.4g} {:<12} {}\n", name, value, unit, note);
  std::fflush(stdout);
  if (!file_) return;
  nlohmann::ordered_json line = {
      {"name", name}, {"value", value}, {"unit", unit}, {"machine", machine_}, {"commit", commit_}};
  if (!note.empty()) line["note"] = note;
  std::ofstream(*file_, std::ios::app) << line.dump() << '\n';
}

Arguments Arguments::parsed(int count, char** words) {
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i];
    if (word == "--quick") {
      arguments.quick = true;
    } else if (word == "--out" && i + 1 < count) {
      arguments.out = words[++i];
    } else {
      give_up(fmt::format("{} is not understood; usage: {} [--quick] [--out FILE]", word, words[0]));
    }
  }
  return arguments;
}

void prove(bool holds, std::string_view claim) {
  if (!holds) give_up(fmt::format("not so: {}", claim));
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace sigmascape::bench
