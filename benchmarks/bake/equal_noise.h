#pragma once

#include <span>
#include <vector>

#include "noise.h"
#include "paper_look.h"

namespace sigmascape::bench {

/// What plain sampling costs, and what ours costs for the same noise.
struct EqualNoise {
  Noise plain;
  double plain_seconds = 0.0;     ///< processor time of a look
  double median_seconds = 0.0;    ///< of ours, for the same median relative error over the texels that are noisy at all
  double l1_seconds = 0.0;        ///< of ours, for the same L1
  double noisy_share = 0.0;       ///< part of the lit texels that are noisy at all
  Honesty honesty;                ///< of ours, at the finest sampling that was tried
  double mean_ratio = 0.0;        ///< total power of ours over that of plain sampling
  double mean_ratio_error = 0.0;  ///< standard error of that, as the two plain maps tell it
};

/// Traces pairs of maps with independent scrambles: plain ones of so many rays, and ours with one sampling after the
/// other, from coarse to fine, until both noises are below those of the plain pair. Times between them are
/// interpolated, logarithm over logarithm.
[[nodiscard]] EqualNoise equal_noise(PaperLooks& looks, const radar::Aspect& aspect, std::uint32_t plain_samples,
                                     std::span<const bake::Sampling> samplings);

}  // namespace sigmascape::bench
