#include "sigmascape/receiver/response_axis.h"

#include <cmath>
#include <numeric>

#include "sigmascape/receiver/spreading_kernel.h"

namespace sigmascape::receiver {
namespace {

/// Twice the band, so that the spreading pulse is exact within it.
std::size_t fine_samples_for(std::size_t band) {
  return fast_length(std::max<std::size_t>(2 * band, 2 * SpreadingKernel::taps));
}

std::size_t index_of(std::ptrdiff_t frequency, std::size_t length) {
  return static_cast<std::size_t>(frequency < 0 ? frequency + static_cast<std::ptrdiff_t>(length) : frequency);
}

}  // namespace

ResponseTransform::ResponseTransform(const ResponseAxis& axis, const Subband& subband)
    : fine_(fine_samples_for(axis.band)),
      bins_(axis.bins),
      forward_(fine_, Fourier::Direction::Forward),
      backward_(bins_, Fourier::Direction::Backward) {
  const std::size_t width = axis.band / subband.looks;
  first_ = -(static_cast<std::ptrdiff_t>(axis.band) - 1) / 2 + static_cast<std::ptrdiff_t>(subband.look * width);
  const std::vector<double> window = radar::window_weights(axis.window, width);
  const double sum = std::accumulate(window.begin(), window.end(), 0.0);
  const double power = std::inner_product(window.begin(), window.end(), window.begin(), 0.0);
  for (const double weight : window) noise_window_.push_back(static_cast<float>(weight / std::sqrt(power)));
  for (std::size_t k = 0; k < width; ++k) {
    const double frequency = static_cast<double>(first_ + static_cast<std::ptrdiff_t>(k)) / static_cast<double>(fine_);
    weights_.push_back(static_cast<float>(window[k] / (sum * SpreadingKernel::spectrum(frequency))));
  }
}

void ResponseTransform::to_band(std::span<const std::complex<float>> fine, std::span<std::complex<float>> band) const {
  thread_local std::vector<std::complex<float>> spectrum;
  spectrum.resize(fine_);
  forward_.transform(fine, spectrum);
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    band[k] = spectrum[index_of(first_ + static_cast<std::ptrdiff_t>(k), fine_)] * weights_[k];
  }
}

void ResponseTransform::to_bins(std::span<const std::complex<float>> band, std::span<std::complex<float>> bins) const {
  thread_local std::vector<std::complex<float>> spectrum;
  spectrum.assign(bins_, {});
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    spectrum[index_of(first_ + static_cast<std::ptrdiff_t>(k), bins_)] = band[k];
  }
  backward_.transform(spectrum, bins);
}

}  // namespace sigmascape::receiver
