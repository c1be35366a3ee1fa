#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace sigmascape::product {

/// What samples that are half as many again as a signal's band, or more, say of the signal between them: a sinc under a
/// Kaiser window over ten samples, wrong by −49 dB of what is near at the band's edges and by less within
/// (docs/physics/doppler.md, "Back onto the ground").
class BandInterpolation {
 public:
  static constexpr std::size_t taps = 10;

  BandInterpolation();

  /// By what the samples 4 before up to 5 after the one at or before a place count there; `part`, 0 to 1, is how far it
  /// lies on the way to the next. They sum to one.
  [[nodiscard]] const std::array<float, taps>& weights(double part) const;

 private:
  std::vector<std::array<float, taps>> table_;
};

}  // namespace sigmascape::product
