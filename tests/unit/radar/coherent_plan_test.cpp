#include "sigmascape/radar/coherent_plan.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <utility>

#include "flying_north.h"
#include "scratch_folder.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/coherent_warnings.h"
#include "sigmascape/radar/doppler.h"

namespace sigmascape::radar {
namespace {

using ::testing::HasSubstr;

/// What keeps a radar from mapping what lies abeam; nothing where it can.
std::string refusal_of(const Radar& radar) {
  return message_of_error([&] { static_cast<void>(coherent_plan(radar, place_at(90.0))); });
}

constexpr double cells = 0.8859;

TEST(CoherentPlan, IntervalsGiveTheWantedResolution) {
  Radar radar = flying_north(Mode::DopplerBeamSharpening);
  radar.processing.sharpening = 20.0;
  radar.processing.looks = 4;
  const auto sharpened = coherent_plan(radar, place_at(30.0));
  // 304.5 pulses, of which every look has 76.
  EXPECT_NEAR(sharpened.interval_s, cells * 4.0 * 0.03 / (2.0 * 200.0 * radians_from_deg(2.0) / 20.0 * 0.5), 1e-3);
  EXPECT_DOUBLE_EQ(sharpened.interval_s, 0.304);
  EXPECT_NEAR(sharpened.along_resolution_m, 10e3 * radians_from_deg(2.0) / 20.0 * 304.55 / 304.0, 1e-3);
  EXPECT_NEAR(sharpened.squint_rad, radians_from_deg(30.0), 1e-12);

  radar = flying_north(Mode::Spotlight);
  radar.range_resolution_m = 1.5;
  EXPECT_NEAR(coherent_plan(radar, place_at(90.0)).interval_s, cells * 0.03 * 10e3 / (2.0 * 200.0 * 1.5), 1e-4);
  radar.processing.interval_s = 1.0;
  EXPECT_NEAR(coherent_plan(radar, place_at(90.0)).along_resolution_m, cells * 0.03 * 10e3 / (2.0 * 200.0), 1e-3);
}

TEST(CoherentPlan, WhatContradictsItselfOrMeansNothingIsRefused) {
  Radar radar = flying_north(Mode::Spotlight);
  radar.processing.along_resolution_m = 0.75;
  EXPECT_EQ(refusal_of(radar), "");
  radar.processing.interval_s = 0.1;
  EXPECT_THAT(refusal_of(radar),
              HasSubstr("has interval_s and along_resolution_m, which say the same thing; leave out one"));
  radar.processing.along_resolution_m.reset();
  EXPECT_EQ(refusal_of(radar), "");
  radar.processing.sharpening = 48.0;
  EXPECT_THAT(refusal_of(radar), HasSubstr("has sharpening, which means nothing in its mode"));
  radar.processing.sharpening.reset();
  radar.mode = Mode::Stripmap;
  EXPECT_THAT(refusal_of(radar), HasSubstr("has interval_s, which means nothing in its mode"));
}

/// By how many Doppler cells of the interval two places differ that lie a resolution apart along the same range.
double cells_apart(const Radar& radar, Vec3d aim, const CoherentPlan& plan) {
  const double half_angle = plan.along_resolution_m / std::hypot(aim.x, aim.y) / 2.0;
  const auto turned = [&](double angle) {
    return Vec3d{aim.x * std::cos(angle) - aim.y * std::sin(angle), aim.x * std::sin(angle) + aim.y * std::cos(angle),
                 aim.z};
  };
  const auto frequency_hz = [&](Vec3d place) {
    return doppler_hz(range_rate_mps({radar.position, radar.velocity_mps}, {place}), wavelength_m(radar.frequency_hz));
  };
  return std::abs(frequency_hz(turned(half_angle)) - frequency_hz(turned(-half_angle))) * plan.interval_s;
}

TEST(CoherentPlan, ResolvesOnTheGroundHoweverSteeplyItLooksAndClimbs) {
  for (const Mode mode : {Mode::DopplerBeamSharpening, Mode::Spotlight}) {
    Radar radar = flying_north(mode);
    for (const auto& [off_course_deg, depression_deg] :
         {std::pair{90.0, 20.0}, {30.0, 40.0}, {8.0, 20.0}, {165.0, 60.0}}) {
      const Vec3d aim = ground_at(off_course_deg, depression_deg);
      for (const double climb_mps : {0.0, 60.0, -60.0}) {
        radar.velocity_mps = {0.0, 200.0, climb_mps};
        const CoherentPlan plan = coherent_plan(radar, aim);
        EXPECT_NEAR(cells_apart(radar, aim, plan), cells, 2e-3) << off_course_deg << ' ' << climb_mps;
        const double wanted_m = mode == Mode::Spotlight
                                    ? radar.range_resolution_m
                                    : radar.beam_width_rad * std::hypot(aim.x, aim.y) / usual_sharpening;
        const double pulses = plan.interval_s * radar.waveform.pulse_repetition_hz;
        EXPECT_NEAR(plan.along_resolution_m / wanted_m, 1.0, 0.51 / pulses);
      }
    }
  }
}

TEST(CoherentPlan, AStripsBeamHasLessDopplerTheSteeperItLooks) {
  Radar radar = flying_north(Mode::Stripmap);
  radar.range_resolution_m = 0.01;
  const double half_beam = radians_from_deg(1.0);
  // Level and at ψ when it is abeam, a point α ahead of broadside is seen under sin φ' = sin α/√(1 + tan²ψ cos²α).
  const auto sine = [](double depression_deg, double ahead) {
    const double slope = std::tan(radians_from_deg(depression_deg)) * std::cos(ahead);
    return std::sin(ahead) / std::sqrt(1.0 + slope * slope);
  };
  for (const double depression_deg : {0.0, 20.0, 60.0}) {
    const double sines = 2.0 * sine(depression_deg, half_beam);
    EXPECT_NEAR(coherent_plan(radar, ground_at(90.0, depression_deg)).along_resolution_m, cells * 0.03 / (2.0 * sines),
                1e-4);
    EXPECT_NEAR(sines, 2.0 * std::sin(half_beam) * std::cos(radians_from_deg(depression_deg)), 2e-5);
  }
  // 30° ahead of broadside, where the ground is 5 km abeam and 3 km below.
  const double ahead = radians_from_deg(30.0), abeam_deg = deg_from_radians(std::atan2(3.0, 5.0));
  const double sines = sine(abeam_deg, ahead + half_beam) - sine(abeam_deg, ahead - half_beam);
  const Vec3d aim{5e3, 5e3 * std::tan(ahead), -3e3};
  EXPECT_NEAR(coherent_plan(radar, aim).along_resolution_m, cells * 0.03 / (2.0 * sines), 1e-4);
  // What is advised is not refused in turn.
  radar.processing.along_resolution_m = 0.01;
  const std::string message = message_of_error([&] { static_cast<void>(coherent_plan(radar, aim)); });
  radar.processing.along_resolution_m = std::stod(message.substr(message.find("at least ") + 9));
  EXPECT_NO_THROW(static_cast<void>(coherent_plan(radar, aim)));
  // A climb has a Doppler of its own that changes little while the beam passes.
  radar.processing.along_resolution_m.reset();
  const double level_m = coherent_plan(radar, ground_at(90.0, 20.0)).along_resolution_m;
  radar.velocity_mps = {0.0, 200.0, 20.0};
  EXPECT_NEAR(coherent_plan(radar, ground_at(90.0, 20.0)).along_resolution_m / level_m, 1.0, 0.05);
}

TEST(CoherentPlan, StraightAheadIsRefusedHoweverSteeplyItLooks) {
  for (const Mode mode : {Mode::DopplerBeamSharpening, Mode::Spotlight, Mode::Stripmap}) {
    const Radar radar = flying_north(mode);
    for (const double off_course_deg : {0.0, 0.9, 179.5}) {
      const auto plan = [&] { static_cast<void>(coherent_plan(radar, ground_at(off_course_deg, 30.0))); };
      EXPECT_THAT(message_of_error(plan), HasSubstr("flies straight towards or away"));
    }
    EXPECT_NO_THROW(static_cast<void>(coherent_plan(radar, ground_at(1.1, 30.0))));
  }
  Radar radar = flying_north(Mode::DopplerBeamSharpening);
  radar.processing.interval_s = 0.1;
  // Straight ahead half a cell of Doppler below the highest: to both sides where cos φ = 1 − w λ/(4 v T cos ψ).
  const double ground_m = 10e3 * std::cos(radians_from_deg(30.0));
  const double width_m =
      2.0 * ground_m * std::acos(1.0 - cells * 0.03 / (4.0 * 200.0 * 0.1 * std::cos(radians_from_deg(30.0))));
  EXPECT_NEAR(coherent_plan(radar, ground_at(0.0, 30.0)).along_resolution_m, width_m, 0.01);
  radar.velocity_mps = {0.0, 0.0, 200.0};
  EXPECT_TRUE(std::isfinite(coherent_plan(radar, ground_at(0.0, 30.0)).along_resolution_m));
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(coherent_plan(radar, {0.0, 0.0, -5e3}));
              }),
              HasSubstr("straight above what it maps"));
}

