#include "sigmascape/base/machine_name.h"

#include <fmt/format.h>
#include <fstream>
#include <thread>

namespace sigmascape {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

}  // namespace

std::string machine_name() {
  return fmt::format("{} hardware threads, {}", std::thread::hardware_concurrency(), processor_name());
}

}  // namespace sigmascape
