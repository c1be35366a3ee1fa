#pragma once

#include <vector>

namespace sigmascape::radar {

enum class WindowShape { Rectangular, Cosine, Hamming, Taylor };

/// A weighting over the band of a pulse, over pulses or over the aperture of an antenna: what sets the width of the
/// main lobe against the height of the side lobes.
struct Window {
  WindowShape shape = WindowShape::Taylor;
  /// Taylor: the design level of the side lobes, power relative to the peak (1e-4: −40 dB).
  double taylor_side_lobe = 1e-4;
  /// Taylor: n̄, the number of the first zero that is left where the rectangular window has it; n̄ − 1 side lobes on each
  /// side are held at the design level.
  int taylor_terms = 6;

  friend constexpr bool operator==(const Window&, const Window&) = default;
};

/// One term a cos(2π f x) of a weighting over −½ ≤ x ≤ ½.
struct CosineTerm {
  double cycles = 0.0;     ///< f
  double amplitude = 0.0;  ///< a
};

/// All windows are sums of few cosines,
///
///     w(x) = Σ_m a_m cos(2π f_m x),   |x| ≤ ½                              docs/physics/waveform.md, Eq. (1)
///
/// with w scaled to the mean one.
[[nodiscard]] std::vector<CosineTerm> cosine_terms(const Window& window);

/// w at the middles of `count` equal parts of the width.
[[nodiscard]] std::vector<double> window_weights(const Window& window, std::size_t count);

/// N Σw²/(Σw)² of so many weights: the width, in cells of 1/N of the band, over which their response answers evenly.
/// That of the continuous window (WindowResponse::noise_bandwidth) from half a dozen on, one for a single one.
[[nodiscard]] double noise_bandwidth(const Window& window, std::size_t count);

}  // namespace sigmascape::radar