/// A wavelength of 1 m, which an even window resolves to more than 0.2215 m.
TEST(CoherentPlan, WhereDopplerTellsNothingIsRefused) {
  Radar radar = flying_north(Mode::DopplerBeamSharpening);
  const auto ahead = [&] { static_cast<void>(coherent_plan(radar, place_at(0.5))); };
  EXPECT_THAT(message_of_error(ahead), HasSubstr("flies straight towards"));
  radar.velocity_mps = {};
  EXPECT_THAT(message_of_error(ahead), HasSubstr("stands still"));
}

TEST(CoherentPlan, NoIntervalResolvesLessThanAllSidesGive) {
  Radar radar = flying_north(Mode::Spotlight);
  radar.frequency_hz = speed_of_light_mps;
  radar.processing.along_resolution_m = 0.1;
  EXPECT_EQ(refusal_of(radar),
            "radar: cannot map to 0.1 m across range at a wavelength of 1 m, however long it flies past; "
            "give mode.along_resolution_m of more than 0.222");
  radar.processing.along_resolution_m = 0.222;
  EXPECT_EQ(refusal_of(radar), "");
  radar.processing.looks = 3;
  EXPECT_THAT(refusal_of(radar), ::testing::EndsWith("give mode.along_resolution_m of more than 0.665 or fewer looks"));

  radar.processing = {};
  radar.processing.interval_s = 1000.0;
  EXPECT_THAT(refusal_of(radar), ::testing::EndsWith("give mode.interval_s of less than 100"));
  radar.processing.interval_s = 99.9;
  EXPECT_EQ(refusal_of(radar), "");

  // 349 m of beam over 0.2215 m.
  radar = flying_north(Mode::DopplerBeamSharpening);
  radar.frequency_hz = speed_of_light_mps;
  radar.processing.sharpening = 5000.0;
  EXPECT_THAT(refusal_of(radar), ::testing::EndsWith("give mode.sharpening of less than 1570"));
  radar.processing.sharpening = 1570.0;
  EXPECT_EQ(refusal_of(radar), "");
}

