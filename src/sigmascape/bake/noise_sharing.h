#pragma once

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::bake {

/// What rays brought to every texel of a patch, and how sure it is.
struct NoisyTexels {
  Array2D<radar::Channels> power;  ///< [column, row]
  Array2D<double> variance;        ///< [column, row]: of the total power (radar::Polarization::Sum), its unit squared
};

/// Lets texels share with those around them what their own rays leave in doubt.
///
/// Of its power x_j, whose standard error is s_j, a texel keeps the part that is sure and gives the rest to the 5 × 5
/// texels around, itself among them:
///
///     x'_i = w_i x_i + Σ_j k_ij (1 − w_j) x_j,   w_j = max(0, 1 − s_j²/x_j²)       docs/physics/estimator.md, Eq. (16)
///     k_ij = b_ij g_i / Σ_m b_mj g_m
///
/// b the binomial weights 1 4 6 4 1 along either axis, g_i the part of the 3 × 3 texels about i that hold any power;
/// both as if the patch went on beyond its rim as its mirror image, so that evenly lit ground stays even there. A
/// texel's k add up to 1 within the patch, so that power is kept channel by channel. What is sure stays where it is:
/// with more and more rays s/x goes to 0 and every x' to x.
///
/// A texel is not said to be surer, for its power, than its own rays made it, nor than what it was given:
///
///     s'_i² = max((1 − w_i) x'_i², Σ_j a_ij² s_j²),   a_ij = δ_ij w_i + k_ij (1 − w_j)                    Eq. (17)
///
/// Assumes that errors of texels are independent. `threads`: 0 for one a hardware thread; of no effect on the result.
[[nodiscard]] NoisyTexels with_noise_shared(const NoisyTexels& texels, unsigned threads);

}  // namespace sigmascape::bake
