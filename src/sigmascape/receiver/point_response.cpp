#include "sigmascape/receiver/point_response.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::receiver {
namespace {

constexpr std::size_t places = 128;
constexpr double left_out = 1e-3;

/// From the point to the middle of a tap's bin, the point in the middle of one of the places within its bin: of all
/// taps, the two in the middle are the nearest.
double offset_bins(std::size_t place, std::size_t tap, std::size_t taps) {
  const double within = (static_cast<double>(place) + 0.5) / static_cast<double>(places);
  const std::size_t last_before = taps / 2 - 1;
  return static_cast<double>(tap) - static_cast<double>(last_before) - within;
}

}  // namespace

PointResponse::PointResponse(std::size_t taps, const std::function<double(double)>& voltage) : taps_(taps) {
  for (std::size_t place = 0; place < places; ++place) {
    double power = 0.0;
    for (std::size_t tap = 0; tap < taps; ++tap) {
      const double v = voltage(offset_bins(place, tap, taps));
      power += v * v;
    }
    for (std::size_t tap = 0; tap < taps; ++tap) {
      const double v = voltage(offset_bins(place, tap, taps));
      powers_.push_back(static_cast<float>(v * v / power));
      amplitudes_.push_back(static_cast<float>(v / std::sqrt(power)));
    }
  }
}

PointResponse PointResponse::shared() {
  return {2, [](double offset) { return std::sqrt(std::max(0.0, 1.0 - std::abs(offset))); }};
}

PointResponse PointResponse::of(const std::function<double(double)>& voltage) {
  // The mean over places within a bin of the power that so many taps hold.
  const auto power_within = [&](std::size_t taps) {
    double sum = 0.0;
    for (std::size_t place = 0; place < places; ++place) {
      for (std::size_t tap = 0; tap < taps; ++tap) sum += std::pow(voltage(offset_bins(place, tap, taps)), 2.0);
    }
    return sum;
  };
  const double all = power_within(16 * most_taps);
  std::size_t taps = 2;
  while (taps < most_taps && power_within(taps) < (1.0 - left_out) * all) taps += 2;
  return {taps, voltage};
}

PointResponse::Place PointResponse::place_of(double position) const {
  // Rounded down by way of integers, which are positive from the first bin that matters on.
  constexpr std::ptrdiff_t below = 1 << 20;
  const double above = position - 0.5 + static_cast<double>(below);
  const auto lower = static_cast<std::ptrdiff_t>(above);
  const double within = above - static_cast<double>(lower);
  return {lower - below - static_cast<std::ptrdiff_t>(taps_ / 2) + 1,
          std::min(places - 1, static_cast<std::size_t>(within * static_cast<double>(places)))};
}

}  // namespace sigmascape::receiver
