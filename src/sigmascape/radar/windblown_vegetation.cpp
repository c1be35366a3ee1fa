#include "sigmascape/radar/windblown_vegetation.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/hash.h"

namespace sigmascape::radar {
namespace {

constexpr double mps_of_a_mile_an_hour = 0.44704;

/// In (0, 1).
double unit_number(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11U) + 0.5) * 0x1p-53;
}

}  // namespace

WindblownVegetation::WindblownVegetation(double wind_mps, double frequency_hz) {
  const double wind_mph = std::max(1.0, wind_mps / mps_of_a_mile_an_hour);
  const double ratio = 489.8 * std::pow(wind_mph, -1.55) * std::pow(frequency_hz * 1e-9, -1.21);
  still_part_ = ratio / (ratio + 1.0);
  decay_s_per_m_ = 1.0 / (0.1048 * (std::log10(wind_mph) + 0.4147));
}

float WindblownVegetation::range_rate_mps(std::uint64_t bits) const {
  if (unit_number(hashed(bits, 1)) < still_part_) return 0.0F;
  const double speed_mps = -std::log(unit_number(hashed(bits, 2))) / decay_s_per_m_;
  return static_cast<float>((hashed(bits, 3) & 1U) != 0 ? speed_mps : -speed_mps);
}

}  // namespace sigmascape::radar
