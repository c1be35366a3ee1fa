#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace sigmascape::receiver {

/// Fourier transforms of one length, not scaled, any of which takes about as long as others of its size. Const, and
/// without state of its own: many threads may share one.
class Fourier {
 public:
  enum class Direction { Forward, Backward };  ///< exp(−2πi …) and exp(+2πi …)

  Fourier(std::size_t length, Direction direction);

  void transform(std::span<const std::complex<float>> from, std::span<std::complex<float>> to) const;

 private:
  struct Chirp;
  std::shared_ptr<const void> plan_;
  std::shared_ptr<const Chirp> chirp_;  ///< instead, for lengths with a large prime factor
};

/// The smallest length not below this one that transforms fast: no prime factors but 2, 3 and 5.
[[nodiscard]] std::size_t fast_length(std::size_t length);

}  // namespace sigmascape::receiver
