#pragma once

#include "sigmascape/radar/radar.h"
#include "sigmascape/receiver/calibrated_voltage.h"

namespace sigmascape::receiver {

/// What the antenna's pattern leaves of a point's voltage, both ways and relative to the peak: g_φ² g_ε². Without
/// `beam` the axis passes over every point in azimuth, as that of a scanning antenna does, and elevation alone counts.
[[nodiscard]] VoltageGain pattern_gain(const radar::Radar& radar, BeamAzimuth beam = {});

}  // namespace sigmascape::receiver