/// At 1000 Hz and 45° off the nose, 30 km · 0.8859/(2 · 200 · T · sin 45°).
TEST(CoherentPlan, EveryLookHasAsManyWholePulses) {
  Radar radar = flying_north(Mode::Spotlight);
  const auto plan = [&](double interval_s, int looks) {
    radar.processing.interval_s = interval_s;
    radar.processing.looks = looks;
    return coherent_plan(radar, place_at(45.0));
  };
  for (const auto& [asked_s, looks, pulses] :
       {std::tuple{0.1, 1, 100.0}, {0.0016, 1, 2.0}, {0.0333, 1, 33.0}, {0.0333, 4, 32.0}, {0.035, 4, 36.0}}) {
    const CoherentPlan made = plan(asked_s, looks);
    EXPECT_DOUBLE_EQ(made.interval_s, pulses / 1000.0);
    EXPECT_NEAR(made.along_resolution_m * pulses / 1000.0, looks * cells * 300.0 / (400.0 * std::sqrt(0.5)), 1e-3);
  }
}

TEST(CoherentPlan, LooksWithoutPulsesAreRefusedByTheKeysThatGiveThem) {
  Radar radar = flying_north(Mode::Spotlight);
  radar.processing.interval_s = 0.01;
  radar.processing.looks = 100;
  EXPECT_EQ(refusal_of(radar),
            "radar: has 10 pulses in an interval of 0.01 s, at a pulse repetition frequency of 1000 Hz, and 100 looks, "
            "each of which takes one; give mode.interval_s of at least 0.1, fewer mode.looks or a higher "
            "waveform.pulse_repetition_hz");
  radar.processing.interval_s = 0.1;
  EXPECT_EQ(refusal_of(radar), "");
  radar.processing.interval_s = 0.001;
  radar.processing.looks = 1;
  EXPECT_THAT(refusal_of(radar),
              HasSubstr("has 1 pulse in an interval of 0.001 s, at a pulse repetition frequency of 1000 Hz, "
                        "and Doppler takes two; give mode.interval_s of at least 0.002 or a higher"));

  // Of what follows from a resolution there are as few pulses a look whatever the looks.
  radar.waveform.pulse_repetition_hz = 1.0;
  radar.processing.interval_s.reset();
  radar.processing.along_resolution_m = 10.0;
  radar.processing.looks = 3;
  EXPECT_THAT(refusal_of(radar), ::testing::EndsWith("give mode.along_resolution_m of at most 0.664 or a higher "
                                                     "waveform.pulse_repetition_hz"));
  radar.processing.along_resolution_m = 0.664;
  EXPECT_EQ(refusal_of(radar), "");
  radar.mode = Mode::DopplerBeamSharpening;
  radar.processing.along_resolution_m.reset();
  const std::string message = refusal_of(radar);
  ASSERT_THAT(message, HasSubstr("give mode.sharpening of at least "));
  radar.processing.sharpening = std::stod(message.substr(message.find("at least ") + 9));
  EXPECT_EQ(refusal_of(radar), "");
}

