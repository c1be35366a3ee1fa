#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "sigmascape/geo/local_frame.h"
#include "sigmascape/product/picture.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::cli {

/// Where a map comes from, as it goes into its metadata.
using Provenance = std::map<std::string, std::string>;

/// Notes radar, position and provenance with a map.
[[nodiscard]] radar::GroundMap described_map(radar::GroundMap map, const radar::Radar& radar,
                                             const geo::LocalFrame& frame, const Provenance& provenance);

/// Lays an image on the ground and notes radar, position and provenance with it.
[[nodiscard]] radar::GroundMap described_map(const radar::RangeAzimuthImage& image, const radar::Radar& radar,
                                             const terrain::HeightField& terrain, const radar::GroundGrid& grid,
                                             const geo::LocalFrame& frame, const Provenance& provenance);

/// Writes a map as a picture with its legend.
void write_map_picture(const std::filesystem::path& path, const radar::GroundMap& map,
                       const product::PictureOptions& options);

}  // namespace sigmascape::cli
