#pragma once

#include "sigmascape/radar/channels.h"
#include "sigmascape/scatter/surface_model.h"

namespace sigmascape::scatter {

/// σ0 of even, endless, level ground, with respect to horizontal area, at a grazing angle ψ: what of its backscatter
/// the ground sends back over its own area,
///
///     σ0 = 4π f sin² ψ                                                     docs/physics/estimator.md, Eq. (1)
[[nodiscard]] radar::Channels surface_sigma0(const SurfaceModel& surface, double grazing_rad);

}  // namespace sigmascape::scatter
