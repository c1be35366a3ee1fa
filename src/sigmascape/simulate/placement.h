#pragma once

#include "sigmascape/geo/local_frame.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// The radar of a file, put where it stands over this terrain. `extent` is what the scene covers.
[[nodiscard]] radar::Radar placed_radar(const radar::RadarFile& file, const geo::LocalFrame& frame,
                                        const terrain::HeightField& terrain, const radar::Rectangle& extent);

/// The cells of the map that the file asks for, whole cells within the extent. Throws Error when the area and the
/// extent have nothing in common.
[[nodiscard]] radar::GroundGrid map_grid(const radar::MapRequest& request, const radar::Rectangle& extent);

}  // namespace sigmascape::simulate
