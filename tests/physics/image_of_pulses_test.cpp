#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "physics/even_window.h"
#include "physics/level_terrain.h"
#include "physics/transformed_pulses.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape {
namespace {

/// A pulse between its samples, of which it takes 1.25 to a cell: sinc under cos² over so many to either side.
std::complex<double> pulse_at(const radar::PhaseHistory& history, std::size_t pulse, double range_m) {
  constexpr double reach = 40.0;
  const double place = (range_m - history.first_range_m) / history.range_step_m;
  std::complex<double> sum;
  for (auto sample = static_cast<std::size_t>(std::max(0.0, place - reach));
       sample < history.samples.columns() && static_cast<double>(sample) < place + reach; ++sample) {
    const double off = static_cast<double>(sample) - place;
    const double sinc = off == 0.0 ? 1.0 : std::sin(pi * off) / (pi * off);
    const double taper = std::pow(std::cos(0.5 * pi * off / reach), 2.0);
    sum += std::complex<double>(history.samples(sample, pulse).vv) * (sinc * taper);
  }
  return sum;
}

double difference_between_samples(const radar::RangeDopplerImage& image, const radar::PhaseHistory& history) {
  return difference_from_transform(image, history, 4, [&](std::size_t row, std::size_t pulse) {
    return pulse_at(history, pulse, image.range_m.middle_of(static_cast<double>(row) + 0.5));
  });
}

/// Ground whose leaves the wind moves on one side, and a mover, over the round Earth: an image finds its scatterers by
/// itself, and so do pulses. What is left is 0.07 rad of what the line of sight turns, and a fiftieth of a cell of
/// range walk.
TEST(ImageOfPulses, is_of_the_same_ground_movers_and_leaves) {
  const auto terrain = level_terrain(1000.0);
  radar::Radar radar;
  radar.mode = radar::Mode::Spotlight;
  radar.frequency_hz = speed_of_light_mps / 0.03;
  radar.earth_refraction = 4.0 / 3.0;
  radar.position = radar::position_seeing({0.0, 0.0, 0.0}, pi, radians_from_deg(20.0), 8000.0, radar::earth_of(radar));
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.range_resolution_m = 5.0;
  radar.beam_width_rad = 0.05;
  radar.wind_mps = 12.0;
  radar.waveform.window = even_window;
  radar.waveform.pulse_repetition_hz = 1000.0;
  radar::Target mover;
  mover.track = radar::Track::straight({-40.0, 30.0, 2.0}, {3.0, 4.0, 0.0});
  mover.rcs_m2 = radar::Channels{300.0F, 300.0F, 0.0F, 300.0F};
  const std::vector<radar::Target> targets{mover};
  const simulate::CoherentScene scene{&terrain,
                                      [](Vec2d place, const radar::Aspect&) {
                                        const float sigma0 = 0.05F + (place.y > 0.0 ? 0.2F : 0.0F);
                                        return radar::Channels{sigma0, sigma0, 0.0F, sigma0};
                                      },
                                      targets, [](Vec2d place) { return place.x > 0.0; }};
  const radar::Rectangle area{-100.0, -100.0, 100.0, 100.0};
  const simulate::CoherentSettings settings{.interval_s = 0.032, .scatterer_spacing_m = 2.5, .seed = 9};
  const auto image = simulate::range_doppler_image(scene, radar, area, settings);
  const auto history = simulate::phase_history(scene, radar, area, settings);
  ASSERT_EQ(history.pulses.size(), 32U);
  validation::expect_close({"Doppler", "image of ground, leaves and a mover against its pulses, relative error power",
                            0.0, difference_between_samples(image, history), 2e-3, "1", "independent DFT, 4/3 Earth"});
  // Other leaves, or a mover elsewhere, would be seen.
  simulate::CoherentScene still = scene;
  still.windblown = {};
  EXPECT_GT(difference_between_samples(simulate::range_doppler_image(still, radar, area, settings), history), 0.02);
  still = scene;
  still.targets = {};
  EXPECT_GT(difference_between_samples(simulate::range_doppler_image(still, radar, area, settings), history), 0.02);
}

}  // namespace
}  // namespace sigmascape