TEST(CoherentPlan, WhatWouldTakeHoursIsRefusedByTheKeysThatMakeItLong) {
  Radar radar = flying_north(Mode::Spotlight);
  radar.velocity_mps = {0.0, 0.001, 0.0};
  // 0.8859 · 0.03 m · 10 km/(2 · 0.001 m/s · 2 m).
  EXPECT_EQ(refusal_of(radar),
            "radar: takes 6.64e+04 s to tell apart 2 m across range at 0.001 m/s; give a higher "
            "platform.speed_mps, or give mode.along_resolution_m of more than 13.3");
  radar.processing.along_resolution_m = 13.3;
  EXPECT_EQ(refusal_of(radar), "");
}

/// Two half-power widths of Doppler from each corner, and no farther than the course.
TEST(CoherentPlan, GroundAnswersInTheOutermostCellsAsFarAsTheyReachInDoppler) {
  Radar radar = flying_north(Mode::DopplerBeamSharpening);
  radar.velocity_mps = {0.0, 200.0, -10.0};
  const double height_m = -3000.0;
  const auto place = [&](double off_course_deg, double ground_range_m) {
    const double off = radians_from_deg(off_course_deg);
    return Vec3d{ground_range_m * std::sin(off), ground_range_m * std::cos(off), height_m};
  };
  const auto frequency_hz = [&](Vec3d at) {
    return doppler_hz(range_rate_mps({radar.position, radar.velocity_mps}, {at}), wavelength_m(radar.frequency_hz));
  };
  const CoherentPlan plan = coherent_plan(radar, place(20.0, 9000.0));
  const double two_widths_hz = 2.0 * cells / plan.interval_s;
  // One point as an area: the ground reaches along the arc of its range to both sides.
  const Vec3d corner = place(12.0, 9000.0);
  const Rectangle ground = answering_ground(radar, plan, {corner.x, corner.y, corner.x, corner.y}, height_m);
  const auto on_arc_east = [&](double x) { return Vec3d{x, std::sqrt(9000.0 * 9000.0 - x * x), height_m}; };
  EXPECT_NEAR(frequency_hz(on_arc_east(ground.west_m)) - frequency_hz(corner), two_widths_hz, 1e-3 * two_widths_hz);
  EXPECT_NEAR(frequency_hz(corner) - frequency_hz(on_arc_east(ground.east_m)), two_widths_hz, 1e-3 * two_widths_hz);
  EXPECT_GT(corner.x - ground.west_m, 3.0 * plan.along_resolution_m) << "cells are wider there than in the middle";
  const Vec3d near_course = place(0.3, 9000.0);
  EXPECT_NEAR(
      answering_ground(radar, plan, {near_course.x, near_course.y, near_course.x, near_course.y}, height_m).west_m, 0.0,
      1e-6);
}

