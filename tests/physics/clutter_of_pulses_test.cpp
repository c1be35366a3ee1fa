#include <cmath>
#include <complex>
#include <cstdint>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "level_ground_watts.h"
#include "physics/even_window.h"
#include "physics/level_terrain.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape {
namespace {

constexpr double height_m = 500.0;

/// High above level ground, whose beam to the north stands still. Its noise is far below what the ground returns.
radar::Radar standing_radar(double half_power_width_rad) {
  radar::Radar radar;
  radar.frequency_hz = speed_of_light_mps / 0.03;
  radar.position = {0.0, -2000.0, height_m};
  radar.range_resolution_m = 5.0;
  radar.beam_width_rad = half_power_width_rad;
  radar.antenna.gain = 1000.0;
  radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = 0.0};
  radar.waveform.peak_power_w = 1e6;
  radar.waveform.window = even_window;
  radar.waveform.pulse_repetition_hz = 1000.0;
  return radar;
}

/// Even ground in pulses has the watts that it has in maps and in live frames, whatever the width of the beam: over
/// level ground these, too, are held against the radar equation.
TEST(ClutterOfPulses, has_the_watts_of_the_radar_equation) {
  constexpr double gamma = 0.1;
  const auto terrain = level_terrain(1000.0);
  const simulate::CoherentScene scene{&terrain, [](Vec2d, const radar::Aspect& aspect) {
                                        const auto sigma0 = static_cast<float>(gamma * std::sin(aspect.elevation_rad));
                                        return radar::Channels{sigma0, sigma0, 0.0F, sigma0};
                                      }};
  const radar::Rectangle area{-400.0, -200.0, 400.0, 200.0};
  // Away from the ends of the area by many cells, whose sidelobes are of ground that is not there.
  const double first_m = std::hypot(1900.0, height_m), last_m = std::hypot(2100.0, height_m);
  for (const double width_deg : {1.0, 4.0}) {
    const auto radar = standing_radar(radians_from_deg(width_deg));
    double heard_w = 0.0, expected_w = 0.0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const auto pulses =
          simulate::phase_history(scene, radar, area, {.interval_s = 0.002, .seed = seed, .calibrated = true});
      ASSERT_EQ(pulses.unit, "V");
      for (std::size_t sample = 0; sample < pulses.samples.columns(); ++sample) {
        const double range_m = pulses.first_range_m + pulses.range_step_m * static_cast<double>(sample);
        if (range_m < first_m || range_m > last_m) continue;
        heard_w += static_cast<double>(std::norm(pulses.samples(sample, 0).vv)) /
                   (radar.receiver.impedance_ohm * radar.receiver.gain);
        expected_w += level_ground_w(radar, range_m, gamma * height_m / range_m);
      }
    }
    validation::expect_close(
        {"Radar equation", fmt::format("clutter of pulses under a beam of {:g}° half-power width", width_deg), 0.0,
         db_from_linear(heard_w / expected_w), 0.2, "dB", "radar equation over level ground of constant gamma"});
  }
}

}  // namespace
}  // namespace sigmascape
