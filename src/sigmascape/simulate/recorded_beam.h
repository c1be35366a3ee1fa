#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/receiver/calibrated_voltage.h"

namespace sigmascape::simulate {

/// Where the beam's axis points that does not scan: at the azimuth of a scan that fixes one; otherwise, and as a
/// spotlight in any case, to `aim`, a place in the straight space under the radar, or with Mode::Stripmap in the
/// direction in which that is seen at time zero.
[[nodiscard]] receiver::BeamAzimuth steered_beam(const radar::Radar& radar, Vec3d aim);

/// Where it points while pulses are recorded of ground about `aim`. That of a real beam follows a scan whose rate is
/// known: of a stated azimuth on the clock on which time zero of the recording is `moment_s`, else so that it comes to
/// `aim` at that time. Others are steered.
[[nodiscard]] receiver::BeamAzimuth recorded_beam(const radar::Radar& radar, Vec3d aim, double moment_s);

/// Whether that is a beam that scans.
[[nodiscard]] bool scans_as_it_records(const radar::Radar& radar);

}  // namespace sigmascape::simulate
