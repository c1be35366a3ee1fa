#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::radar {

/// What a flat face returns directly, by the angle θ between its normal and the way to the radar: cross-section over
/// its area,
///
///     g(θ) = 4π f cos² θ                                                   docs/physics/estimator.md, Eq. (1)
///
/// f its BRDF towards where the wave came from, for the radar's own polarizations however the face is turned: mirrors
/// that answer are met head-on, and diffuse surfaces have their powers as a radar states them
/// (docs/physics/diffuse.md). By angle, every `step_deg` from 0° to 90°, and linear between. Assumes that the face is
/// wide against the wave.
struct FaceReflectivity {
  static constexpr double step_deg = 0.25;
  static constexpr std::size_t node_count = 361;

  std::vector<Channels> at_node;

  /// Seen so far off its normal; nothing from behind.
  [[nodiscard]] Channels at(double cosine) const {
    if (cosine <= 0.0) return {};
    const double place = deg_from_radians(std::acos(std::min(cosine, 1.0))) / step_deg;
    const auto below = std::min(static_cast<std::size_t>(place), node_count - 2);
    const auto part = static_cast<float>(place - static_cast<double>(below));
    return at_node[below] * (1.0F - part) + at_node[below + 1] * part;
  }
};

}  // namespace sigmascape::radar