/// 0.8859 · 200 m/s / 0.381 m are 465 Hz of the beam.
TEST(CoherentPlan, AStripsBandIsNoWiderThanPulsesKnowDoppler) {
  Radar radar = flying_north(Mode::Stripmap);
  radar.range_resolution_m = 0.1;
  radar.waveform.pulse_repetition_hz = 466.0;
  EXPECT_EQ(refusal_of(radar), "");
  radar.waveform.pulse_repetition_hz = 400.0;
  EXPECT_EQ(refusal_of(radar),
            "radar: maps a strip to 0.381 m along the flight from a Doppler band of 465.4 Hz, wider than the pulse "
            "repetition frequency of 400 Hz, up to which pulses know Doppler; give mode.along_resolution_m of at least "
            "0.443 or waveform.pulse_repetition_hz of at least 466");
  radar.processing.along_resolution_m = 0.443;
  EXPECT_EQ(refusal_of(radar), "");
  radar.processing.looks = 2;
  EXPECT_THAT(refusal_of(radar), HasSubstr("with 2 looks"));
}

TEST(CoherentPlan, AStripHasPulsesForItsLooks) {
  // n λ r/(2 v δ) f_p pulses pass a place: 0.8859 · 4 · 0.03 m · 10 km/(2 · 200 m/s · 100 m) · f_p.
  Radar radar = flying_north(Mode::Stripmap);
  radar.processing.along_resolution_m = 100.0;
  radar.processing.looks = 4;
  radar.waveform.pulse_repetition_hz = 100.0;
  EXPECT_EQ(
      refusal_of(radar),
      "radar: has 2.66 pulses in an interval of 0.0266 s, at a pulse repetition frequency of 100 Hz, and 4 looks, "
      "each of which takes one; give mode.along_resolution_m of at most 66.4 or a higher "
      "waveform.pulse_repetition_hz");
  radar.processing.along_resolution_m = 66.4;
  EXPECT_EQ(refusal_of(radar), "");
  radar.processing.along_resolution_m = 100.0;
  radar.waveform.pulse_repetition_hz = 151.0;
  EXPECT_EQ(refusal_of(radar), "");
  const Rectangle area{9000.0, -1000.0, 11000.0, 1000.0};
  EXPECT_THAT(plan_warnings(radar, coherent_plan(radar, place_at(90.0)), area, 0.0),
              ::testing::Contains(HasSubstr("each look has 1 pulse, too few for the resolution of 100 m along the "
                                            "flight and for the side lobes of its window; give "
                                            "mode.along_resolution_m of at most 25")));
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

/// 30° ahead of broadside, where a place that is abeam at time zero will be seen 5 km across, 5 km · tan 30° ahead and
/// 3 km below.
TEST(CoherentPlan, AStripsFixedBeamSeesWhatItMapsAsItPasses) {
  Radar radar = flying_north(Mode::Stripmap);
  const Vec3d aim{5e3, 0.0, -3e3}, way{5e3, 5e3 * std::tan(radians_from_deg(30.0)), -3e3};
  EXPECT_NEAR(coherent_plan(radar, aim).squint_rad, radians_from_deg(90.0), 1e-12);
  radar.scan = {.kind = ScanKind::Fixed, .azimuth_rad = radians_from_deg(60.0)};
  const CoherentPlan plan = coherent_plan(radar, aim);
  const double sine = std::sqrt(1.0 - way.y * way.y / dot(way, way));
  EXPECT_NEAR(std::cos(plan.squint_rad), way.y / length(way), 1e-12);
  // Band over Doppler rate.
  EXPECT_NEAR(plan.interval_s / (cells * 0.03 * length(way) / (2.0 * 200.0 * sine * sine * plan.along_resolution_m)),
              1.0, 1e-4);
}

TEST(CoherentPlan, AStripsFixedBeamThatNeverSeesWhatItMapsIsRefused) {
  Radar radar = flying_north(Mode::Stripmap);
  const auto refused = [&](double azimuth_deg) {
    radar.scan = {.kind = ScanKind::Fixed, .azimuth_rad = radians_from_deg(azimuth_deg)};
    return refusal_of(radar);
  };
  EXPECT_EQ(refused(270.0),
            "radar: points the beam of its strip to the left of its course, and what it maps lies to the right; "
            "give scan.azimuth_deg on that side, or leave it out");
  EXPECT_EQ(refused(-0.5),
            "radar: points the beam of its strip along its course, 0.5° off, where it passes over nothing; "
            "give scan.azimuth_deg farther to the side, or leave it out");
  EXPECT_THAT(refused(179.5), HasSubstr("along its course"));
  EXPECT_EQ(refused(91.1), "");
  radar.mode = Mode::Spotlight;
  EXPECT_EQ(refused(270.0), "");
}

}  // namespace
}  // namespace sigmascape::radar
