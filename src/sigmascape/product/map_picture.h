#pragma once

#include <filesystem>

#include "sigmascape/product/picture.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

/// Writes a map as a PNG with its legend and the attribution of its data below it, and a world file beside it. The
/// PNG's text says the quantity, the scale and where the map comes from.
void write_map_picture(const std::filesystem::path& path, const radar::GroundMap& map, const PictureOptions& options);

}  // namespace sigmascape::product
