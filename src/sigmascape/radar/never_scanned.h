#pragma once

#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/azimuth_span.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/radar/scan.h"

namespace sigmascape::radar {

/// What is wrong where the beam's axis never comes to what is mapped, which lies under this azimuth of the frame.
[[nodiscard]] inline Error never_scanned(const Radar& radar, double azimuth_rad) {
  return {title_of(radar), "never points to what is to be mapped",
          fmt::format("let its scan take in azimuth {:.1f}°",
                      deg_from_radians(wrapped_azimuth(azimuth_rad - radar.north_rad)))};
}

/// Throws never_scanned when the beam's axis comes no nearer to any of an area than half a beam's width.
inline void require_scanned(const Radar& radar, const Rectangle& area) {
  const Vec2d foot{radar.position.x, radar.position.y};
  if (area.contains(foot)) return;
  const AzimuthSpan span = azimuths_of(area, foot);
  const double middle_rad = span.middle_rad + 0.5 * (span.left_rad + span.right_rad);
  if (!reaches(radar.scan, middle_rad, 0.5 * (span.right_rad - span.left_rad + radar.beam_width_rad)))
    throw never_scanned(radar, middle_rad);
}

}  // namespace sigmascape::radar
