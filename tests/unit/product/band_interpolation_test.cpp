#include "sigmascape/product/band_interpolation.h"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::product {
namespace {

TEST(BandInterpolation, TellsWhatABandLimitedSignalIsBetweenItsSamples) {
  const BandInterpolation interpolation;
  constexpr auto taps = static_cast<int>(BandInterpolation::taps);
  for (double part = 0.0; part < 1.0; part += 0.0371) {
    const auto& weights = interpolation.weights(part);
    // Two thirds of the samples are a frequency of a third of a cycle a sample at the band's edge.
    for (double frequency = -1.0 / 3.0; frequency <= 1.0 / 3.0; frequency += 1.0 / 30.0) {
      std::complex<double> value;
      for (int tap = 0; tap < taps; ++tap) {
        const int sample = tap - (taps / 2 - 1);
        value += static_cast<double>(weights.at(static_cast<std::size_t>(tap))) *
                 std::polar(1.0, 2.0 * pi * frequency * sample);
      }
      EXPECT_LT(std::abs(value - std::polar(1.0, 2.0 * pi * frequency * part)), 5e-3) << part << ", " << frequency;
    }
  }
}

TEST(BandInterpolation, LeavesSamplesAsTheyAre) {
  const BandInterpolation interpolation;
  for (const double part : {0.0, 1.0}) {
    const auto& weights = interpolation.weights(part);
    const std::size_t own = BandInterpolation::taps / 2 - 1 + static_cast<std::size_t>(part);
    for (std::size_t tap = 0; tap < weights.size(); ++tap) EXPECT_NEAR(weights.at(tap), tap == own ? 1.0 : 0.0, 1e-6);
  }
}

}  // namespace
}  // namespace sigmascape::product
