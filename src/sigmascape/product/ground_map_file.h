#pragma once

#include <filesystem>

#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

/// Reads a GeoTIFF back that `write_map` wrote: the same numbers, grid, CRS and metadata. Decibels become linear again;
/// RE_VVHH is NaN then. In a file that was since moved onto other cells by a GIS the CRS is the file's own, as WKT.
/// Throws Error when the file cannot be read or lacks one of the bands.
[[nodiscard]] radar::GroundMap read_ground_map(const std::filesystem::path& path);
/// The same, where only the bands that the power of this polarization is of must be there; those that are not are NaN.
[[nodiscard]] radar::GroundMap read_ground_map(const std::filesystem::path& path, radar::Polarization polarization);

}  // namespace sigmascape::product
