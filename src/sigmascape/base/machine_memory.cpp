#include "sigmascape/base/machine_memory.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <unistd.h>

namespace sigmascape {

std::optional<double> control_group_memory_bytes(const std::filesystem::path& root, const std::string& membership) {
  const std::string unified = "0::/";
  const std::size_t line = membership.starts_with(unified) ? 0 : membership.find("\n" + unified);
  if (line == std::string::npos) return std::nullopt;
  const std::size_t begin = membership.find(unified, line) + unified.size();
  std::filesystem::path group = root / membership.substr(begin, membership.find('\n', begin) - begin);
  std::optional<double> least;
  while (true) {
    double bytes = 0.0;  // "max" is no number
    if (std::ifstream(group / "memory.max") >> bytes) least = std::min(bytes, least.value_or(bytes));
    if (group.native().size() <= root.native().size()) return least;
    group = group.parent_path();
  }
}

double machine_memory_bytes() {
  const double machine = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  std::ifstream file("/proc/self/cgroup");
  const std::string membership{std::istreambuf_iterator(file), {}};
  return std::min(machine, control_group_memory_bytes("/sys/fs/cgroup", membership).value_or(machine));
}

}  // namespace sigmascape
