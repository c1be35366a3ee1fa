#include "sigmascape/radar/coherent_warnings.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flying_north.h"
#include "scratch_folder.h"

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(CoherentWarnings, WarnsOfLooksOfFewPulses) {
  Radar radar = flying_north(Mode::Spotlight);
  const Rectangle area{9000.0, -1000.0, 11000.0, 1000.0};
  const auto warnings = [&](double interval_s) {
    radar.processing.interval_s = interval_s;
    radar.processing.looks = 2;
    return plan_warnings(radar, coherent_plan(radar, place_at(90.0)), area, 0.0);
  };
  EXPECT_THAT(warnings(0.002), ::testing::Contains(HasSubstr("each look has 1 pulse, too few")));
  EXPECT_THAT(warnings(0.006), ::testing::Contains(HasSubstr("each look has 3 pulses, too few")));
  EXPECT_THAT(warnings(0.006), ::testing::Contains(HasSubstr("give mode.interval_s of at least 0.008, fewer mode.looks "
                                                             "or a higher waveform.pulse_repetition_hz")));
  EXPECT_THAT(warnings(0.008), ::testing::Not(::testing::Contains(HasSubstr("too few"))));
  // Where the interval follows from another key it cannot be stated, and takes its length from the looks.
  radar.processing.interval_s.reset();
  radar.processing.along_resolution_m = 100.0;
  radar.waveform.pulse_repetition_hz = 500.0;
  EXPECT_THAT(plan_warnings(radar, coherent_plan(radar, place_at(90.0)), area, 0.0),
              ::testing::Contains(AllOf(HasSubstr("its window; give mode.along_resolution_m of at most "),
                                        ::testing::Not(HasSubstr("looks")))));
}

/// 0.8859 · 0.03 m · 10 km/(2 · 200 m/s · 0.01 s) are 66 m.
TEST(CoherentWarnings, WarnsOfAResolutionWiderThanTheMap) {
  Radar radar = flying_north(Mode::Spotlight);
  radar.processing.interval_s = 0.01;
  const CoherentPlan plan = coherent_plan(radar, place_at(90.0));
  const Rectangle narrow{9900.0, -30.0, 10100.0, 30.0};
  EXPECT_THAT(
      plan_warnings(radar, plan, narrow, 0.0),
      ::testing::ElementsAre(AllOf(HasSubstr("the resolution of 66.4 m across range is wider than what is mapped, "
                                             "60 m, and nothing of it is told apart; map more, or more finely by "),
                                   EndsWith("by a longer mode.interval_s"))));
  Radar in_looks = radar;
  in_looks.processing.looks = 2;
  EXPECT_THAT(plan_warnings(in_looks, coherent_plan(in_looks, place_at(90.0)), narrow, 0.0),
              ::testing::Contains(EndsWith("by a longer mode.interval_s or fewer mode.looks")));
  EXPECT_THAT(plan_warnings(radar, plan, {9990.0, -40.0, 10010.0, 40.0}, 0.0), ::testing::IsEmpty());
}

TEST(CoherentWarnings, WarnsWhereTheLineOfSightTurnsFar) {
  // Abeam and level the pulses of T turn by Δ, tan Δ/2 = v T/2 r, and resolve w λ/(4 sin Δ/2), of which the plan has
  // cos Δ/2.
  Radar radar = flying_north(Mode::Spotlight);
  radar.frequency_hz = speed_of_light_mps;
  const auto warnings_at = [&](double width_m) {
    radar.processing.along_resolution_m = width_m;
    return plan_warnings(radar, coherent_plan(radar, place_at(90.0)), {9999.0, -1.0, 10001.0, 1.0}, 0.0);
  };
  // tan Δ/2 is 0.2215/δ, and 1/cos Δ/2 is 1.05 at δ = 0.692.
  EXPECT_THAT(warnings_at(0.70), ::testing::IsEmpty());
  EXPECT_THAT(warnings_at(0.68), ::testing::ElementsAre(HasSubstr("turns so far in it")));
  EXPECT_THAT(warnings_at(0.443),
              ::testing::ElementsAre(HasSubstr("resolve 0.495 m across range and not the 0.443 m of this map")));
}

