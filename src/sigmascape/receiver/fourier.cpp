#include "sigmascape/receiver/fourier.h"

#include <kissfft/kiss_fft.h>

namespace sigmascape::receiver {

Fourier::Fourier(std::size_t length, Direction direction)
    : plan_(kiss_fft_alloc(static_cast<int>(length), direction == Direction::Backward ? 1 : 0, nullptr, nullptr),
            [](const void* plan) { kiss_fft_free(const_cast<void*>(plan)); }) {}

void Fourier::transform(std::span<const std::complex<float>> from, std::span<std::complex<float>> to) const {
  static_assert(sizeof(kiss_fft_cpx) == sizeof(std::complex<float>), "KissFFT must be the one of floats");
  // A transform reads its plan only; the library's interface predates const.
  kiss_fft(static_cast<kiss_fft_cfg>(const_cast<void*>(plan_.get())),
           reinterpret_cast<const kiss_fft_cpx*>(from.data()), reinterpret_cast<kiss_fft_cpx*>(to.data()));
}

std::size_t fast_length(std::size_t length) {
  return static_cast<std::size_t>(kiss_fft_next_fast_size(static_cast<int>(length)));
}

}  // namespace sigmascape::receiver
