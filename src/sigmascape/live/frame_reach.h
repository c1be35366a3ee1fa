#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/live/live_settings.h"
#include "sigmascape/live/pose.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/render/level_of_detail.h"

namespace sigmascape::live {

/// Distances over the ground between which all that is in a frame's bins lies.
struct FrameReach {
  double near_m = 0.0, far_m = 0.0;
};

/// Where all that is in a frame's bins lies, for ground between two heights: the lowest of the first bin, and what is
/// in the last no farther (docs/physics/curved_earth.md, Eq. (4)).
[[nodiscard]] FrameReach frame_reach(const LiveSettings& settings, const Pose& pose, double lowest_m, double highest_m,
                                     const radar::CurvedEarth& earth);

/// Between it all ground lies that has a share in the bins: from half a bin before them to half a bin beyond. Of what
/// is within the first bin's range the highest is `highest_near_m`: where that stands higher above the radar than the
/// lowest below it, it is met first. A metre long at least.
[[nodiscard]] FrameReach sharing_reach(const LiveSettings& settings, const Pose& pose, double lowest_m,
                                       double highest_m, double highest_near_m, const radar::CurvedEarth& earth);

/// Nodes of a horizon along range: two a bin, and one bin beyond.
[[nodiscard]] std::size_t horizon_distances(const LiveSettings& settings);

/// Lines along which the horizon of a beam is known, by which its nodes stand about as far apart across as along range,
/// but no closer than the terrain's: between two lines on which the radar sees the ground there may lie a valley, and
/// ground a little lower than the chord between them is not hidden. Two at least of beams wider than the terrain's
/// nodes, 32 at most, and of all beams no more than memory has room for.
[[nodiscard]] std::size_t azimuths_a_beam(const LiveSettings& settings, FrameReach reach, double terrain_spacing_m);

/// The smallest rectangle about the ground between two directions and two distances from a place. The sector may be a
/// whole turn wide.
[[nodiscard]] radar::Rectangle ground_under(Vec2d radar, double first_azimuth_rad, double width_rad, FrameReach reach);

/// What the choice of detail follows from as far as the bins alone say it: cells are those of the ground, as though the
/// radar looked along it. The reach is that of ground of one height: between the lowest of the first bin and the
/// highest of the last there is more, by what they lay over, than the bins are long.
[[nodiscard]] render::DetailQuestion question_of_bins(const LiveSettings& settings, FrameReach level_ground);

}  // namespace sigmascape::live
