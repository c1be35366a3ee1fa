#pragma once

#include <cstddef>
#include <cstdint>

#include "sigmascape/radar/ground_map.h"

namespace sigmascape::dataset {

/// Noise of the same σ0 in VV, HH and HV, which makes four times as much in `Sum`.
[[nodiscard]] constexpr radar::Channels even_noise(float sigma0) {
  return {sigma0, sigma0, sigma0, 0.0F};
}

struct SpeckleSettings {
  std::size_t looks = 1;  ///< averaged; 0 keeps the mean power of the ground
  float noise = 0.0F;     ///< mean power of the receiver's noise as σ0, the same in every cell and polarization
  std::uint64_t seed = 1;
};

/// One realisation of a map of mean power: each cell the mean of `looks` draws of complex Gaussian scatterers with the
/// cell's powers and its correlation of VV and HH, to which noise of that power is added. Of a polarization's power P
/// and noise N, L looks have mean P + N and variance (P + N)²/L (docs/physics/speckle.md). Draws of neighbouring cells
/// are independent: that is right for cells as large as the radar resolves. With no looks the ground is steady.
///
/// `targets`, the power of what answers steadily in every cell, is added to the amplitudes; empty for none. Depends on
/// seed and cell alone; cells that were not seen (NaN) stay so.
void draw_speckle(radar::GroundMap& map, const Array2D<radar::Channels>& targets, const SpeckleSettings& settings);

}  // namespace sigmascape::dataset
