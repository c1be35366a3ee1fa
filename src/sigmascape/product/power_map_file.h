#pragma once

#include <filesystem>

#include "sigmascape/product/map_file.h"
#include "sigmascape/radar/power_map.h"

namespace sigmascape::product {

/// Writes received power as write_ground_map does σ0: bands VV, HH and HV in W, or in dBW, each with its unit, and
/// overviews of the mean power. The noise travels in the metadata as `noise_w`. Throws Error as write_ground_map.
void write_power_map(const std::filesystem::path& path, const radar::PowerMap& map, MapScale scale = MapScale::Linear);

/// Reads such a file back: the same numbers, grid, CRS and metadata. Decibels become watts again; re_vvhh is NaN, and
/// `noise_w` too where the metadata do not tell it. Throws Error when the file cannot be read or holds something else.
[[nodiscard]] radar::PowerMap read_power_map(const std::filesystem::path& path);

}  // namespace sigmascape::product
