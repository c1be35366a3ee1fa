#pragma once

#include <filesystem>

#include "sigmascape/product/described_map.h"
#include "sigmascape/product/picture.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::cli {

using product::described_map;
using product::Provenance;

/// Writes a map as a picture with its legend and the attribution of its data.
void write_map_picture(const std::filesystem::path& path, const radar::GroundMap& map,
                       const product::PictureOptions& options);

}  // namespace sigmascape::cli
