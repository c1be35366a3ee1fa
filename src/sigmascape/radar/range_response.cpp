#include "sigmascape/radar/range_response.h"

namespace sigmascape::radar {

double bandwidth_of(double range_resolution_m, const Window& window) {
  return WindowResponse(window).half_power_width() * speed_of_light_mps / (2.0 * range_resolution_m);
}

double range_resolution_of(double bandwidth_hz, const Window& window) {
  return WindowResponse(window).half_power_width() * speed_of_light_mps / (2.0 * bandwidth_hz);
}

RangeResponse RangeResponse::of_width(double half_power_width_m, const Window& window) {
  return {bandwidth_of(half_power_width_m, window), window};
}

}  // namespace sigmascape::radar
