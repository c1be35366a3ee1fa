#include "sigmascape/receiver/fourier.h"

#include <algorithm>
#include <functional>
#include <kissfft/kiss_fft.h>
#include <vector>

#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

/// The library's time goes with the sum of a length's prime factors. From some such factor on three transforms of more
/// than twice the length are less.
constexpr std::size_t large_factor = 100;

std::size_t largest_prime_factor(std::size_t length) {
  std::size_t largest = 1;
  for (std::size_t factor = 2; factor * factor <= length; ++factor) {
    while (length % factor == 0) {
      largest = factor;
      length /= factor;
    }
  }
  return std::max(largest, length);
}

}  // namespace

/// A transform as a convolution, L. I. Bluestein 1970: with nk = (n² + k² − (k − n)²)/2
///
///     X_k = w_k Σ_n (x_n w_n) w*_(k−n),   w_n = exp(∓πi n²/N)
struct Fourier::Chirp {
  std::vector<std::complex<float>> factors;   ///< w_n
  std::vector<std::complex<float>> spectrum;  ///< of w*, with the convolution's scale
  Fourier forward, backward;

  Chirp(std::size_t length, double sign)
      : factors(length),
        spectrum(fast_length(2 * length - 1)),
        forward(spectrum.size(), Direction::Forward),
        backward(spectrum.size(), Direction::Backward) {
    std::vector<std::complex<float>> chirp(spectrum.size());
    for (std::size_t n = 0; n < length; ++n) {
      const auto turn = static_cast<double>(n * n % (2 * length)) / static_cast<double>(length);
      const auto factor = std::complex<float>(std::polar(1.0, sign * pi * turn));
      factors[n] = factor;
      chirp[n] = chirp[(spectrum.size() - n) % spectrum.size()] = std::conj(factor) / static_cast<float>(chirp.size());
    }
    forward.transform(chirp, spectrum);
  }

  void transform(std::span<const std::complex<float>> from, std::span<std::complex<float>> to) const {
    std::vector<std::complex<float>> signal(spectrum.size()), transformed(spectrum.size());
    std::ranges::transform(from.first(factors.size()), factors, signal.begin(), std::multiplies());
    forward.transform(signal, transformed);
    std::ranges::transform(transformed, spectrum, transformed.begin(), std::multiplies());
    backward.transform(transformed, signal);
    std::ranges::transform(std::span(signal).first(factors.size()), factors, to.begin(), std::multiplies());
  }
};

Fourier::Fourier(std::size_t length, Direction direction) {
  const bool is_backward = direction == Direction::Backward;
  if (largest_prime_factor(length) >= large_factor) {
    chirp_ = std::make_shared<const Chirp>(length, is_backward ? 1.0 : -1.0);
    return;
  }
  plan_ = {kiss_fft_alloc(static_cast<int>(length), is_backward ? 1 : 0, nullptr, nullptr),
           [](const void* plan) { kiss_fft_free(const_cast<void*>(plan)); }};
}

void Fourier::transform(std::span<const std::complex<float>> from, std::span<std::complex<float>> to) const {
  if (chirp_) return chirp_->transform(from, to);
  static_assert(sizeof(kiss_fft_cpx) == sizeof(std::complex<float>), "KissFFT must be the one of floats");
  // A transform reads its plan only; the library's interface predates const.
  kiss_fft(static_cast<kiss_fft_cfg>(const_cast<void*>(plan_.get())),
           reinterpret_cast<const kiss_fft_cpx*>(from.data()), reinterpret_cast<kiss_fft_cpx*>(to.data()));
}

std::size_t fast_length(std::size_t length) {
  return static_cast<std::size_t>(kiss_fft_next_fast_size(static_cast<int>(length)));
}

}  // namespace sigmascape::receiver
