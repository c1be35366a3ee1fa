#include "sigmascape/simulate/scatterer_spacing.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "unit/simulate/level_ground.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/coherent_plan.h"
#include "sigmascape/radar/window_response.h"

namespace sigmascape::simulate {
namespace {

/// Looks north from 8 km to the south with cells of 15 m, and flies east.
radar::Radar coarse_in_range(radar::Mode mode = radar::Mode::RealBeam) {
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(20.0), 8000.0);
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.range_resolution_m = 15.0;
  radar.beam_width_rad = radians_from_deg(2.0);
  radar.mode = mode;
  return radar;
}

double of_pulses_m(const radar::Radar& radar, double interval_s) {
  return pulse_scatterer_spacing_m(radar, small_area, level_ground, interval_s);
}

/// The next rung of the ladder.
void expect_rung_below(double spacing_m, double most_m) {
  EXPECT_LE(spacing_m, most_m * (1.0 + 1e-6));
  EXPECT_GT(spacing_m, most_m * std::exp2(-1.0 / 8.0));
}

TEST(ScattererSpacing, IsHalfOfWhatIsToldApartAtTheFinest) {
  const radar::Radar radar = coarse_in_range();
  expect_rung_below(scatterer_spacing_m(radar, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(scatterer_spacing_m(radar, 3.75), 1.875);
  EXPECT_DOUBLE_EQ(scatterer_spacing_m(radar, 3.75 * (1.0 - 1e-12)), 1.875);
  EXPECT_DOUBLE_EQ(scatterer_spacing_m(radar, 15.0), 7.5);
  EXPECT_DOUBLE_EQ(scatterer_spacing_m(radar, 40.0), 7.5);
}

/// w λ r/2 v T, and never less than all sides give.
TEST(ScattererSpacing, OfPulsesIsThatOfTheirInterval) {
  const radar::Radar radar = coarse_in_range();
  const double width = radar::WindowResponse(radar.waveform.window).half_power_width();
  const double wavelength = wavelength_m(radar.frequency_hz);
  expect_rung_below(of_pulses_m(radar, 1.0), 0.5 * width * wavelength * 8000.0 / 200.0);
  EXPECT_DOUBLE_EQ(of_pulses_m(radar, 0.01), 7.5);
  expect_rung_below(of_pulses_m(radar, 5000.0), 0.5 * width * wavelength / 4.0);
}

/// 60 m farther on and half a metre beside, broadside and ahead of it.
TEST(ScattererSpacing, OfPulsesIsTheSameFromALittleFartherOn) {
  for (const double behind_m : {0.0, 2500.0}) {
    radar::Radar radar = coarse_in_range();
    radar.position.x -= behind_m;
    const double here_m = of_pulses_m(radar, 0.5);
    ASSERT_LT(here_m, 7.5);
    for (const Vec3d apart : {Vec3d{60.0, 0.0, 0.0}, {0.5, 0.0, 0.0}}) {
      radar::Radar other = radar;
      other.position = radar.position + apart;
      EXPECT_EQ(of_pulses_m(other, 0.5), here_m) << behind_m << " " << apart.x;
    }
  }
}

TEST(ScattererSpacing, OfPulsesIsThatOfTheMapTheyBelongTo) {
  for (const radar::Mode mode : {radar::Mode::Spotlight, radar::Mode::DopplerBeamSharpening, radar::Mode::Stripmap}) {
    radar::Radar radar = coarse_in_range(mode);
    if (mode != radar::Mode::DopplerBeamSharpening) radar.processing.along_resolution_m = 3.0;
    radar.processing.looks = 2;
    const radar::CoherentPlan plan = radar::coherent_plan(radar, {});
    const double of_map_m = scatterer_spacing_m(radar, plan.along_resolution_m / plan.looks);
    EXPECT_LT(of_map_m, 7.5);
    for (const double interval_s : {0.01, plan.interval_s, 1.01 * plan.interval_s})
      EXPECT_EQ(of_pulses_m(radar, interval_s), of_map_m) << interval_s << " s";
    const double longer_m = of_pulses_m(radar, 2.0 * plan.interval_s);
    EXPECT_NEAR(longer_m, mode == radar::Mode::Stripmap ? of_map_m : of_map_m / 2.0, 1e-9);
  }
}

/// A mode that maps nothing, motion that tells nothing apart, intervals that are none.
TEST(ScattererSpacing, OfPulsesIsThatOfRangeElse) {
  radar::Radar radar = coarse_in_range(radar::Mode::Spotlight);
  radar.velocity_mps = {0.0, 100.0, 0.0};
  EXPECT_DOUBLE_EQ(of_pulses_m(radar, 1.0), 7.5);
  radar.velocity_mps = {};
  EXPECT_DOUBLE_EQ(of_pulses_m(radar, 1.0), 7.5);
  for (const double interval_s : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_DOUBLE_EQ(of_pulses_m(coarse_in_range(), interval_s), 7.5);
}

}  // namespace
}  // namespace sigmascape::simulate
