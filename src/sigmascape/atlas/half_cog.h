#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "sigmascape/atlas/half.h"

namespace sigmascape::atlas {

/// Reads the levels of a stored texture as they are: halves of four channels, [level][(row · columns + column) · 4 +
/// channel]. Goes past GDAL, which would widen every half to a float. Throws Error when the file cannot be read whole
/// or has not the given side and levels.
[[nodiscard]] std::vector<std::vector<Half>> read_half_cog(const std::filesystem::path& path, std::size_t side,
                                                           std::size_t levels);

/// Reads one tile of one level, [row][column][channel], the tiles counted row by row from the north-west. False when
/// the file has no such tile or it cannot be read: for readers that have something else to show meanwhile.
[[nodiscard]] bool read_half_tile(const std::filesystem::path& path, std::size_t level, std::size_t tile,
                                  std::span<Half> halves);

}  // namespace sigmascape::atlas
