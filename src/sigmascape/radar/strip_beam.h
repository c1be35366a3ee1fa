#pragma once

#include <optional>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// Where the scan fixes the beam of a strip, clockwise from the frame's north. Nothing where it does not: then the beam
/// keeps the azimuth in which it sees the middle of what is mapped at time zero.
[[nodiscard]] std::optional<double> fixed_strip_azimuth_rad(const Radar& radar);

/// Where that beam points over the ground; a unit vector, zero where it would be straight down.
[[nodiscard]] Vec2d strip_direction(const Radar& radar, Vec2d middle);

/// Whether the course, ahead or behind, lies within the beam, which then passes over nothing.
[[nodiscard]] bool straddles_course(const Radar& radar, Vec2d direction);

/// The way to the middle of what a strip maps from where the platform is as the beam passes over it, which without a
/// fixed beam is at time zero. Throws Error where a fixed one straddles the course or looks to its other side.
[[nodiscard]] Vec3d way_as_passed(const Radar& radar, Vec3d middle);

/// The radar where it is then; one that maps no strips as it is. Throws Error likewise.
[[nodiscard]] Radar as_it_passes(const Radar& radar, Vec3d middle);

}  // namespace sigmascape::radar
