#pragma once

#include <functional>

#include "sigmascape/radar/phase_history.h"

namespace sigmascape::receiver {

/// What a point at `position` is multiplied by, in voltage and both ways, when it is seen in a pulse: the antenna's
/// pattern, the radar equation, or, where there is no function, one. Called from several threads at once.
using VoltageGain = std::function<float(const radar::Pulse& pulse, Vec3d position, double range_m)>;

}  // namespace sigmascape::receiver
