#include "sigmascape/receiver/fourier.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

using Signal = std::vector<std::complex<float>>;

/// Lengths of small factors, and primes, which go another way.
class FourierOf : public ::testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] static Signal noise() {
    Signal signal(GetParam());
    for (std::size_t n = 0; n < signal.size(); ++n)
      signal[n] = {unit_float(hashed(1, n, 0)) - 0.5F, unit_float(hashed(1, n, 1)) - 0.5F};
    return signal;
  }
};

TEST_P(FourierOf, IsTheSumThatItStandsFor) {
  const Signal signal = noise();
  const auto count = static_cast<double>(signal.size());
  for (const auto& [direction, sign] :
       {std::pair{Fourier::Direction::Forward, -2.0 * pi}, {Fourier::Direction::Backward, 2.0 * pi}}) {
    Signal spectrum(signal.size());
    Fourier(signal.size(), direction).transform(signal, spectrum);
    for (std::size_t k = 0; k < signal.size(); k += 1 + signal.size() / 7) {
      std::complex<double> sum;
      for (std::size_t n = 0; n < signal.size(); ++n)
        sum += std::complex<double>(signal[n]) *
               std::polar(1.0, sign * static_cast<double>(n * k % signal.size()) / count);
      EXPECT_NEAR(std::abs(std::complex<double>(spectrum[k]) - sum), 0.0, 1e-5 * std::sqrt(count)) << k;
    }
  }
}

TEST_P(FourierOf, ComesBack) {
  const Signal signal = noise();
  Signal spectrum(signal.size()), back(signal.size());
  Fourier(signal.size(), Fourier::Direction::Forward).transform(signal, spectrum);
  Fourier(signal.size(), Fourier::Direction::Backward).transform(spectrum, back);
  for (std::size_t n = 0; n < signal.size(); ++n)
    ASSERT_NEAR(std::abs(back[n] / static_cast<float>(signal.size()) - signal[n]), 0.0F, 1e-5F) << n;
}

INSTANTIATE_TEST_SUITE_P(Lengths, FourierOf, ::testing::Values(1, 2, 97, 101, 1000, 1009, 8009, 3 * 8009),
                         [](const auto& instance) { return std::to_string(instance.param); });

}  // namespace
}  // namespace sigmascape::receiver
