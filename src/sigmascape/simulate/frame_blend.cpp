#include "sigmascape/simulate/frame_blend.h"

#include <cmath>
#include <cstddef>

namespace sigmascape::simulate {

void blend_powers(std::span<const float> first, std::span<const float> second, double second_share,
                  std::span<float> blended) {
  const auto s = static_cast<float>(second_share);
  for (std::size_t i = 0; i < blended.size(); ++i) blended[i] = (1.0F - s) * first[i] + s * second[i];
}

void blend_amplitudes(std::span<const std::complex<float>> first, std::span<const std::complex<float>> second,
                      double second_share, std::span<std::complex<float>> blended) {
  const auto s = static_cast<float>(second_share);
  for (std::size_t i = 0; i < blended.size(); ++i) {
    const std::complex<float> sum = (1.0F - s) * first[i] + s * second[i];
    const float power = (1.0F - s) * std::norm(first[i]) + s * std::norm(second[i]), of_sum = std::norm(sum);
    // Where the two cancel out there is no phase to take; the greater has one.
    const std::complex<float> direction =
        of_sum > 0.0F ? sum / std::sqrt(of_sum) : std::polar(1.0F, std::arg(s < 0.5F ? first[i] : second[i]));
    blended[i] = direction * std::sqrt(power);
  }
}

}  // namespace sigmascape::simulate
