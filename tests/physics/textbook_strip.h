#pragma once

#include <cmath>
#include <complex>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/antenna_pattern.h"
#include "sigmascape/receiver/pulse_receiver.h"

namespace sigmascape {

/// What a strip-map processor of the textbook makes of pulses, written for tests alone: flight to the north, all on one
/// level, an even window over the band about that of the beam's axis.
struct TextbookStrip {
  double wavelength_m, speed_mps, band_hz;
  radar::AntennaCut beam;
  double squint_rad = 0.0;  ///< of the axis, ahead of broadside

  /// The pulses, focused at a place of the strip by turning back those under which its Doppler lies in the processed
  /// band, with the pattern undone.
  [[nodiscard]] std::complex<double> focused(const radar::PhaseHistory& history, double s, double r) const {
    std::complex<double> sum;
    double count = 0.0;
    for (std::size_t n = 0; n < history.pulses.size(); ++n) {
      const double along = s - history.pulses[n].platform.position.y, distance = std::hypot(along, r);
      const double doppler_hz = 2.0 * speed_mps * (along / distance - std::sin(squint_rad)) / wavelength_m;
      if (std::abs(doppler_hz) > band_hz / 2.0) continue;
      const double place = (distance - history.first_range_m) / history.range_step_m;
      const auto m = static_cast<std::size_t>(place);
      const double part = place - static_cast<double>(m);
      const std::complex<double> sample = std::complex<double>(history.samples(m, n).vv) * (1.0 - part) +
                                          std::complex<double>(history.samples(m + 1, n).vv) * part;
      sum += sample * std::polar(1.0 / beam.power(std::asin(along / distance) - squint_rad),
                                 std::remainder(4.0 * pi * distance / wavelength_m, 2.0 * pi));
      count += 1.0;
    }
    return sum / count;
  }
};

}  // namespace sigmascape
