#include "sigmascape/receiver/receive_chain.h"

#include <cmath>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/analog_to_digital.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/radar/range_response.h"
#include "sigmascape/radar/sensitivity_time_control.h"
#include "sigmascape/receiver/bin_response.h"

namespace sigmascape::receiver {
namespace {

double middle_range_m(const radar::RangeAzimuthGrid& grid, std::size_t row) {
  return grid.first_range_m + (static_cast<double>(row) + 0.5) * grid.range_step_m;
}

/// A complex Gaussian of mean square one, by Box and Muller.
std::complex<float> unit_noise(std::uint64_t seed, std::uint64_t number) {
  const std::uint64_t first = hashed(seed, number);
  const double u = (static_cast<double>(first >> 11U) + 0.5) * 0x1p-53;
  const double angle = 2.0 * pi * static_cast<double>(mixed(first) >> 11U) * 0x1p-53;
  const double amplitude = std::sqrt(-std::log(u));
  return {static_cast<float>(amplitude * std::cos(angle)), static_cast<float>(amplitude * std::sin(angle))};
}

/// The amplitudes of the compressed pulse at steps of the bins, their squares summing to one.
std::vector<float> noise_filter(const radar::Radar& radar, double range_step_m) {
  const auto pulse = radar::RangeResponse::of_width(radar.range_resolution_m, radar.waveform.window);
  const int reach = static_cast<int>(std::ceil(4.0 * radar.range_resolution_m / range_step_m));
  std::vector<double> amplitudes;
  double energy = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    amplitudes.push_back(pulse.voltage(k * range_step_m));
    energy += amplitudes.back() * amplitudes.back();
  }
  std::vector<float> scaled;
  for (const double amplitude : amplitudes) scaled.push_back(static_cast<float>(amplitude / std::sqrt(energy)));
  return scaled;
}

/// One azimuth at a time: the pulses that go there.
class Column {
 public:
  Column(const radar::Radar& radar, const ReceivedPower& power, const std::vector<float>& filter, std::uint64_t seed)
      : radar_(radar), power_(power), filter_(filter), seed_(seed) {}

  std::uint64_t detect(std::size_t column, Array2D<float>& video) const {
    std::uint64_t saturated = 0;
    std::vector<std::complex<float>> volts(power_.grid.ranges);
    for (int pulse = 0; pulse < radar_.receiver.pulses_integrated; ++pulse) {
      receive(column, pulse, volts);
      if (radar_.receiver.analog_to_digital) saturated += digitise(volts, *radar_.receiver.analog_to_digital);
      for (std::size_t row = 0; row < volts.size(); ++row)
        video(column, row) += detected(volts[row], radar_.receiver.detector);
    }
    for (std::size_t row = 0; row < volts.size(); ++row)
      video(column, row) /= static_cast<float>(radar_.receiver.pulses_integrated);
    return saturated;
  }

 private:
  void receive(std::size_t column, int pulse, std::span<std::complex<float>> volts) const {
    std::vector<std::complex<float>> white(volts.size() + filter_.size() - 1);
    const std::uint64_t of_pulse = hashed(seed_, std::uint64_t{column}, static_cast<std::uint64_t>(pulse));
    add_noise(white, power_.noise_w, radar_.receiver.impedance_ohm, of_pulse);
    for (std::size_t row = 0; row < volts.size(); ++row) {
      const double range_m = middle_range_m(power_.grid, row);
      const double signal_w = static_cast<double>(power_.signal_w(column, row));
      volts[row] = static_cast<float>(std::sqrt(signal_w * radar_.receiver.impedance_ohm));
      for (std::size_t k = 0; k < filter_.size(); ++k) volts[row] += white[row + k] * filter_[k];
      volts[row] *= static_cast<float>(std::sqrt(gain_at(range_m)));
    }
  }

  [[nodiscard]] double gain_at(double range_m) const {
    const auto& control = radar_.receiver.sensitivity_time_control;
    return radar_.receiver.gain * (control ? radar::power_gain(*control, range_m) : 1.0);
  }

  const radar::Radar& radar_;
  const ReceivedPower& power_;
  const std::vector<float>& filter_;
  std::uint64_t seed_;
};

}  // namespace

void check_receivable(radar::Polarization polarization) {
  if (polarization == radar::Polarization::Sum) {
    throw Error("received power", "cannot be that of the sum of polarizations, which no receiver has",
                "choose VV, HH, HV or VH");
  }
}

