#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "sigmascape/atlas/half.h"

namespace sigmascape::atlas {

/// Reads the levels of a stored texture as they are: halves of four channels, [level][(row · columns + column) · 4 +
/// channel]. Goes past GDAL, which would widen every half to a float. Throws Error when the file cannot be read whole
/// or has not the given side and levels.
[[nodiscard]] std::vector<std::vector<Half>> read_half_cog(const std::filesystem::path& path, std::size_t side,
                                                           std::size_t levels);

}  // namespace sigmascape::atlas
