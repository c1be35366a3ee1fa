#pragma once

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace sigmascape::end_to_end {

/// The folder of real landscapes: SIGMASCAPE_DATA, else beside the checkout.
inline std::filesystem::path data_folder() {
  const char* stated = std::getenv("SIGMASCAPE_DATA");
  return stated != nullptr && *stated != '\0' ? std::filesystem::path(stated)
                                              : std::filesystem::path(SIGMASCAPE_SOURCE_DIR) / "../shared/data";
}

}  // namespace sigmascape::end_to_end
