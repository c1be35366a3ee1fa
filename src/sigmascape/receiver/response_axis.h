#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "sigmascape/radar/window.h"
#include "sigmascape/receiver/fourier.h"

namespace sigmascape::receiver {

/// One axis along which points are answered by a window's response: range by that of the band, Doppler or cross-range
/// by that of the coherent interval.
struct ResponseAxis {
  std::size_t bins = 0;  ///< samples over the axis' period
  std::size_t band = 0;  ///< frequencies within the window, a period's resolution cells: at most `bins`
  radar::Window window = {};
  /// What lies beyond the ends comes in at the other one, as Doppler does from one pulse repetition frequency to the
  /// next; otherwise it is left out.
  bool periodic = false;
};

/// A part of the band: look number `look` of `looks` equal ones. What is left over where it does not divide by them is
/// not used.
struct Subband {
  std::size_t look = 0;
  std::size_t looks = 1;
};

/// From amplitudes spread over fine samples to bins in which every point has the exact response
///
///     h(m) = Σ_k w_k exp(2πi k (m/M − x/P)) / Σ_k w_k                        docs/physics/doppler.md, Eq. (9)
///
/// of the window w over the band: as a receiver with so many frequencies, or pulses, has it.
class ResponseTransform {
 public:
  explicit ResponseTransform(const ResponseAxis& axis, const Subband& subband = {});

  /// Number of fine samples a period: amplitudes are spread over these.
  [[nodiscard]] std::size_t fine_samples() const { return fine_; }
  /// Number of frequencies that are kept.
  [[nodiscard]] std::size_t kept() const { return weights_.size(); }

  /// Weighted spectrum, of `kept()` frequencies, of `fine_samples()` samples.
  void to_band(std::span<const std::complex<float>> fine, std::span<std::complex<float>> band) const;
  /// The window over the band, its squares summing to one: by it noise that is white over the band gets power one a
  /// bin.
  [[nodiscard]] std::span<const float> noise_window() const { return noise_window_; }
  /// The lowest frequency kept, in cycles a period.
  [[nodiscard]] std::ptrdiff_t first_frequency() const { return first_; }
  /// Bins from that spectrum.
  void to_bins(std::span<const std::complex<float>> band, std::span<std::complex<float>> bins) const;

 private:
  std::size_t fine_, bins_;
  std::ptrdiff_t first_ = 0;
  std::vector<float> weights_, noise_window_;
  Fourier forward_, backward_;
};

}  // namespace sigmascape::receiver
