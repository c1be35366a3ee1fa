#include "sigmascape/simulate/doppler_rim.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::simulate {
namespace {

/// 10 km away or so, 400 m a side, seen from a flight to the north; the rim is 150 m wide.
constexpr radar::Rectangle mapped{9800.0, -200.0, 10200.0, 200.0};
constexpr radar::Rectangle mapped_with_rim = radar::widened(mapped, 150.0);

radar::Radar flying_north(double repetition_hz) {
  radar::Radar radar;
  radar.position = {0.0, 0.0, 2000.0};
  radar.velocity_mps = {0.0, 150.0, 0.0};
  radar.frequency_hz = speed_of_light_mps / 0.03;
  radar.waveform.pulse_repetition_hz = repetition_hz;
  return radar;
}

double frequency_hz(const radar::Radar& radar, Vec3d place) {
  return radar::doppler_hz(radar::range_rate_mps({radar.position, radar.velocity_mps}, {place}), 0.03);
}

constexpr double step_m = 0.05;

/// Of one range, place after place across it.
std::vector<Vec3d> arc_through(const radar::Rectangle& all, double ground_range_m) {
  std::vector<Vec3d> arc;
  for (double y = all.south_m; y <= all.north_m; y += step_m) {
    const Vec3d place{std::sqrt(ground_range_m * ground_range_m - y * y), y, 0.0};
    if (all.contains({place.x, place.y})) arc.push_back(place);
  }
  return arc;
}

/// The map spans some 392 Hz, with its rim 680 Hz.
TEST(DopplerRim, FillsEveryDopplerOfARangeOnce) {
  for (const double repetition_hz : {400.0, 500.0, 650.0}) {
    const radar::Radar radar = flying_north(repetition_hz);
    const DopplerRim rim(radar, mapped, mapped_with_rim);
    for (const double ground_range_m : {9700.0, 9900.0, 10000.0, 10150.0, 10300.0}) {
      constexpr std::size_t bins = 40;
      std::vector<double> filled(bins);
      for (const Vec3d place : arc_through(mapped_with_rim, ground_range_m)) {
        if (!rim.takes_part(place)) continue;
        const double folded = radar::folded_hz(frequency_hz(radar, place), 0.0, repetition_hz);
        filled[std::min(bins - 1, static_cast<std::size_t>(folded / repetition_hz * bins))] += step_m;
      }
      const double metre_hz = 2.0 * 150.0 / (0.03 * std::hypot(ground_range_m, 2000.0));
      const double once = repetition_hz / bins / metre_hz;
      for (const double metres : filled)
        EXPECT_NEAR(metres, once, 4.0 * step_m) << repetition_hz << " Hz, " << ground_range_m;
    }
  }
}

TEST(DopplerRim, IsWholeWhereNothingFoldsAndTheMapIsAlways) {
  for (const double repetition_hz : {50.0, 300.0, 700.0}) {
    const DopplerRim rim(flying_north(repetition_hz), mapped, mapped_with_rim);
    for (const Vec3d place : arc_through(mapped, 10000.0)) EXPECT_TRUE(rim.takes_part(place));
    const bool folds = repetition_hz < 680.0;
    for (const double beside : {-340.0, 340.0}) EXPECT_EQ(rim.takes_part({10000.0, beside, 0.0}), !folds);
  }
}

/// Ahead, left and right have the same Doppler.
TEST(DopplerRim, EndsOnTheCourse) {
  constexpr radar::Rectangle right{20.0, 9800.0, 220.0, 10000.0}, both{-20.0, 9800.0, 220.0, 10000.0};
  const radar::Radar radar = flying_north(5000.0);
  const DopplerRim of_right(radar, right, radar::widened(right, 100.0)),
      of_both(radar, both, radar::widened(both, 100.0));
  EXPECT_TRUE(of_right.takes_part({10.0, 9900.0, 0.0}));
  EXPECT_TRUE(of_right.takes_part({100.0, 9750.0, 0.0}));
  EXPECT_FALSE(of_right.takes_part({-10.0, 9900.0, 0.0}));
  EXPECT_TRUE(of_both.takes_part({-100.0, 9900.0, 0.0}));
}

}  // namespace
}  // namespace sigmascape::simulate
