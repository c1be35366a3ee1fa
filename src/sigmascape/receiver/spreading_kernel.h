#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace sigmascape::receiver {

/// The short pulse by which an amplitude that lies between samples is put onto them, so that its spectrum, divided by
/// the pulse's own, is exact within half of the sampled band: a Kaiser–Bessel pulse of six samples [Jackson et al.
/// 1991; its shape parameter after Beatty et al. 2005]. What aliases into that half is below −80 dB.
class SpreadingKernel {
 public:
  static constexpr std::size_t taps = 6;
  static constexpr std::ptrdiff_t reach = taps / 2;

  SpreadingKernel();

  /// The first of the six samples that an amplitude at sample position `x` is put on.
  [[nodiscard]] static std::ptrdiff_t first_tap(double x);
  /// What it is multiplied by on each.
  [[nodiscard]] std::array<float, taps> weights(double x) const;
  /// The pulse's spectrum at so many cycles a sample, |ν| ≤ ¼.
  [[nodiscard]] static double spectrum(double cycles_per_sample);

 private:
  std::vector<std::array<float, taps>> table_;
};

}  // namespace sigmascape::receiver
