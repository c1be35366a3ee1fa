#pragma once

#include <vector>

#include "sigmascape/radar/window.h"

namespace sigmascape::radar {

/// What a window becomes on the other side of the Fourier transform, scaled to one at its peak:
///
///     h(t) = ∫ w(x) exp(2πi x t) dx = Σ_m ½ a_m (sinc(t − f_m) + sinc(t + f_m))        docs/physics/waveform.md, Eq.
///     (3)
///
/// Windows are even, so h is real. For a pulse of bandwidth B, t = B·(delay); for an aperture of length D,
/// t = (D/λ) sin θ; for a coherent interval T, t = T·(Doppler offset).
class WindowResponse {
 public:
  explicit WindowResponse(const Window& window);

  /// h(t): an amplitude, of either sign.
  [[nodiscard]] double voltage(double t) const;
  [[nodiscard]] double power(double t) const {
    const double amplitude = voltage(t);
    return amplitude * amplitude;
  }
  /// Full width of |h|² at half its peak, in units of t.
  [[nodiscard]] double half_power_width() const { return half_power_width_; }
  /// The first zero of h, where the main lobe ends.
  [[nodiscard]] double first_null() const { return first_null_; }
  /// The highest |h|² beyond the main lobe.
  [[nodiscard]] double peak_side_lobe() const;
  /// ∫|h|² beyond the main lobe over ∫|h|² within it.
  [[nodiscard]] double integrated_side_lobes() const;
  /// ∫|h|² dt = mean of w² over the square of its mean: by this factor a weighted receiver's noise bandwidth exceeds
  /// that of the rectangular window (Hamming 1.363, 1.34 dB), and its signal-to-noise ratio falls short.
  [[nodiscard]] double noise_bandwidth() const;

 private:
  std::vector<CosineTerm> terms_;
  double half_power_width_ = 0.0, first_null_ = 0.0;
};

/// The n̄, of `fewest` and more, from which on a Taylor window has no side lobe above its design level: with fewer the
/// first ones are higher than that, the more so the lower it is. docs/physics/waveform.md, "Windows".
[[nodiscard]] int taylor_terms_for(double side_lobe, int fewest);

}  // namespace sigmascape::radar
