#pragma once

#include <cstdint>

#include "sigmascape/base/units.h"

namespace sigmascape::bake {

/// How many rays each launch cell gets.
///
/// Adaptive: every cell starts with a few pilot rays, and gets as many in all as the pilots of the cells around it say
/// are needed. A cell's own pilots have no say in its number, so that the mean over its rays stays unbiased
/// (docs/decisions/0015-adaptive-sampling.md).
struct Sampling {
  /// Rays a cell, everywhere the same but where the launch spares rays (trace::LaunchCell::share); 0: adaptive, by what
  /// follows.
  std::uint32_t samples_per_texel = 0;
  /// Relative standard error of the power that a cell returns which is aimed at.
  double target_db = 0.4;
  /// Cells that return less than this σ0 need only be as exact as this one.
  double floor_db = -45.0;
  /// No cell gets more rays.
  std::uint32_t most_samples = 128;

  friend bool operator==(const Sampling&, const Sampling&) = default;
  [[nodiscard]] bool is_adaptive() const { return samples_per_texel == 0; }
  /// The target as a part of the power.
  [[nodiscard]] double relative_target() const { return linear_from_db(target_db) - 1.0; }
};

/// What all rays of a cell bring is summed up at once: of as many as this it needs some 100 MiB a thread, and 50 more
/// for each frequency but the first.
inline constexpr std::uint32_t most_samples_a_cell = 1U << 20U;

/// What a target may be.
inline constexpr double least_target_db = 0.01, most_target_db = 10.0;

/// Rays that adaptive sampling starts with.
inline constexpr std::uint32_t pilot_samples = 8;

}  // namespace sigmascape::bake
