#pragma once

#include <filesystem>

#include "sigmascape/product/map_file.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

/// Writes a ground map as a cloud-optimised float32 GeoTIFF with overviews, atomically: bands VV, HH, HV (linear σ0
/// with respect to horizontal area) and RE_VVHH (the correlation Re⟨S_VV S_HH*⟩ on the same scale), NaN where the radar
/// did not look, the CRS of the local frame, and the map's metadata as tags. In decibels the bands are VV, HH and HV
/// alone, and overviews are those of the mean power. Keys that begin with SIGMASCAPE_ are the file's own. Throws Error
/// when the map's cells do not fit its grid, the CRS is not understood or the file cannot be written.
void write_ground_map(const std::filesystem::path& path, const radar::GroundMap& map,
                      MapScale scale = MapScale::Linear);

/// Reads such a file back: the same numbers, grid, CRS and metadata. Decibels become linear again; RE_VVHH is NaN then.
/// In a file that was since moved onto other cells by a GIS the CRS is the file's own, as WKT. Throws Error when the
/// file cannot be read or lacks one of the bands.
[[nodiscard]] radar::GroundMap read_ground_map(const std::filesystem::path& path);
/// The same, where only the bands that the power of this polarization is of must be there; those that are not are NaN.
[[nodiscard]] radar::GroundMap read_ground_map(const std::filesystem::path& path, radar::Polarization polarization);

}  // namespace sigmascape::product
