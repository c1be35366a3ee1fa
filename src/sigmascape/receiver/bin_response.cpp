#include "sigmascape/receiver/bin_response.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/range_response.h"

namespace sigmascape::receiver {
namespace {

/// `power(k)`, which is one at its peak, for bins k = −reach … reach, cut where no more than `left_out` of the sum lies
/// beyond on both sides.
template <typename Power>
BinResponse sampled(int reach, double left_out, Power&& power) {
  std::vector<double> at_least(static_cast<std::size_t>(reach) + 2, 0.0);  // of |k| ≥ index
  for (int k = reach; k >= 1; --k)
    at_least[static_cast<std::size_t>(k)] = at_least[static_cast<std::size_t>(k) + 1] + power(k) + power(-k);
  const double total = at_least[1] + power(0);
  int kept = 0;
  while (kept < reach && at_least[static_cast<std::size_t>(kept) + 1] > left_out * total) ++kept;

  const double sum = total - at_least[static_cast<std::size_t>(kept) + 1];
  BinResponse response;
  for (int k = -kept; k <= kept; ++k) response.weights.push_back(static_cast<float>(power(k) / sum));
  response.peak_bins = sum;
  return response;
}

/// How far responses are followed at most, in resolution cells.
constexpr double farthest_cells = 64.0;

}  // namespace

BinResponse range_response(const radar::Radar& radar, double range_step_m) {
  const auto pulse = radar::RangeResponse::of_width(radar.range_resolution_m, radar.waveform.window);
  const int reach = static_cast<int>(std::ceil(farthest_cells * radar.range_resolution_m / range_step_m));
  return sampled(reach, 3e-4, [&](int k) { return pulse.power(k * range_step_m); });
}

BinResponse azimuth_response(const radar::Radar& radar, double azimuth_step_rad) {
  const auto pattern = radar::antenna_pattern(radar);
  const double farthest_rad = std::min(pi, pattern.azimuth().silent_beyond_rad());
  const int reach = static_cast<int>(farthest_rad / azimuth_step_rad);
  return sampled(reach, 1e-5, [&](int k) { return pattern.azimuth().two_way_power(k * azimuth_step_rad); });
}

double range_energy_bins(const radar::Radar& radar, double range_step_m) {
  const auto pulse = radar::RangeResponse::of_width(radar.range_resolution_m, radar.waveform.window);
  const double widths = pulse.window_response().noise_bandwidth() / pulse.window_response().half_power_width();
  return widths * radar.range_resolution_m / range_step_m;
}

double azimuth_energy_bins(const radar::Radar& radar, double azimuth_step_rad) {
  // Twice as many as the two-way pattern of an aperture has to be sampled at for its sum to be its integral.
  constexpr double samples_a_width = 8.0;
  const double samples_a_bin = std::max(std::ceil(samples_a_width * azimuth_step_rad / radar.beam_width_rad), 1.0);
  return azimuth_response(radar, azimuth_step_rad / samples_a_bin).peak_bins / samples_a_bin;
}

PlacedResponse::Weights PlacedResponse::at(double place) const {
  // The nearest bin is always among them, at most half a bin away.
  const double nearest = std::floor(place), first = nearest - reach_, last = nearest + reach_;
  std::vector<double> powers;
  double sum = 0.0;
  for (double bin = first; bin <= last; ++bin) {
    powers.push_back(power_(place - (bin + 0.5)));
    sum += powers.back();
  }
  Weights weights{static_cast<std::ptrdiff_t>(first), std::vector<float>(powers.size(), 0.0F)};
  // A response much narrower than the bins may be nothing at the middles of all.
  if (!(sum > 0.0)) {
    weights.of_bins[static_cast<std::size_t>(reach_)] = 1.0F;
    return weights;
  }
  for (std::size_t k = 0; k < powers.size(); ++k) weights.of_bins[k] = static_cast<float>(powers[k] / sum);
  return weights;
}

PlacedResponse placed_range_response(const radar::Radar& radar, double range_step_m) {
  const auto pulse = radar::RangeResponse::of_width(radar.range_resolution_m, radar.waveform.window);
  return {[pulse, range_step_m](double offset_bins) { return pulse.power(offset_bins * range_step_m); },
          range_response(radar, range_step_m).weights.size() / 2};
}

PlacedResponse placed_azimuth_response(const radar::Radar& radar, double azimuth_step_rad) {
  const auto beam = radar::antenna_pattern(radar).azimuth();
  return {[beam, azimuth_step_rad](double offset_bins) { return beam.two_way_power(offset_bins * azimuth_step_rad); },
          azimuth_response(radar, azimuth_step_rad).weights.size() / 2};
}

}  // namespace sigmascape::receiver