TEST(CoherentWarnings, WarnsOfDopplerThatGoesRoundTheImagesEnd) {
  // From 50° off the nose to 70° and 10 km away at least, the Doppler reaches farther from its middle upwards.
  Radar radar = flying_north(Mode::DopplerBeamSharpening);
  const Rectangle area{7000.0, 0.0, 8000.0, 6000.0};
  const auto doppler = [&](double x, double y) { return 2.0 * 200.0 / 0.03 * y / std::hypot(x, y); };
  const double most_hz = doppler(7000.0, 6000.0), middle_hz = doppler(7500.0, 3000.0);
  const double span_hz = most_hz - doppler(7000.0, 0.0), reach_hz = middle_hz;
  ASSERT_GT(2.0 * reach_hz, span_hz * 1.01);
  const auto plan = coherent_plan(radar, {7500.0, 3000.0, 0.0});
  radar.waveform.pulse_repetition_hz = span_hz * 1.005;
  EXPECT_THAT(plan_warnings(radar, plan, area, 0.0),
              ::testing::ElementsAre(HasSubstr("reaches 4952 Hz from that of its middle, more than half")));
  radar.waveform.pulse_repetition_hz = span_hz * 0.99;
  EXPECT_THAT(plan_warnings(radar, plan, area, 0.0), ::testing::ElementsAre(HasSubstr("folds over")));
  radar.waveform.pulse_repetition_hz = 2.0 * reach_hz * 1.01;
  EXPECT_THAT(plan_warnings(radar, plan, area, 0.0), ::testing::IsEmpty());
}

TEST(CoherentWarnings, WarnsOfTheBlindWedgeOnTheMap) {
  Radar radar = flying_north(Mode::DopplerBeamSharpening);
  radar.processing.interval_s = 0.01;
  // λ/(2 v T θ_b cos ψ) = 0.2149 / cos 60° = sin 25.5°; 20° off the course the angle in space is 62°.
  const auto plan = coherent_plan(radar, ground_at(45.0, 60.0));
  EXPECT_NEAR(deg_from_radians(plan.blind_wedge_rad), 25.45, 0.02);
  const Vec3d inside = ground_at(20.0, 60.0);
  const Rectangle there{inside.x - 10.0, inside.y - 10.0, inside.x + 10.0, inside.y + 10.0};
  EXPECT_THAT(plan_warnings(radar, plan, there, inside.z), ::testing::Contains(HasSubstr("blind wedge")));
  const Rectangle behind{inside.x - 10.0, -inside.y - 10.0, inside.x + 10.0, -inside.y + 10.0};
  EXPECT_THAT(plan_warnings(radar, plan, behind, inside.z), ::testing::Contains(HasSubstr("blind wedge")));
  radar.mode = Mode::Spotlight;
  EXPECT_THAT(plan_warnings(radar, plan, there, inside.z), ::testing::Contains(HasSubstr("blind wedge")));
}

TEST(CoherentWarnings, WhereDopplerTellsNothingIsSaid) {
  Radar radar = flying_north(Mode::DopplerBeamSharpening);
  radar.processing.interval_s = 0.01;
  const auto plan = coherent_plan(radar, place_at(45.0));
  // λ/(2 v T θ_b) = 0.03 / (2 · 200 · 0.01 · 0.0349) = 0.2149 = sin 12.4°.
  EXPECT_THAT(plan_warnings(radar, plan, {1000.0, 9000.0, 1500.0, 9500.0}, 0.0),
              ::testing::Contains(HasSubstr("blind wedge about the course, within 12.4° of it")));
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
