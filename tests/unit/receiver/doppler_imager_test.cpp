#include "sigmascape/receiver/doppler_imager.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

constexpr Vec3d place{0.0, 8000.0, 0.0};

/// Flies east past a place, a hundred pulses a second.
DopplerImager imager_of(std::size_t pulses, radar::WindowShape shape) {
  radar::Radar radar;
  radar.position = {0.0, 0.0, 2000.0};
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.waveform.window.shape = shape;
  return {radar,
          radar::Track::straight(radar.position, radar.velocity_mps),
          {.pulses = pulses, .repetition_hz = 100.0, .window = radar.waveform.window, .oversampling = 3.0},
          {8200.0, 8300.0, 2.0},
          place};
}

/// A cell is as wide as a lone point's power over its peak, ∫|h|², whatever the pulses: with one of them Doppler tells
/// nothing apart, and the cell is the repetition frequency.
TEST(DopplerImager, HasCellsOfTheWeightsThatALookHas) {
  for (const auto shape : {radar::WindowShape::Taylor, radar::WindowShape::Hamming, radar::WindowShape::Rectangular}) {
    for (const std::size_t looks : {1U, 4U}) {
      for (const std::size_t pulses_a_look : {1U, 2U, 3U, 4U, 8U, 32U}) {
        if (looks * pulses_a_look < 2) continue;
        DopplerImager imager = imager_of(looks * pulses_a_look, shape);
        const std::vector<radar::Scatterer> ground{{place, {{1.0F, 0.0F}, {}, {}}}};
        imager.add(ground);
        const radar::RangeDopplerImage image = imager.image({0, looks});
        // In the range of the brightest bin: Doppler has its peak in a bin, for the place is in the middle.
        std::size_t brightest = 0;
        const std::size_t middle = image.doppler_hz.bins / 2;
        const auto power = [&](std::size_t column, std::size_t row) {
          return static_cast<double>(std::norm(image.amplitude_m(column, row).vv));
        };
        for (std::size_t row = 0; row < image.range_m.bins; ++row) {
          if (power(middle, row) > power(middle, brightest)) brightest = row;
        }
        double sum = 0.0;
        for (std::size_t column = 0; column < image.doppler_hz.bins; ++column) sum += power(column, brightest);
        const double width_hz = sum * image.doppler_hz.step / power(middle, brightest);
        EXPECT_NEAR(image.doppler_cell_hz / width_hz, 1.0, 2e-3) << pulses_a_look << " pulses, " << looks << " looks";
        EXPECT_LE(image.doppler_cell_hz, 100.0 + 1e-9) << "what pulses know of Doppler";
      }
    }
  }
}

/// The radar's own platform is no target of its images, whatever list it stands in.
TEST(DopplerImager, HasNothingOfItsOwnPlatform) {
  DopplerImager imager = imager_of(32, radar::WindowShape::Taylor);
  std::vector<radar::Target> own(1);
  own[0].track = radar::Track::straight({0.0, 0.0, 2000.0}, {100.0, 0.0, 0.0});
  own[0].rcs_m2 = radar::Channels{10.0F, 10.0F, 0.0F, 10.0F};
  imager.add(own);
  for (const auto& bin : imager.image({0, 1}).amplitude_m.values()) ASSERT_EQ(std::abs(bin.vv), 0.0F);
}

/// A mover at the blind speed is shown at its own place, among the ground there, and is in focus as its pulses are when
/// they are held against those of that ground.
TEST(DopplerImager, AMoverThatFoldsIsAsSharpAsItsPulsesSay) {
  constexpr double wavelength = 0.03, repetition_hz = 1000.0;
  constexpr std::size_t pulses = 500;
  radar::Radar radar;
  radar.frequency_hz = speed_of_light_mps / wavelength;
  radar.range_resolution_m = 15.0;
  radar.position = {0.0, 0.0, 2000.0};
  radar.velocity_mps = {250.0, 0.0, 0.0};
  radar.waveform.window.shape = radar::WindowShape::Rectangular;
  const Vec3d ahead{6000.0, 6000.0, 0.0}, away = ahead - radar.position;
  const double range_m = length(away);
  radar::Target mover;
  mover.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
  // Along the ground towards the radar, at λ f_p/2 along the line of sight.
  const Vec2d ground = Vec2d{away.x, away.y} * (1.0 / std::hypot(away.x, away.y));
  const double speed_mps = 0.5 * wavelength * repetition_hz * range_m / std::hypot(away.x, away.y);
  mover.track = radar::Track::straight(ahead, {-ground.x * speed_mps, -ground.y * speed_mps, 0.0});
  radar::Target still = mover;
  still.track = radar::Track::straight(ahead);
  const auto brightest = [&](const radar::Target& target) {
    DopplerImager imager(
        radar, radar::Track::straight(radar.position, radar.velocity_mps),
        {.pulses = pulses, .repetition_hz = repetition_hz, .window = radar.waveform.window, .oversampling = 3.0},
        {range_m - 60.0, range_m + 60.0, 2.0}, ahead);
    imager.add(std::vector<radar::Target>{target});
    const radar::RangeDopplerImage image = imager.image();
    double most = 0.0;
    for (const auto& bin : image.amplitude_m.values()) most = std::max(most, static_cast<double>(std::norm(bin.vv)));
    return most;
  };
  std::complex<double> sum;
  for (std::size_t pulse = 0; pulse < pulses; ++pulse) {
    const double time_s = (static_cast<double>(pulse) - 0.5 * (pulses - 1.0)) / repetition_hz;
    const Vec3d platform = radar.position + radar.velocity_mps * time_s;
    const double further_m = length(mover.track.position_at(time_s) - platform) - length(ahead - platform);
    sum += std::polar(1.0 / pulses, -4.0 * pi * further_m / wavelength);
  }
  const double expected_db = db_from_linear(std::norm(sum));
  EXPECT_GT(expected_db, -0.2);
  EXPECT_NEAR(db_from_linear(brightest(mover) / brightest(still)), expected_db, 0.1);
}

}  // namespace
}  // namespace sigmascape::receiver
