#pragma once

#include <filesystem>
#include <string>

#include "sigmascape/product/picture.h"

namespace sigmascape::product {

/// Writes a picture as an 8-bit PNG (RGB, or RGBA where a pixel is not opaque), its metadata as text chunks, and beside
/// it the world file that tells a GIS where it lies: the same name ending in .pgw. Both or neither. Equal
/// pictures give equal bytes. Throws Error when the picture is empty, a metadata key is no PNG keyword, or the file
/// cannot be written.
void write_png(const std::filesystem::path& path, const Picture& picture);

/// Throws Error unless the name ends in .png: for asking before the work.
void check_png_name(const std::filesystem::path& path);

/// The picture as the bytes of a PNG file. Errors as for write_png.
[[nodiscard]] std::string png_bytes(const Picture& picture);

/// The six lines of a world file: pixel size east, two rotations (zero), pixel size south (negative), and the centre of
/// the upper left pixel, east and north, all in the unit of the grid.
[[nodiscard]] std::string world_file_text(const radar::GroundGrid& grid);

}  // namespace sigmascape::product
