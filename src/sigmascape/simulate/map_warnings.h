#pragma once

#include <string>
#include <vector>

#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// What whoever asks for this map should know before it is made, one sentence each: what radar::radar_warnings objects
/// to, and an area of which map_grid() leaves a cell or more out since `extent`, which the scene covers, ends before
/// it. Throws Error as map_grid() does.
[[nodiscard]] std::vector<std::string> map_warnings(const radar::Radar& radar, const radar::MapRequest& request,
                                                    const terrain::HeightField& terrain,
                                                    const radar::Rectangle& extent);

}  // namespace sigmascape::simulate
