#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// Where a place lies as the radar flies: on the map and above it.
struct CoherentSight {
  Vec3d away;  ///< from the radar, at time zero or, of a strip, as its beam passes
  double range_m, ground_range_m, off_course_rad, horizontal_speed_mps;
};

[[nodiscard]] CoherentSight coherent_sight(const Radar& radar, Vec3d away);

/// The smaller of the angles to the course and to where the radar comes from.
[[nodiscard]] double off_the_line_rad(double off_course_rad);

[[nodiscard]] bool beam_straddles_course(const Radar& radar, const CoherentSight& sight);

/// Window's half-power width times looks: cells of one look in the width of the finished map.
[[nodiscard]] double cells_of_width(const Radar& radar);

/// Half-power width on the ground along constant range for an interval of one second, all looks together.
[[nodiscard]] double resolution_in_a_second_m(const Radar& radar, const CoherentSight& sight);

}  // namespace sigmascape::radar
