#pragma once

#include <filesystem>
#include <system_error>

#include "sigmascape/base/virtual_path.h"

namespace sigmascape::geo {

/// Whether there is nothing under that name. What cannot be told, because of a loop of links, a folder that may not be
/// looked into or a virtual path, is left to whoever opens the file to complain of.
[[nodiscard]] inline bool is_absent(const std::filesystem::path& file) {
  std::error_code hidden;
  return !is_virtual(file) && !std::filesystem::exists(file, hidden) && !hidden;
}

}  // namespace sigmascape::geo
