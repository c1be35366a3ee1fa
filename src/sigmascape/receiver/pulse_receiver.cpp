#include "sigmascape/receiver/pulse_receiver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <limits>

#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/receiver/carrier_phase.h"

namespace sigmascape::receiver {

struct PulseReceiver::Line {
  static constexpr std::size_t margin = SpreadingKernel::taps;
  std::vector<radar::ComplexChannels> fine;
};

PulseReceiver::PulseReceiver(const radar::Radar& radar, const RangeGate& gate)
    : frequency_hz_(radar.frequency_hz), range_(gated_axis(radar, gate)), transform_(range_.axis) {}

void PulseReceiver::add(Line& line, const radar::Pulse& pulse, Vec3d position, double range_m,
                        const radar::ComplexChannels& amplitude, double unambiguous_range_m,
                        const VoltageGain& gain) const {
  if (!(range_m > 0.0)) return;  // the radar's own platform
  double delay_m = range_m - range_.start_m;
  delay_m -= unambiguous_range_m * std::floor(delay_m / unambiguous_range_m);
  if (!(delay_m < range_.period_m)) return;
  const std::complex<float> phase = carrier_phase(range_m, wavelength_m(frequency_hz_));
  const float voltage = gain ? gain(pulse, position, range_m) : 1.0F;
  const radar::ComplexChannels received = amplitude * (phase * voltage);
  // A train of pulses echoes once every unambiguous range: what stands beside the gate has side lobes in it.
  for (; delay_m < range_.period_m; delay_m += unambiguous_range_m) spread(line, delay_m, received);
}

void PulseReceiver::spread(Line& line, double delay_m, const radar::ComplexChannels& received) const {
  const auto fine = static_cast<double>(transform_.fine_samples());
  const double place = delay_m / range_.period_m * fine + static_cast<double>(Line::margin);
  const auto weights = kernel_.weights(place);
  radar::ComplexChannels* const to = &line.fine[static_cast<std::size_t>(SpreadingKernel::first_tap(place))];
  for (std::size_t tap = 0; tap < weights.size(); ++tap) to[tap] += received * weights[tap];
}

void PulseReceiver::check(const PulseTrain& train, double memory_bytes) const {
  const double gate_m = static_cast<double>(range_.samples) * range_.step_m;
  const double unambiguous_m = radar::unambiguous_range_m(train.repetition_hz);
  if (!(gate_m < unambiguous_m)) {
    throw Error("range gate", fmt::format("is {:.0f} m long", gate_m),
                fmt::format("at {:.0f} pulses a second no more than {:.0f} m can be told apart", train.repetition_hz,
                            unambiguous_m));
  }
  const double bytes = static_cast<double>(train.count) * static_cast<double>(range_.samples) *
                       static_cast<double>(sizeof(radar::ComplexChannels));
  if (bytes > memory_bytes) {
    throw Error("coherent interval",
                fmt::format("has {} pulses of {} samples each, which take {:.3g} GB of memory, and there are {:.3g}",
                            train.count, range_.samples, bytes / 1e9, memory_bytes / 1e9),
                "record a shorter interval or a shorter range gate, or send fewer pulses a second");
  }
}

radar::PhaseHistory PulseReceiver::receive(const radar::Track& platform, const PulseTrain& train,
                                           std::span<const radar::Scatterer> ground,
                                           std::span<const radar::Target> targets, const VoltageGain& gain,
                                           unsigned threads, ProgressListener* progress) const {
  check(train, std::numeric_limits<double>::infinity());
  const double unambiguous_m = radar::unambiguous_range_m(train.repetition_hz), step_m = range_.step_m;
  radar::PhaseHistory history{.frequency_hz = frequency_hz_,
                              .bandwidth_hz = range_.bandwidth_hz,
                              .first_range_m = range_.start_m + static_cast<double>(range_.guard) * step_m,
                              .range_step_m = step_m,
                              .pulses = {},
                              .samples = Array2D<radar::ComplexChannels>(range_.samples, train.count),
                              .unit = gain ? "V" : "m"};
  for (std::size_t n = 0; n < train.count; ++n) {
    const double time_s = train.first_time_s + static_cast<double>(n) / train.repetition_hz;
    history.pulses.push_back({time_s, {platform.position_at(time_s), platform.velocity_at(time_s)}});
  }
  std::atomic<std::size_t> done{0};
  const auto tell = [&](std::size_t pulses) {
    if (progress == nullptr) return;
    progress->advanced("record", static_cast<double>(pulses), static_cast<double>(train.count), "pulses");
  };
  // A pulse belongs to one thread, and its points are added in the order in which they came.
  parallel_for(train.count, threads, [&](std::size_t n, unsigned worker) {
    const radar::Pulse& pulse = history.pulses[n];
    const std::size_t fine = transform_.fine_samples();
    Line line{std::vector<radar::ComplexChannels>(fine + 2 * Line::margin)};
    for (const radar::Scatterer& point : ground) {
      // What moves of itself is where it stands at time zero, and a fraction of a wavelength off at other times.
      const double range_m =
          length(point.position - pulse.platform.position) + static_cast<double>(point.range_rate_mps) * pulse.time_s;
      add(line, pulse, point.position, range_m, point.amplitude_m, unambiguous_m, gain);
    }
    for (const radar::Target& target : targets) {
      const Vec3d seen_from = pulse.platform.position;
      const radar::Channels rcs = radar::rcs_of(target, seen_from, frequency_hz_, {pulse.time_s, train.dwell, n});
      const Vec3d position = target.track.position_at(pulse.time_s);
      add(line, pulse, position, length(position - seen_from), radar::steady_amplitude(rcs), unambiguous_m, gain);
    }
    std::vector<std::complex<float>> fine_line(fine), band(transform_.kept()), bins(range_.axis.bins);
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
      for (std::size_t m = 0; m < range_.samples; ++m) of(history.samples(m, n)) = bins[m + range_.guard];
    }
    const std::size_t pulses = done.fetch_add(1, std::memory_order_relaxed) + 1;
    if (worker == 0) tell(pulses);
  });
  tell(train.count);
  return history;
}

}  // namespace sigmascape::receiver
