#pragma once

#include "sigmascape/base/units.h"
#include "sigmascape/radar/window_response.h"

namespace sigmascape::radar {

/// The compressed pulse over slant range: the answer to a point, after the matched filter and the window over the band,
/// with the carrier's phase taken out.
///
///     h(Δr) = W(2 B Δr / c)                                                docs/physics/waveform.md, Eq. (4)
///
/// W the window's response. Real and even; the phase exp(−4πi r/λ) of the echo is its own.
class RangeResponse {
 public:
  RangeResponse(double bandwidth_hz, const Window& window)
      : response_(window), per_m_(2.0 * bandwidth_hz / speed_of_light_mps) {}
  /// The pulse of a given half-power width, whatever the window.
  [[nodiscard]] static RangeResponse of_width(double half_power_width_m, const Window& window);

  [[nodiscard]] double voltage(double offset_m) const { return response_.voltage(offset_m * per_m_); }
  [[nodiscard]] double power(double offset_m) const { return response_.power(offset_m * per_m_); }
  [[nodiscard]] double half_power_width_m() const { return response_.half_power_width() / per_m_; }
  [[nodiscard]] double bandwidth_hz() const { return per_m_ * speed_of_light_mps / 2.0; }
  /// Power relative to the peak; energy relative to the main lobe's; see WindowResponse.
  [[nodiscard]] double peak_side_lobe() const { return response_.peak_side_lobe(); }
  [[nodiscard]] double integrated_side_lobes() const { return response_.integrated_side_lobes(); }
  [[nodiscard]] const WindowResponse& window_response() const { return response_; }

 private:
  WindowResponse response_;
  double per_m_;
};

/// The bandwidth whose compressed pulse is so wide at half power: B = w c / (2 δ_r), w the window's half-power width.
[[nodiscard]] double bandwidth_of(double range_resolution_m, const Window& window);
/// The half-power width of the compressed pulse of this bandwidth.
[[nodiscard]] double range_resolution_of(double bandwidth_hz, const Window& window);

/// The bandwidth about a carrier that no pulse has, for its lower edge would be at no frequency at all: 2 f.
[[nodiscard]] constexpr double widest_band_hz(double frequency_hz) {
  return 2.0 * frequency_hz;
}

}  // namespace sigmascape::radar
