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
/// (docs/physics/diffuse.md). At node i of n θ is (i / (n − 1))² · 90°, close together where narrow mirrors answer, and
/// linear between. Assumes that the face is wide against the wave.
struct FaceReflectivity {
  static constexpr std::size_t node_count = 361;

  std::vector<Channels> at_node;

  [[nodiscard]] static double off_normal_rad(std::size_t node) {
    const double part = static_cast<double>(node) / static_cast<double>(node_count - 1);
    return 0.5 * pi * part * part;
  }
  /// Seen so far off its normal; nothing from behind.
  [[nodiscard]] Channels at(double cosine) const {
    if (cosine <= 0.0) return {};
    const double off_rad = std::acos(std::min(cosine, 1.0));
    const double place = std::sqrt(off_rad / (0.5 * pi)) * static_cast<double>(node_count - 1);
    const auto below = std::min(static_cast<std::size_t>(place), node_count - 2);
    const double from_rad = off_normal_rad(below), to_rad = off_normal_rad(below + 1);
    const auto part = static_cast<float>(std::clamp((off_rad - from_rad) / (to_rad - from_rad), 0.0, 1.0));
    return at_node[below] * (1.0F - part) + at_node[below + 1] * part;
  }
};

}  // namespace sigmascape::radar
