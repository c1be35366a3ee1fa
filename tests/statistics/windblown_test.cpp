#include "sigmascape/simulate/windblown.h"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "validation/validation_record.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/windblown_vegetation.h"
#include "sigmascape/receiver/pulse_receiver.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape {
namespace {

constexpr std::string_view windblown_group = "Wind in leaves";

/// At X band and in a breeze of 10 miles an hour: r = 489.8 · 10^−1.55 · 10^−1.21 = 0.8512, β = 1/(0.1048 · 1.4147).
TEST(WindblownVegetation, has_the_published_constants) {
  const radar::WindblownVegetation leaves(10.0 * 0.44704, 10e9);
  validation::expect_close({windblown_group, "still part at 10 GHz, 10 miles an hour", 0.8512 / 1.8512,
                            leaves.still_part(), 1e-3, "1", "Billingsley 1996, by hand"});
  validation::expect_close({windblown_group, "decay at 10 miles an hour", 6.745, leaves.decay_s_per_m(), 0.005, "s/m",
                            "Billingsley 1996, by hand"});
  // More wind and higher frequency leave less at rest, and wind alone makes it faster.
  EXPECT_LT(radar::WindblownVegetation(10.0, 10e9).still_part(), leaves.still_part());
  EXPECT_LT(radar::WindblownVegetation(10.0, 10e9).decay_s_per_m(), leaves.decay_s_per_m());
  EXPECT_GT(radar::WindblownVegetation(4.4704, 1e9).still_part(), 0.9);
  EXPECT_EQ(radar::WindblownVegetation(4.4704, 1e9).decay_s_per_m(), leaves.decay_s_per_m());
  EXPECT_TRUE(std::isfinite(radar::WindblownVegetation(0.0, 10e9).decay_s_per_m()));
}

/// The spectrum of many pulses of a cell of leaves, seen by a radar at rest, is a line at zero and two exponential
/// slopes.
TEST(WindblownVegetation, spectrum_of_pulses_is_exponential) {
  radar::Radar radar;
  radar.frequency_hz = 10e9;
  radar.range_resolution_m = 10.0;
  const double wind_mps = 6.0, wavelength = wavelength_m(radar.frequency_hz);
  const radar::WindblownVegetation leaves(wind_mps, radar.frequency_hz);
  constexpr std::size_t cells = 40, leaves_a_cell = 400, pulses = 256;
  constexpr double repetition_hz = 400.0;
  // Powers by velocity, out to where the slope has fallen by 30 dB.
  std::vector<double> power(pulses, 0.0);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    std::vector<radar::Scatterer> scatterers;
    for (std::size_t i = 0; i < leaves_a_cell; ++i) {
      const std::uint64_t key = hashed(cell, i);
      const auto phase = static_cast<double>(unit_float(hashed(key, 7))) * 2.0 * pi;
      scatterers.push_back({.position = {0.0, 1000.0 + static_cast<double>(unit_float(hashed(key, 8))), 0.0},
                            .amplitude_m = {.vv = std::polar(1.0F, static_cast<float>(phase)), .hh = {}, .hv = {}},
                            .range_rate_mps = leaves.range_rate_mps(key)});
    }
    const receiver::PulseReceiver receiver(radar, {990.0, 1011.0, 2.0});
    const auto history =
        receiver.receive(radar::Track(), {.count = pulses, .repetition_hz = repetition_hz}, scatterers, {});
    const auto middle = static_cast<std::size_t>((1000.5 - history.first_range_m) / history.range_step_m);
    for (std::size_t k = 0; k < pulses; ++k) {
      std::complex<double> sum;
      for (std::size_t n = 0; n < pulses; ++n) {
        // Hann, so that the line at zero does not leak into the slopes.
        const double weight = 1.0 - std::cos(2.0 * pi * (static_cast<double>(n) + 0.5) / pulses);
        sum += std::complex<double>(history.samples(middle, n).vv) *
               std::polar(weight, -2.0 * pi * static_cast<double>(k * n % pulses) / pulses);
      }
      power[k] += std::norm(sum);
    }
  }
  const auto velocity_of = [&](std::size_t k) {
    const double bin = k < pulses / 2 ? static_cast<double>(k) : static_cast<double>(k) - pulses;
    return -0.5 * wavelength * bin * repetition_hz / pulses;
  };
  double all = 0.0, line = 0.0, near = 0.0, far = 0.0, left = 0.0, right = 0.0;
  const double step = 0.5 * wavelength * repetition_hz / pulses;
  for (std::size_t k = 0; k < pulses; ++k) {
    const double v = velocity_of(k), size = std::abs(v);
    all += power[k];
    if (size < 2.5 * step) line += power[k];
    if (size > 4.5 * step && size < 14.5 * step) near += power[k];
    if (size > 14.5 * step && size < 24.5 * step) far += power[k];
    if (v > 4.0 * step && v < 1.0) right += power[k];
    if (v < -4.0 * step && v > -1.0) left += power[k];
  }
  // Within the line's own width lies a part of the slopes.
  const double beta = leaves.decay_s_per_m(), slopes = 1.0 - std::exp(-2.5 * beta * step);
  validation::expect_close({windblown_group, "part of the power in the line at zero",
                            leaves.still_part() + (1.0 - leaves.still_part()) * slopes, line / all, 0.05, "1",
                            "r/(r + 1)"});
  validation::expect_close({windblown_group, "fall of the slopes over 0.23 m/s",
                            db_from_linear(std::exp(-10.0 * step * beta)), db_from_linear(far / near), 0.5, "dB",
                            "exp(−β |v|)"});
  EXPECT_NEAR(db_from_linear(left / right), 0.0, 1.0);
}

