#pragma once

#include <filesystem>
#include <system_error>

namespace sigmascape::geo {

/// Whether there is nothing under that name. What cannot be told, because of a loop of links or a folder that may not
/// be looked into, is left to whoever opens the file to complain of.
[[nodiscard]] inline bool is_absent(const std::filesystem::path& file) {
  std::error_code hidden;
  return !std::filesystem::exists(file, hidden) && !hidden;
}

}  // namespace sigmascape::geo
