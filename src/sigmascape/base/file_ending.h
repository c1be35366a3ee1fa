#pragma once

#include <filesystem>
#include <string>

#include "sigmascape/base/small_letters.h"

namespace sigmascape {

/// What a file's name ends in, dot and all, in small letters: ".tif" of "MAP.TIF"; empty where there is no dot.
[[nodiscard]] inline std::string file_ending(const std::filesystem::path& file) {
  return in_small_letters(file.extension().string());
}

}  // namespace sigmascape
