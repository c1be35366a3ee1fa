#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/bake/patch_sums.h"
#include "sigmascape/bake/sampling.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::bake {

/// An echo where it stands in the patch, by the batch of samples that brought it.
struct Landed {
  std::uint32_t texel = 0;
  std::uint32_t batch = 0;
  bool several = false;    ///< came over several surfaces
  radar::Channels rcs_m2;  ///< as though its sample stood for the whole launch cell
};

/// Adds to the patch what one launch cell returns, with its variance.
///
/// With T_b the sum over the K_b of n samples of batch b that land in a texel, T their sum over all batches, the cell's
/// part of the texel is T / n, and the variance of that
///
///     Σ_b (T_b − T·K_b/n)² / (n² (1 − Σ_b K_b²/n²))                    docs/physics/estimator.md, Eq. (14)
///
/// which has the right mean when the batches are independent. Reorders `echoes`.
void add_cell(std::span<Landed> echoes, const Batches& batches, PatchSums& patch);

}  // namespace sigmascape::bake
