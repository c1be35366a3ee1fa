#include "sigmascape/receiver/equivalent_noise.h"

#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/radar_equation.h"

namespace sigmascape::receiver {

double EquivalentNoise::rcs_m2(double range_m, double pulses, double noise_bandwidth) const {
  return noise_bandwidth / (radar::signal_to_noise(radar_, 1.0, range_m) * pulses);
}

}  // namespace sigmascape::receiver