TEST(Windblown, is_what_stands_for_plants) {
  for (const char* const plant : {"grass", "crops", "ulaby_dobson_trees_unverified", "billingsley_forest", "farmland"})
    EXPECT_TRUE(scatter::library_material(plant).plants) << plant;
  for (const char* const other : {"forest_floor", "asphalt", "concrete", "water", "bare_soil"})
    EXPECT_FALSE(scatter::library_material(other).plants) << other;
}

/// In an image with Doppler, leaves smear along the flight what stands still is sharp in.
TEST(Windblown, smears_leaves_and_leaves_stones) {
  const terrain::HeightField terrain{
      .west_m = -1000.0, .north_m = 1000.0, .spacing_m = 50.0, .height_m = Array2D<float>(41, 41, 0.0F)};
  radar::Radar radar;
  radar.position = radar::position_seeing({0.0, 0.0, 0.0}, pi, radians_from_deg(20.0), 8000.0);
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.range_resolution_m = 2.0;
  radar.waveform.pulse_repetition_hz = 2000.0;
  radar.wind_mps = 8.0;
  // A strip of ground 4 m wide along the line of sight.
  const render::Reflectivity strip = [](Vec2d place, const radar::Aspect&) {
    const float sigma0 = std::abs(place.x) < 2.0 ? 1.0F : 0.0F;
    return radar::Channels{sigma0, sigma0, 0.0F, sigma0};
  };
  const auto part_in_place = [&](bool plants) {
    const simulate::CoherentScene scene{&terrain, strip, {}, [plants](Vec2d) { return plants; }};
    const auto image = simulate::range_doppler_image(scene, radar, {-100.0, -100.0, 100.0, 100.0}, {.interval_s = 0.6});
    double within = 0.0, all = 0.0;
    for (std::size_t row = 0; row < image.range_m.bins; ++row) {
      for (std::size_t column = 0; column < image.doppler_hz.bins; ++column) {
        const double power = std::norm(image.amplitude_m(column, row).vv);
        const double east_m =
            image.doppler_hz.middle_of(static_cast<double>(column) + 0.5) * wavelength_m(10e9) / 200.0 * 8000.0;
        all += power;
        if (std::abs(east_m) < 6.0) within += power;
      }
    }
    return within / all;
  };
  EXPECT_GT(part_in_place(false), 0.95);
  const double still = radar::WindblownVegetation(8.0, 10e9).still_part();
  // ±6 m are ±0.075 m/s, in which a part of the slopes lies too.
  const double slopes = 1.0 - std::exp(-0.06 * radar::WindblownVegetation(8.0, 10e9).decay_s_per_m());
  EXPECT_NEAR(part_in_place(true), still + (1.0 - still) * slopes, 0.08);
}

}  // namespace
}  // namespace sigmascape
