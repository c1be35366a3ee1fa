#include "sigmascape/product/slant_projection.h"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <utility>

#include "sigmascape/base/units.h"

namespace sigmascape::product {
namespace {

/// Seen from 3 km in the south on a flight to the east. The voltage goes round once in five bins of Doppler and has the
/// power one everywhere, so that a cell's σ0 is the number of resolution cells in a square metre.
radar::RangeDopplerImage evenly_bright(double pulse_repetition_hz, std::size_t bins) {
  radar::RangeDopplerImage image;
  image.platform = {.position = {0.0, -3000.0, 0.0}, .velocity_mps = {100.0, 0.0, 0.0}};
  image.frequency_hz = speed_of_light_mps / 0.03;
  image.pulse_repetition_hz = pulse_repetition_hz;
  const double step_hz = pulse_repetition_hz / static_cast<double>(bins);
  image.doppler_hz = {-static_cast<double>(bins / 2) * step_hz, step_hz, bins};
  image.range_m = {2900.0, 2.0, 101};
  image.range_cell_m = 2.0;
  image.doppler_cell_hz = step_hz;
  image.amplitude_m = Array2D<radar::ComplexChannels>(bins, 101);
  for (std::size_t row = 0; row < 101; ++row) {
    for (std::size_t column = 0; column < bins; ++column)
      image.amplitude_m(column, row).vv =
          std::polar(1.0F, static_cast<float>(2.0 * pi * static_cast<double>(column) / 5.0));
  }
  return image;
}

/// Doppler times range grows by 2 v cos θ/(λ r) a square metre, θ the angle off broadside.
TEST(SlantProjection, DopplerHasNoEndsToFallOff) {
  const terrain::HeightField terrain{
      .west_m = -500.0, .north_m = 500.0, .spacing_m = 500.0, .height_m = Array2D<float>(3, 3, 0.0F)};
  const radar::GroundGrid grid{.west_m = -200.0, .north_m = 40.0, .cell_m = 2.0, .columns = 200, .rows = 40};
  // The map's Doppler spans 888 Hz: it goes round once, often, and in an image with fewer bins than have a say.
  for (const auto& [pulse_repetition_hz, bins] : {std::pair{800.0, 400UL}, {100.0, 50UL}, {100.0, 5UL}}) {
    const auto map = projected_to_ground(evenly_bright(pulse_repetition_hz, bins), terrain, grid);
    const double step_hz = pulse_repetition_hz / static_cast<double>(bins);
    for (std::size_t row = 0; row < grid.rows; ++row) {
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const Vec2d centre = grid.centre_of(column, row);
        const double north_m = centre.y + 3000.0, range_m = std::hypot(centre.x, north_m);
        const double hz_per_m = 2.0 * 100.0 / 0.03 * north_m / (range_m * range_m);
        ASSERT_NEAR(map.sigma0(column, row).vv * step_hz * 2.0 / hz_per_m, 1.0, 0.01)
            << bins << " bins, " << centre.x << ' ' << centre.y;
      }
    }
  }
}

TEST(SlantProjection, RangeHasEnds) {
  const terrain::HeightField terrain{
      .west_m = -500.0, .north_m = 500.0, .spacing_m = 500.0, .height_m = Array2D<float>(3, 3, 0.0F)};
  const auto map = projected_to_ground(evenly_bright(800.0, 400), terrain,
                                       {.west_m = -10.0, .north_m = 200.0, .cell_m = 10.0, .columns = 2, .rows = 40});
  EXPECT_TRUE(std::isnan(map.sigma0(0, 0).vv)) << "195 m north of the middle, beyond the last range";
  EXPECT_FALSE(std::isnan(map.sigma0(0, 19).vv));
  EXPECT_TRUE(std::isnan(map.sigma0(0, 39).vv));
}

}  // namespace
}  // namespace sigmascape::product
