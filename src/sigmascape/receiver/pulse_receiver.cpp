#include "sigmascape/receiver/pulse_receiver.h"

#include <array>
#include <cmath>
#include <complex>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/complex_gaussian.h"
#include "sigmascape/radar/range_response.h"

namespace sigmascape::receiver {
namespace {

/// Resolutions beyond each end of the gate whose side lobes still reach into it.
constexpr std::size_t guard_cells = 64;

/// An odd number of frequencies, so that the response is real.
std::size_t odd(double at_least) {
  const auto count = static_cast<std::size_t>(std::ceil(at_least));
  return count + 1 - count % 2;
}

double resolution_m(double bandwidth_hz) {
  return speed_of_light_mps / (2.0 * bandwidth_hz);
}

ResponseAxis range_axis(const radar::Radar& radar, const RangeGate& gate) {
  if (!(gate.last_range_m > gate.first_range_m) || !(gate.first_range_m >= 0.0) || !std::isfinite(gate.last_range_m)) {
    throw Error("range gate", fmt::format("goes from {} m to {} m", gate.first_range_m, gate.last_range_m),
                "let it end beyond where it begins");
  }
  if (!(gate.oversampling >= 1.0)) {
    throw Error("range gate", fmt::format("has {} samples a resolution", gate.oversampling),
                "give at least 1: fewer would lose part of the band");
  }
  const double bandwidth_hz = radar::bandwidth_of(radar.range_resolution_m, radar.waveform.window);
  const double cells = (gate.last_range_m - gate.first_range_m) / resolution_m(bandwidth_hz);
  constexpr double most_cells = 1e7;
  if (!(cells < most_cells)) {
    throw Error("range gate", fmt::format("holds {:.0f} resolution cells", cells),
                "make it shorter or the cells larger");
  }
  const std::size_t band = odd(cells + 2.0 * guard_cells);
  const auto bins = fast_length(static_cast<std::size_t>(std::ceil(static_cast<double>(band) * gate.oversampling)));
  return {.bins = bins, .band = band, .window = radar.waveform.window};
}

/// The phasor of −4π r/λ, without losing the last part of a turn to float.
std::complex<float> carrier(double range_m, double wavelength) {
  const double turns = -2.0 * range_m / wavelength;
  const auto word = static_cast<std::uint32_t>(static_cast<std::int64_t>((turns - std::floor(turns)) * 0x1p32));
  const radar::ComplexPair phasor = radar::unit_phasor(word);
  return {phasor.re, phasor.im};
}

}  // namespace

struct PulseReceiver::Line {
  static constexpr std::size_t margin = SpreadingKernel::taps;
  std::vector<radar::ComplexChannels> fine;
};

PulseReceiver::PulseReceiver(const radar::Radar& radar, const RangeGate& gate)
    : frequency_hz_(radar.frequency_hz),
      bandwidth_hz_(radar::bandwidth_of(radar.range_resolution_m, radar.waveform.window)),
      axis_(range_axis(radar, gate)),
      transform_(axis_) {
  period_m_ = static_cast<double>(axis_.band) * resolution_m(bandwidth_hz_);
  const double step_m = period_m_ / static_cast<double>(axis_.bins);
  guard_ = static_cast<std::size_t>(std::ceil(guard_cells * resolution_m(bandwidth_hz_) / step_m));
  samples_ = static_cast<std::size_t>(std::floor((gate.last_range_m - gate.first_range_m) / step_m)) + 1;
  start_m_ = gate.first_range_m - static_cast<double>(guard_) * step_m;
}

void PulseReceiver::add(Line& line, const radar::Pulse& pulse, Vec3d position, const radar::ComplexChannels& amplitude,
                        double unambiguous_range_m, const VoltageGain& gain) const {
  const double range_m = length(position - pulse.platform.position);
  double delay_m = range_m - start_m_;
  delay_m -= unambiguous_range_m * std::floor(delay_m / unambiguous_range_m);
  if (!(delay_m < period_m_)) return;
  const auto fine = static_cast<double>(transform_.fine_samples());
  const double place = delay_m / period_m_ * fine + static_cast<double>(Line::margin);
  const std::complex<float> phase = carrier(range_m, wavelength_m(frequency_hz_));
  const float voltage = gain ? gain(pulse, position, range_m) : 1.0F;
  const radar::ComplexChannels received = amplitude * (phase * voltage);
  const auto weights = kernel_.weights(place);
  radar::ComplexChannels* const to = &line.fine[static_cast<std::size_t>(SpreadingKernel::first_tap(place))];
  for (std::size_t tap = 0; tap < weights.size(); ++tap) to[tap] += received * weights[tap];
}

radar::PhaseHistory PulseReceiver::receive(const radar::Track& platform, const PulseTrain& train,
                                           std::span<const radar::Scatterer> ground,
                                           std::span<const radar::Target> targets, const VoltageGain& gain,
                                           unsigned threads) const {
  const double unambiguous_m = speed_of_light_mps / (2.0 * train.repetition_hz);
  const double step_m = period_m_ / static_cast<double>(axis_.bins);
  if (!(static_cast<double>(samples_) * step_m < unambiguous_m)) {
    throw Error("range gate", fmt::format("is {:.0f} m long", static_cast<double>(samples_) * step_m),
                fmt::format("at {:.0f} pulses a second no more than {:.0f} m can be told apart", train.repetition_hz,
                            unambiguous_m));
  }
  radar::PhaseHistory history{.frequency_hz = frequency_hz_,
                              .bandwidth_hz = bandwidth_hz_,
                              .first_range_m = start_m_ + static_cast<double>(guard_) * step_m,
                              .range_step_m = step_m,
                              .pulses = {},
                              .samples = Array2D<radar::ComplexChannels>(samples_, train.count),
                              .unit = "m"};
  for (std::size_t n = 0; n < train.count; ++n) {
    const double time_s = train.first_time_s + static_cast<double>(n) / train.repetition_hz;
    history.pulses.push_back({time_s, {platform.position_at(time_s), platform.velocity_at(time_s)}});
  }
  // A pulse belongs to one thread, and its points are added in the order in which they came.
  parallel_for(train.count, threads, [&](std::size_t n, unsigned) {
    const radar::Pulse& pulse = history.pulses[n];
    const std::size_t fine = transform_.fine_samples();
    Line line{std::vector<radar::ComplexChannels>(fine + 2 * Line::margin)};
    for (const radar::Scatterer& point : ground) {
      add(line, pulse, point.position, point.amplitude_m, unambiguous_m, gain);
    }
    for (const radar::Target& target : targets) {
      const Vec3d seen_from = pulse.platform.position;
      const radar::Channels rcs = radar::rcs_of(target, seen_from, frequency_hz_, {pulse.time_s, train.dwell, n});
      add(line, pulse, target.track.position_at(pulse.time_s), radar::steady_amplitude(rcs), unambiguous_m, gain);
    }
    std::vector<std::complex<float>> fine_line(fine), band(transform_.kept()), bins(axis_.bins);
    for (std::size_t p = 0; p < radar::ComplexChannels::count; ++p) {
      const auto of = [p](auto& channels) -> auto& {
        return p == 0 ? channels.vv : p == 1 ? channels.hh : channels.hv;
      };
      std::fill(fine_line.begin(), fine_line.end(), std::complex<float>{});
      for (std::size_t i = 0; i < line.fine.size(); ++i) {
        fine_line[(i + 2 * fine - Line::margin) % fine] += of(line.fine[i]);
      }
      transform_.to_band(fine_line, band);
      transform_.to_bins(band, bins);
      for (std::size_t m = 0; m < samples_; ++m) of(history.samples(m, n)) = bins[m + guard_];
    }
  });
  return history;
}

}  // namespace sigmascape::receiver
