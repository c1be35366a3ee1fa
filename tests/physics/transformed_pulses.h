#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/phase_history.h"
#include "sigmascape/radar/slant_image.h"

namespace sigmascape {

/// Power by which an image differs from a Fourier transform over pulses, term by term, over that of the transform, in
/// every so manieth row. `sample_at(row, pulse)`: what a pulse has in VV at the range of a row.
template <typename SampleAt>
double difference_from_transform(const radar::RangeDopplerImage& image, const radar::PhaseHistory& history,
                                 std::size_t row_step, const SampleAt& sample_at) {
  double error = 0.0, power = 0.0;
  for (std::size_t row = 0; row < image.range_m.bins; row += row_step) {
    std::vector<std::complex<double>> samples(history.pulses.size());
    for (std::size_t n = 0; n < samples.size(); ++n) samples[n] = sample_at(row, n);
    for (std::size_t column = 0; column < image.doppler_hz.bins; ++column) {
      const double frequency_hz = image.doppler_hz.middle_of(static_cast<double>(column) + 0.5);
      std::complex<double> sum;
      for (std::size_t n = 0; n < samples.size(); ++n)
        sum += samples[n] * std::polar(1.0, -2.0 * pi * frequency_hz * history.pulses[n].time_s);
      sum /= static_cast<double>(samples.size());
      error += std::norm(sum - std::complex<double>(image.amplitude_m(column, row).vv));
      power += std::norm(sum);
    }
  }
  return error / power;
}

}  // namespace sigmascape
