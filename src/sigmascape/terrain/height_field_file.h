#pragma once

#include <filesystem>
#include <string>

#include "sigmascape/terrain/height_field.h"

namespace sigmascape::terrain {

/// Writes heights as a float GeoTIFF whose cells' centres are the nodes, in the coordinate system `crs` (that of the
/// local frame), atomically. Equal fields give equal bytes. Throws Error when it cannot be written.
void write_height_field(const std::filesystem::path& path, const HeightField& field, const std::string& crs);

/// Reads what write_height_field wrote, node for node. Throws Error when the file is not there, not whole or not such a
/// file.
[[nodiscard]] HeightField read_height_field(const std::filesystem::path& path);

}  // namespace sigmascape::terrain
