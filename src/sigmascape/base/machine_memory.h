#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sigmascape {

/// Bytes of memory that this process may come to have: what the machine has, in use or not, or less where a control
/// group limits it, as containers and batch systems do.
[[nodiscard]] double machine_memory_bytes();

/// The least that control groups allow, of the one that a process is in and those that hold it: of version 2, mounted
/// at `root`, where `membership` is what /proc/self/cgroup says. Nothing where none limits it.
[[nodiscard]] std::optional<double> control_group_memory_bytes(const std::filesystem::path& root,
                                                               const std::string& membership);

}  // namespace sigmascape
