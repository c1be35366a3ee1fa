#pragma once

#include <cstdint>

#include "sigmascape/base/vec.h"

namespace sigmascape::scene {

/// A smooth random function of the plane with values in [0, 1) and features of unit size: hashed values at integer
/// points, joined by quintic steps.
[[nodiscard]] double value_noise(std::uint64_t seed, Vec2d p);

/// Octaves of value noise, each of half the size and half the weight of the one before, normalised to [0, 1).
[[nodiscard]] double fractal_noise(std::uint64_t seed, Vec2d p, unsigned octaves);

/// 0 below `from`, 1 above `to`, with zero slope at both.
[[nodiscard]] double smooth_step(double from, double to, double x);

}  // namespace sigmascape::scene
