#include "sigmascape/receiver/doppler_imager.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/range_cell.h"
#include "sigmascape/receiver/carrier_phase.h"
#include "sigmascape/receiver/smear.h"

namespace sigmascape::receiver {
namespace {

ResponseAxis doppler_axis(const CoherentInterval& interval) {
  if (interval.pulses < 2 || !(interval.repetition_hz > 0.0) || !(interval.oversampling >= 1.0)) {
    throw Error("coherent interval",
                fmt::format("has {} pulses at {} Hz and {} bins a cell", interval.pulses, interval.repetition_hz,
                            interval.oversampling),
                "give at least two pulses, a positive repetition frequency and at least one bin a cell");
  }
  const auto bins = static_cast<std::size_t>(std::ceil(static_cast<double>(interval.pulses) * interval.oversampling));
  return {.bins = fast_length(bins), .band = interval.pulses, .window = interval.window, .periodic = true};
}

/// The place that answers in the middle of a bin, on level ground as high as `aim` and on that side of the course:
/// Doppler is the speed along the line of sight. Before the ground and beyond the course the nearest that does.
Vec3d ground_in(const radar::RangeDopplerImage& frame, Vec3d aim, std::size_t column, std::size_t row) {
  const auto& [position, velocity] = frame.platform;
  const double range_m = frame.range_m.middle_of(static_cast<double>(row) + 0.5);
  const double closing_mps =
      0.5 * wavelength_m(frame.frequency_hz) * frame.doppler_hz.middle_of(static_cast<double>(column) + 0.5);
  const double sine = std::clamp((aim.z - position.z) / range_m, -1.0, 1.0), cosine = std::sqrt(1.0 - sine * sine);
  const double speed_mps = std::hypot(velocity.x, velocity.y);
  if (!(speed_mps * cosine > 0.0)) return position + Vec3d{0.0, cosine, sine} * range_m;
  const double ahead = std::clamp((closing_mps - velocity.z * sine) / (speed_mps * cosine), -1.0, 1.0);
  const Vec2d course = Vec2d{velocity.x, velocity.y} * (1.0 / speed_mps);
  const double side = cross(course, Vec2d{aim.x - position.x, aim.y - position.y}) < 0.0 ? -1.0 : 1.0;
  const Vec2d direction = course * ahead + Vec2d{-course.y, course.x} * (side * std::sqrt(1.0 - ahead * ahead));
  return position + Vec3d{direction.x * cosine, direction.y * cosine, sine} * range_m;
}

}  // namespace

DopplerImager::DopplerImager(const radar::Radar& radar, const radar::Track& platform, const CoherentInterval& interval,
                             const RangeGate& gate, Vec3d aim, VoltageGain gain)
    : interval_(interval),
      range_(gated_axis(radar, gate)),
      aim_(aim),
      gain_(std::move(gain)),
      plane_(doppler_axis(interval), range_.axis) {
  frame_.platform = {platform.position_at(interval.middle_time_s), platform.velocity_at(interval.middle_time_s)};
  frame_.frequency_hz = radar.frequency_hz;
  frame_.pulse_repetition_hz = interval.repetition_hz;
  frame_.interval_s = static_cast<double>(interval.pulses) / interval.repetition_hz;
  const std::size_t bins = doppler_axis(interval).bins, middle_bin = bins / 2;
  const double step_hz = interval.repetition_hz / static_cast<double>(bins);
  const double centre_hz =
      radar::doppler_hz(radar::range_rate_mps(frame_.platform, {aim}), wavelength_m(radar.frequency_hz));
  frame_.doppler_hz = {centre_hz - static_cast<double>(middle_bin) * step_hz, step_hz, bins};
  frame_.range_cell_m = radar::range_cell_m(range_.bandwidth_hz, radar.waveform.window);
  frame_.doppler_cell_hz = radar::noise_bandwidth(interval.window, interval.pulses) / frame_.interval_s;
  frame_.range_m = {range_.start_m + static_cast<double>(range_.guard) * range_.step_m, range_.step_m, range_.samples};
}

PlacedAmplitude DopplerImager::placed(const radar::Motion& seen, double own_range_rate_mps,
                                      const radar::ComplexChannels& amplitude) const {
  const double range_m = length(seen.position - frame_.platform.position);
  const double wavelength = wavelength_m(frame_.frequency_hz);
  const double frequency =
      radar::doppler_hz(radar::range_rate_mps(frame_.platform, seen) + own_range_rate_mps, wavelength);
  const float voltage = gain_ ? gain_({interval_.middle_time_s, frame_.platform}, seen.position, range_m) : 1.0F;
  return {frame_.doppler_hz.place_of(frequency), frame_.range_m.place_of(range_m) + static_cast<double>(range_.guard),
          amplitude * (carrier_phase(range_m, wavelength) * voltage)};
}

void DopplerImager::add(std::span<const radar::Scatterer> ground, unsigned threads) {
  std::vector<PlacedAmplitude> places(ground.size());
  constexpr std::size_t chunk = 4096;
  parallel_for((ground.size() + chunk - 1) / chunk, threads, [&](std::size_t part, unsigned) {
    for (std::size_t i = part * chunk; i < std::min(ground.size(), (part + 1) * chunk); ++i) {
      places[i] = placed({ground[i].position}, ground[i].range_rate_mps, ground[i].amplitude_m);
    }
  });
  plane_.add(places, threads);
}

void DopplerImager::add(std::span<const radar::Target> targets) {
  std::vector<PlacedAmplitude> places;
  const double bins_a_cell = static_cast<double>(frame_.doppler_hz.bins) / static_cast<double>(interval_.pulses);
  const double wavelength = wavelength_m(frame_.frequency_hz);
  const double speed2 = dot(frame_.platform.velocity_mps, frame_.platform.velocity_mps);
  for (const radar::Target& target : targets) {
    const radar::Motion motion = radar::motion_of(target, interval_.middle_time_s);
    const double range_m = length(motion.position - frame_.platform.position);
    if (!(range_m > 0.0)) continue;  // the radar's own platform
    const radar::Channels rcs =
        radar::mean_rcs_of(target, frame_.platform.position, frame_.frequency_hz, interval_.middle_time_s);
    const PlacedAmplitude whole = placed(motion, 0.0, radar::steady_amplitude(rcs));
    // Beside ground at the same range and at the Doppler where the target is shown, which is in focus.
    const double shown_hz =
        radar::folded_hz(radar::doppler_hz(radar::range_rate_mps(frame_.platform, motion), wavelength),
                         frame_.doppler_hz.first, interval_.repetition_hz);
    const double shown_mps = -0.5 * wavelength * shown_hz;
    const double rate_error = radar::doppler_rate_hz_per_s(frame_.platform, motion, wavelength) +
                              2.0 * (speed2 - shown_mps * shown_mps) / (range_m * wavelength);
    for (const SmearedPart& part :
         smeared(target, rate_error, {frame_.interval_s, interval_.pulses, interval_.dwell})) {
      places.push_back({whole.column + part.cells * bins_a_cell, whole.row, whole.amplitude * part.amplitude});
    }
  }
  plane_.add(places);
}

void DopplerImager::add(const EquivalentNoise& noise) {
  noise_ = {.power =
                [noise, range_m = frame_.range_m, pulses = static_cast<double>(interval_.pulses),
                 bandwidth = radar::noise_bandwidth(interval_.window, interval_.pulses)](std::size_t row) {
                  return noise.rcs_m2(range_m.middle_of(static_cast<double>(row) + 0.5), pulses, bandwidth);
                },
            .seed = noise.seed()};
  if (!noise.is_lifted()) return;
  noise_.lift = [noise, frame = frame_, aim = aim_, time_s = interval_.middle_time_s](std::size_t column,
                                                                                      std::size_t row) {
    return noise.lift({time_s, frame.platform}, ground_in(frame, aim, column, row));
  };
}

radar::RangeDopplerImage DopplerImager::image(const Subband& part, unsigned threads) const {
  radar::RangeDopplerImage image = frame_;
  image.amplitude_m = noisy_rows(plane_, noise_, range_.guard, range_.samples, part, threads);
  image.doppler_cell_hz *= plane_.cells_of_a_look(part.looks);
  return image;
}

}  // namespace sigmascape::receiver
