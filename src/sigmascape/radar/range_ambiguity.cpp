#include "sigmascape/radar/range_ambiguity.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {

double unambiguous_range_m(double pulse_repetition_hz) {
  return speed_of_light_mps / (2.0 * pulse_repetition_hz);
}

int times_around(double range_m, double first_range_m, double pulse_repetition_hz) {
  return static_cast<int>(std::floor((range_m - first_range_m) / unambiguous_range_m(pulse_repetition_hz)));
}

double apparent_range_m(double range_m, double first_range_m, double pulse_repetition_hz) {
  return range_m - times_around(range_m, first_range_m, pulse_repetition_hz) * unambiguous_range_m(pulse_repetition_hz);
}

double folded_near_m(double range_m, double about_m, double pulse_repetition_hz) {
  return about_m + std::remainder(range_m - about_m, unambiguous_range_m(pulse_repetition_hz));
}

double longest_pulse_s(double pulse_repetition_hz) {
  return 0.5 / pulse_repetition_hz;
}

double uneclipsed_part(double range_m, double pulse_length_s, double pulse_repetition_hz) {
  const double interval_s = 1.0 / pulse_repetition_hz;
  const double delay_s = 2.0 * range_m / speed_of_light_mps;
  // Since the last pulse began to leave, and until the next one does.
  const double since_s = delay_s - interval_s * std::floor(delay_s / interval_s);
  const double until_s = interval_s - since_s;
  const double lost_s = std::max(0.0, pulse_length_s - since_s) + std::max(0.0, pulse_length_s - until_s);
  return std::clamp(1.0 - lost_s / pulse_length_s, 0.0, 1.0);
}

}  // namespace sigmascape::radar
