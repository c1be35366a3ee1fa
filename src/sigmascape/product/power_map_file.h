#pragma once

#include <filesystem>

#include "sigmascape/radar/power_map.h"

namespace sigmascape::product {

/// Reads a GeoTIFF of received power back that `write_map` wrote: the same numbers, grid, CRS and metadata. Decibels
/// become watts again; re_vvhh is NaN, and `noise_w` too where the metadata do not tell it. Throws Error when the file
/// cannot be read or holds something else.
[[nodiscard]] radar::PowerMap read_power_map(const std::filesystem::path& path);

}  // namespace sigmascape::product
