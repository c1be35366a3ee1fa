#pragma once

#include <map>
#include <string>

#include "sigmascape/geo/local_frame.h"
#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/power_map.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::product {

/// Where a product comes from, as it goes into its metadata.
using Provenance = std::map<std::string, std::string>;

/// The entry, in degrees clockwise from the frame's north, that says where a map's radar stands, as seen from the map's
/// middle. Of radars over what they map there is none.
inline constexpr const char* radar_azimuth_key = "radar_azimuth_deg";

/// The entry that names the frame of what is told of a radar, of maps in another coordinate system.
inline constexpr const char* local_frame_key = "local_frame";

/// The entry that says by its word in which polarization a map's radar, or a picture, shows what it sees.
inline constexpr const char* polarization_key = "polarization";

/// A place of the radar or its velocity, as products tell it.
[[nodiscard]] std::string vector_text(Vec3d vector);

/// Notes radar, pose, time and provenance with a map. Time zero is the moment at which radar and targets are where they
/// are said to be; no clock goes in.
[[nodiscard]] radar::GroundMap described_map(radar::GroundMap map, const radar::Radar& radar,
                                             const geo::LocalFrame& frame, const Provenance& provenance);

[[nodiscard]] radar::PowerMap described_map(radar::PowerMap map, const radar::Radar& radar,
                                            const geo::LocalFrame& frame, const Provenance& provenance);

/// Lays an image on the ground and notes radar, position and provenance with it.
[[nodiscard]] radar::GroundMap described_map(const radar::RangeAzimuthImage& image, const radar::Radar& radar,
                                             const terrain::HeightField& terrain, const radar::GroundGrid& grid,
                                             const geo::LocalFrame& frame, const Provenance& provenance);

}  // namespace sigmascape::product