std::vector<double> watts_per_m2(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid) {
  const double bins_of_a_point =
      range_response(radar, grid.range_step_m).peak_bins * azimuth_response(radar, grid.azimuth_step_rad).peak_bins;
  std::vector<double> factors(grid.ranges);
  find_watts_per_m2(radar, grid, radar::compression_gain(radar), bins_of_a_point, factors);
  return factors;
}

void find_watts_per_m2(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid, double compression_gain,
                       double bins_of_a_point, std::span<double> factors) {
  for (std::size_t row = 0; row < grid.ranges; ++row) {
    const double range_m = middle_range_m(grid, row);
    const double heard =
        radar::uneclipsed_part(range_m, radar.waveform.pulse_length_s, radar.waveform.pulse_repetition_hz);
    factors[row] = radar::received_power_w(radar, 1.0, range_m) * compression_gain * bins_of_a_point * heard * heard;
  }
}

ReceivedPower received_power(const radar::Radar& radar, const radar::RangeAzimuthImage& image,
                             radar::Polarization polarization) {
  check_receivable(polarization);
  const radar::RangeAzimuthGrid& grid = image.grid;
  const std::vector<double> factors = watts_per_m2(radar, grid);
  ReceivedPower received{grid, Array2D<float>(grid.azimuths, grid.ranges), radar::noise_power_w(radar)};
  for (std::size_t row = 0; row < grid.ranges; ++row) {
    for (std::size_t column = 0; column < grid.azimuths; ++column) {
      const auto rcs_m2 = static_cast<double>(image.rcs_m2(column, row).power(polarization));
      received.signal_w(column, row) = static_cast<float>(factors[row] * rcs_m2);
    }
  }
  return received;
}

radar::ReceivedImage received_image(const radar::Radar& radar, const radar::RangeAzimuthImage& image) {
  const radar::RangeAzimuthGrid& grid = image.grid;
  const std::vector<double> factors = watts_per_m2(radar, grid);
  radar::ReceivedImage received{.grid = grid,
                                .radar_position = image.radar_position,
                                .power_w = Array2D<radar::Channels>(grid.azimuths, grid.ranges),
                                .noise_w = radar::noise_power_w(radar)};
  for (std::size_t row = 0; row < grid.ranges; ++row) {
    const auto factor = static_cast<float>(factors[row]);
    for (std::size_t column = 0; column < grid.azimuths; ++column)
      received.power_w(column, row) = image.rcs_m2(column, row) * factor;
  }
  return received;
}

void add_noise(std::span<std::complex<float>> volts, double noise_w, double impedance_ohm, std::uint64_t seed) {
  const auto amplitude = static_cast<float>(std::sqrt(noise_w * impedance_ohm));
  for (std::size_t i = 0; i < volts.size(); ++i) volts[i] += amplitude * unit_noise(seed, i);
}

std::uint64_t digitise(std::span<std::complex<float>> volts, const radar::AnalogToDigital& converter) {
  std::uint64_t saturated = 0;
  const auto convert = [&](float v) {
    return static_cast<float>(radar::digitised_v(converter, static_cast<double>(v)));
  };
  for (std::complex<float>& v : volts) {
    if (radar::saturates(converter, static_cast<double>(v.real())) ||
        radar::saturates(converter, static_cast<double>(v.imag())))
      ++saturated;
    v = {convert(v.real()), convert(v.imag())};
  }
  return saturated;
}

float detected(std::complex<float> volts, radar::Detector detector) {
  const float power = std::norm(volts);
  switch (detector) {
    case radar::Detector::Linear:
      return std::sqrt(power);
    case radar::Detector::SquareLaw:
      return power;
    case radar::Detector::Log:
      return 10.0F * std::log10(std::max(power, 1e-30F));
  }
  return power;
}

DetectedImage detected_image(const radar::Radar& radar, const ReceivedPower& power, std::uint64_t seed,
                             unsigned threads) {
  const auto filter = noise_filter(radar, power.grid.range_step_m);
  const Column columns(radar, power, filter, seed);
  DetectedImage image{power.grid, Array2D<float>(power.grid.azimuths, power.grid.ranges), 0};
  const unsigned workers = thread_count(threads);
  std::vector<std::uint64_t> saturated(workers, 0);
  parallel_for(power.grid.azimuths, workers,
               [&](std::size_t column, unsigned worker) { saturated[worker] += columns.detect(column, image.video); });
  for (const std::uint64_t part : saturated) image.saturated += part;
  return image;
}

}  // namespace sigmascape::receiver
