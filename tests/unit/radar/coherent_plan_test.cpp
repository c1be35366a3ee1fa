#include "sigmascape/radar/coherent_plan.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

using ::testing::HasSubstr;

/// Flies north at 200 m/s with a 2° beam at a wavelength of 3 cm; a rectangular window, 0.8859 cells wide.
Radar flying_north(Mode mode) {
  Radar radar;
  radar.frequency_hz = speed_of_light_mps / 0.03;
  radar.velocity_mps = {0.0, 200.0, 0.0};
  radar.beam_width_rad = radians_from_deg(2.0);
  radar.waveform.window.shape = WindowShape::Rectangular;
  radar.mode = mode;
  return radar;
}

/// A place 10 km away, so far off the nose to the right.
Vec3d place_at(double squint_deg) {
  const double squint = radians_from_deg(squint_deg);
  return {10e3 * std::sin(squint), 10e3 * std::cos(squint), 0.0};
}

constexpr double cells = 0.8859;

TEST(CoherentPlan, IntervalsGiveTheWantedResolution) {
  Radar radar = flying_north(Mode::DopplerBeamSharpening);
  radar.processing.sharpening = 20.0;
  radar.processing.looks = 4;
  const auto sharpened = coherent_plan(radar, place_at(30.0));
  EXPECT_NEAR(sharpened.interval_s, cells * 4.0 * 0.03 / (2.0 * 200.0 * radians_from_deg(2.0) / 20.0 * 0.5), 3e-4);
  EXPECT_NEAR(sharpened.along_resolution_m, 10e3 * radians_from_deg(2.0) / 20.0, 1e-9);
  EXPECT_NEAR(sharpened.squint_rad, radians_from_deg(30.0), 1e-12);

  radar = flying_north(Mode::Spotlight);
  radar.range_resolution_m = 1.5;
  EXPECT_NEAR(coherent_plan(radar, place_at(90.0)).interval_s, cells * 0.03 * 10e3 / (2.0 * 200.0 * 1.5), 1e-4);
  radar.processing.interval_s = 1.0;
  EXPECT_NEAR(coherent_plan(radar, place_at(90.0)).along_resolution_m, cells * 0.03 * 10e3 / (2.0 * 200.0), 1e-3);
}

TEST(CoherentPlan, AStripIsNoSharperThanItsBeam) {
  Radar radar = flying_north(Mode::Stripmap);
  radar.range_resolution_m = 0.1;
  const double finest_m = cells * 0.03 / (4.0 * std::sin(radians_from_deg(1.0)));
  EXPECT_NEAR(coherent_plan(radar, place_at(90.0)).along_resolution_m, finest_m, 1e-4);
  radar.range_resolution_m = 3.0;
  EXPECT_EQ(coherent_plan(radar, place_at(90.0)).along_resolution_m, 3.0);
  radar.processing.along_resolution_m = 0.3;
  const auto plan = [&] { static_cast<void>(coherent_plan(radar, place_at(90.0))); };
  EXPECT_THAT(message_of_error(plan), HasSubstr("give mode.along_resolution_m of at least 0.381"));
}

TEST(CoherentPlan, WhereDopplerTellsNothingIsSaid) {
  Radar radar = flying_north(Mode::DopplerBeamSharpening);
  const auto ahead = [&] { static_cast<void>(coherent_plan(radar, place_at(0.5))); };
  EXPECT_THAT(message_of_error(ahead), HasSubstr("flies straight towards"));
  radar.velocity_mps = {};
  EXPECT_THAT(message_of_error(ahead), HasSubstr("stands still"));

  radar = flying_north(Mode::DopplerBeamSharpening);
  radar.processing.interval_s = 0.01;
  const auto plan = coherent_plan(radar, place_at(45.0));
  // λ/(2 v T θ_b) = 0.03 / (2 · 200 · 0.01 · 0.0349) = 0.2149 = sin 12.4°.
  EXPECT_THAT(plan_warnings(radar, plan, {1000.0, 9000.0, 1500.0, 9500.0}, 0.0),
              ::testing::Contains(HasSubstr("blind wedge ahead, within 12.4°")));
  EXPECT_THAT(plan_warnings(radar, plan, {-500.0, 9000.0, 500.0, 9500.0}, 0.0),
              ::testing::Contains(HasSubstr("both sides of the course")));
  radar.waveform.pulse_repetition_hz = 100.0;
  EXPECT_THAT(plan_warnings(radar, plan, {7000.0, 7000.0, 7500.0, 7500.0}, 0.0),
              ::testing::Contains(HasSubstr("folds over")));
  radar.waveform.pulse_repetition_hz = 2000.0;
  EXPECT_THAT(plan_warnings(radar, plan, {7000.0, 7000.0, 7500.0, 7500.0}, 0.0), ::testing::IsEmpty());
}

}  // namespace
}  // namespace sigmascape::radar
