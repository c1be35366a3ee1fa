#pragma once

#include <cstdint>

#include "paper_look.h"

namespace sigmascape::bench {

/// What a look is wrong by, from the mean of two long ones.
struct MapError {
  double l1 = 0.0;               ///< sum of the errors over the sum of the truth
  double rms_db = 0.0;           ///< of means over 4 × 4 texels (8 m), no lower than -45 dB
  double median_relative = 0.0;  ///< of single texels that a first surface lights and that are noisy at all
};

/// A piece of the paper's scene, 500 m a side, of which no ray is left out, with every texel's noise its own and shared
/// (bake::Noise). The piece lies in the middle of the scene.
struct Sharing {
  MapError own, shared;
  double power_ratio = 0.0;  ///< of all shared power over all own: 1 but for rounding
};
[[nodiscard]] Sharing what_sharing_gives(const scene::Scene& scene, const radar::Aspect& aspect, std::uint32_t samples,
                                         std::uint32_t truth_samples);

}  // namespace sigmascape::bench
