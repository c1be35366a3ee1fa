#include "sigmascape/receiver/range_gate.h"

#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/radar/range_response.h"

namespace sigmascape::receiver {
namespace {

/// Resolutions beyond each end of the gate whose side lobes still reach into it.
constexpr std::size_t guard_cells = 64;
constexpr double most_cells = 1e7;

/// An odd number of frequencies, so that the response is real.
std::size_t odd(double at_least) {
  const auto count = static_cast<std::size_t>(std::ceil(at_least));
  return count + 1 - count % 2;
}

/// What is wrong with a gate that ends before it begins. The radar file may have set one end, and what is mapped the
/// other: then the file's key is named, and slant ranges as it states them.
Error empty_gate(const radar::Radar& radar, const RangeGate& gate) {
  const auto of_file = [&](const char* key) { return fmt::format("{}: receiver.{}", radar::title_of(radar), key); };
  const double first_km = gate.first_range_m / gate.over_slant / 1e3,
               last_km = gate.last_range_m / gate.over_slant / 1e3;
  const auto is_stated = [&](const std::optional<double>& slant_m, double range_m) {
    return slant_m && *slant_m * gate.over_slant == range_m;
  };
  if (is_stated(radar.receiver.first_range_m, gate.first_range_m)) {
    return Error(
        of_file("first_range_km"),
        fmt::format("opens the range gate at {:.6g} km, and what is mapped ends at {:.6g} km", first_km, last_km),
        "open it nearer, or map what lies farther away");
  }
  if (is_stated(radar.receiver.last_range_m, gate.last_range_m)) {
    return Error(
        of_file("last_range_km"),
        fmt::format("closes the range gate at {:.6g} km, and what is mapped begins at {:.6g} km", last_km, first_km),
        "close it farther away, or map what lies nearer");
  }
  return Error("range gate", fmt::format("goes from {:g} m to {:g} m", gate.first_range_m, gate.last_range_m),
               "let it end beyond where it begins");
}

}  // namespace

GatedAxis guarded_axis(double first_m, double last_m, double cell_m, double oversampling, const radar::Window& window) {
  const std::size_t band = odd((last_m - first_m) / cell_m + 2.0 * guard_cells);
  const auto bins = fast_length(static_cast<std::size_t>(std::ceil(static_cast<double>(band) * oversampling)));
  const double period_m = static_cast<double>(band) * cell_m;
  const double step_m = period_m / static_cast<double>(bins);
  const auto guard = static_cast<std::size_t>(std::ceil(guard_cells * cell_m / step_m));
  return {.axis = {.bins = bins, .band = band, .window = window},
          .period_m = period_m,
          .step_m = step_m,
          .start_m = first_m - static_cast<double>(guard) * step_m,
          .guard = guard,
          .samples = static_cast<std::size_t>(std::floor((last_m - first_m) / step_m)) + 1,
          .bandwidth_hz = 0.0};
}

GatedAxis gated_axis(const radar::Radar& radar, const RangeGate& gate) {
  if (!(gate.last_range_m > gate.first_range_m) || !(gate.first_range_m >= 0.0)) throw empty_gate(radar, gate);
  if (!(gate.oversampling >= 1.0)) {
    throw Error("range gate", fmt::format("has {} samples a resolution", gate.oversampling),
                "give at least 1: fewer would lose part of the band");
  }
  const double bandwidth_hz = radar::bandwidth_of(radar.range_resolution_m, radar.waveform.window);
  const double resolution_m = speed_of_light_mps / (2.0 * bandwidth_hz);
  const double cells = (gate.last_range_m - gate.first_range_m) / resolution_m;
  if (!(cells < most_cells)) {
    throw Error("range gate", fmt::format("holds {:.0f} resolution cells", cells),
                "make it shorter or the cells larger");
  }
  GatedAxis axis =
      guarded_axis(gate.first_range_m, gate.last_range_m, resolution_m, gate.oversampling, radar.waveform.window);
  axis.bandwidth_hz = bandwidth_hz;
  return axis;
}

}  // namespace sigmascape::receiver
