#include "sigmascape/receiver/doppler_imager.h"

#include <cmath>
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

}  // namespace
}  // namespace sigmascape::receiver
