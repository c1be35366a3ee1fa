#include "sigmascape/radar/doppler_span.h"

#include <algorithm>
#include <fmt/format.h>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/doppler.h"

namespace sigmascape::radar {

double doppler_of_hz(const Radar& radar, Vec3d place) {
  return doppler_hz(range_rate_mps({radar.position, radar.velocity_mps}, {place}), wavelength_m(radar.frequency_hz));
}

DopplerSpan doppler_span(const Radar& radar, std::span<const Vec3d> places) {
  if (places.empty()) return {};
  DopplerSpan span{.least_hz = doppler_of_hz(radar, places.front()), .most_hz = doppler_of_hz(radar, places.front())};
  for (const Vec3d place : places.subspan(1)) {
    const double frequency_hz = doppler_of_hz(radar, place);
    span.least_hz = std::min(span.least_hz, frequency_hz);
    span.most_hz = std::max(span.most_hz, frequency_hz);
  }
  return span;
}

std::optional<std::string> doppler_that_folds(const Radar& radar, const DopplerSpan& span, std::string_view what) {
  const double spans_hz = span.most_hz - span.least_hz, prf_hz = radar.waveform.pulse_repetition_hz;
  if (!(spans_hz > prf_hz)) return std::nullopt;
  return fmt::format(
      "the Doppler of {} spans {:.4g} Hz, more than the pulse repetition frequency of {:g} Hz, and folds over; map "
      "less "
      "or send more pulses",
      what, spans_hz, prf_hz);
}

}  // namespace sigmascape::radar
