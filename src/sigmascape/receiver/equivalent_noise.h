#pragma once

#include <cstdint>

#include "sigmascape/radar/radar.h"

namespace sigmascape::receiver {

/// By what the noise of one dwell is drawn: others of the same ground, whose speckle the seed alone draws, have other
/// noise.
[[nodiscard]] std::uint64_t noise_seed(std::uint64_t seed, std::uint64_t dwell);
/// The same for one polarization received by itself: each has noise of its own.
[[nodiscard]] std::uint64_t noise_seed(std::uint64_t seed, std::uint64_t dwell, radar::Polarization polarization);

/// Thermal noise as an image in metres has it: what cross-section would give as much power.
///
///     σ_N(r) = k T₀ B F / (P_t G₀² λ² e^(−2αr) G_c / ((4π)³ r⁴ L)) · n_w / N          docs/physics/doppler.md, Eq.
///     (12)
///
/// N pulses are added up under a window of noise bandwidth n_w; G_c is the compression gain. On the antenna's axis.
class EquivalentNoise {
 public:
  EquivalentNoise(const radar::Radar& radar, std::uint64_t seed) : radar_(radar), seed_(seed) {}

  [[nodiscard]] double rcs_m2(double range_m, double pulses, double noise_bandwidth) const;
  [[nodiscard]] std::uint64_t seed() const { return seed_; }

 private:
  radar::Radar radar_;
  std::uint64_t seed_;
};

}  // namespace sigmascape::receiver
