#pragma once

#include <string>
#include <vector>

#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::radar {

/// What a radar engineer would object to before this radar maps these bins onto cells of `cell_m`, one sentence each:
/// a swath longer than the unambiguous range, one outside the range gate, one in which the transmitter deafens the
/// receiver, cells too coarse for the beam.
[[nodiscard]] std::vector<std::string> radar_warnings(const Radar& radar, const RangeAzimuthGrid& bins, double cell_m);

}  // namespace sigmascape::radar
