#pragma once

#include <filesystem>

#include "sigmascape/product/map_view.h"
#include "sigmascape/product/picture.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

/// Writes a map of σ0 as a PNG with its legend and the attribution of its data below it, and a world file beside it.
/// The PNG's text says the quantity, the scale and where the map comes from.
void write_map_picture(const std::filesystem::path& path, const MapView& map, const PictureOptions& options);
inline void write_map_picture(const std::filesystem::path& path, const radar::GroundMap& map,
                              const PictureOptions& options) {
  write_map_picture(path, view_of(map), options);
}

}  // namespace sigmascape::product
