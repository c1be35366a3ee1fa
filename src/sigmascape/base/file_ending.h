#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace sigmascape {

/// What a file's name ends in, dot and all, in small letters: ".tif" of "MAP.TIF"; empty where there is no dot.
[[nodiscard]] inline std::string file_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending;
}

}  // namespace sigmascape
