#pragma once

#include <cstdint>
#include <utility>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/receiver/voltage_gain.h"

namespace sigmascape::receiver {

/// By what the noise of one dwell is drawn: others of the same ground, whose speckle the seed alone draws, have other
/// noise.
[[nodiscard]] std::uint64_t noise_seed(std::uint64_t seed, std::uint64_t dwell);
/// The same for one polarization received by itself: each has noise of its own.
[[nodiscard]] std::uint64_t noise_seed(std::uint64_t seed, std::uint64_t dwell, radar::Polarization polarization);

/// Thermal noise as an image in metres has it: what cross-section would give as much power.
///
///     σ_N(r) = k T₀ B F / (P_t G₀² λ² e^(−2αr) G_c f² / ((4π)³ r⁴ L)) · n_w / N      docs/physics/doppler.md, Eq.
///     (12)
///
/// N pulses are added up under a window of noise bandwidth n_w; G_c is the compression gain, f the part of an echo that
/// the receiver is not deaf to (radar::uneclipsed_part), at least 0.001: an image has of all its ranges as much as if
/// they were heard whole. On the antenna's axis: of an image from which the antenna's pattern is divided, the noise is
/// lifted where that has less. Eq. (12b)
class EquivalentNoise {
 public:
  /// `divided_out`: the pattern, of an image that is freed of it.
  EquivalentNoise(const radar::Radar& radar, std::uint64_t seed, VoltageGain divided_out = {})
      : radar_(radar), seed_(seed), divided_out_(std::move(divided_out)) {}

  [[nodiscard]] double rcs_m2(double range_m, double pulses, double noise_bandwidth) const;
  [[nodiscard]] std::uint64_t seed() const { return seed_; }

  [[nodiscard]] bool is_lifted() const { return static_cast<bool>(divided_out_); }
  /// By how much where this is what a pulse sees, in power; at most 60 dB, for nobody evens out what is not there.
  [[nodiscard]] double lift(const radar::Pulse& pulse, Vec3d position) const;

 private:
  radar::Radar radar_;
  std::uint64_t seed_;
  VoltageGain divided_out_;
};

}  // namespace sigmascape::receiver
