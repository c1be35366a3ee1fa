#include "sigmascape/simulate/coherent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "scratch_folder.h"
#include "unit/simulate/level_ground.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/coherent_plan.h"
#include "sigmascape/simulate/scatterer_spacing.h"

namespace sigmascape::simulate {
namespace {

using ::testing::HasSubstr;

/// Looks north from 8 km to the south on ground that returns nothing, with a beam of 2°, and flies east.
radar::Radar looking_north(radar::Mode mode) {
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(20.0), 8000.0);
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.beam_width_rad = radians_from_deg(2.0);
  radar.waveform.pulse_repetition_hz = 2000.0;
  radar.mode = mode;
  return radar;
}

radar::PhaseHistory pulses_of(const radar::Radar& radar, const CoherentSettings& settings,
                              Vec3d place = {0.0, 0.0, 1.0}) {
  radar::Target bright;
  bright.track = radar::Track::straight(place);
  bright.rcs_m2 = radar::Channels{1e8F, 1e8F, 0.0F, 1e8F};
  const std::vector<radar::Target> targets{bright};
  return phase_history({&level_ground, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }, targets}, radar,
                       small_area, settings);
}

double brightest_db(const radar::Radar& radar) {
  const auto history = pulses_of(radar, {.interval_s = 0.002, .calibrated = true});
  float best = 0.0F;
  for (const auto& sample : history.samples.values()) best = std::max(best, std::norm(sample.vv));
  return db_from_linear(static_cast<double>(best));
}

/// Ground is as bright in the cells of one look as in those of four, and so is noise, where pulses are left over.
TEST(Looks, HaveCellsOfThePulsesThatTheyHave) {
  radar::Radar radar = looking_north(radar::Mode::Spotlight);
  radar.waveform.window = {.shape = radar::WindowShape::Rectangular};
  for (const bool is_noise : {false, true}) {
    radar.processing.thermal_noise = is_noise;
    const float sigma0 = is_noise ? 0.0F : 1.0F;
    const CoherentScene scene{&level_ground, [sigma0](Vec2d, const radar::Aspect&) {
                                return radar::Channels{sigma0, sigma0, 0.0F, sigma0};
                              }};
    const auto power_a_cell = [&](std::size_t looks) {
      double sum = 0.0;
      range_doppler_looks(scene, radar, {-200.0, -200.0, 200.0, 200.0}, {.interval_s = 0.0055}, looks,
                          [&](const radar::RangeDopplerImage& look) {
                            double power = 0.0;
                            for (const auto& bin : look.amplitude_m.values())
                              power += static_cast<double>(std::norm(bin.vv));
                            sum += power / static_cast<double>(look.amplitude_m.size()) / look.doppler_cell_hz;
                          });
      return sum / static_cast<double>(looks);
    };
    EXPECT_NEAR(db_from_linear(power_a_cell(4) / power_a_cell(1)), 0.0, 0.3) << "eleven pulses, two a look";
  }
}

/// 200 m in two seconds, of which a squinted beam sees the better part as range.
TEST(Pulses, AreRecordedWhereTheAreaIsAtEachOfThem) {
  radar::Radar radar = looking_north(radar::Mode::Spotlight);
  radar.waveform.pulse_repetition_hz = 200.0;
  for (const double azimuth_deg : {120.0, 180.0, 225.0}) {
    radar.position = radar::position_seeing({}, radians_from_deg(azimuth_deg), radians_from_deg(20.0), 8000.0);
    for (const double side_m : {-45.0, 45.0}) {
      const auto history = pulses_of(radar, {.interval_s = 2.0}, {side_m, -side_m, 1.0});
      for (std::size_t n = 0; n < history.samples.rows(); n += 21) {
        float best = 0.0F;
        for (const auto& sample : history.samples.row(n)) best = std::max(best, std::norm(sample.vv));
        // Between two samples of the pulse a decibel or so is lost.
        EXPECT_NEAR(db_from_linear(static_cast<double>(best)), 79.2, 0.9) << azimuth_deg << "°, pulse " << n;
      }
    }
  }
}

/// Over the curved Earth a mover's range changes as the bent places of its way say, and images look for it at
/// that Doppler.
TEST(Pulses, HaveMoversOfTheRangeRateThatTheCurvedEarthGivesThem) {
  radar::Radar radar = looking_north(radar::Mode::Spotlight);
  radar.position = {0.0, -80e3, 9000.0};
  radar.earth_refraction = 4.0 / 3.0;
  radar::Target mover;
  mover.track = radar::Track::straight({0.0, 0.0, 1.0}, {30.0, 250.0, 0.0});
  mover.rcs_m2 = radar::Channels{1e8F, 1e8F, 0.0F, 1e8F};
  const std::vector<radar::Target> targets{mover};
  const CoherentScene scene{&level_ground, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }, targets};
  const radar::CurvedEarth earth = radar::earth_of(radar);
  const auto range_m = [&](double time_s) {
    return length(earth.bent(mover.track.position_at(time_s), {radar.position.x, radar.position.y}) -
                  (radar.position + radar.velocity_mps * time_s));
  };
  const auto brightest = [](const auto& row) {
    return std::ranges::max(row, {}, [](const radar::ComplexChannels& sample) { return std::norm(sample.vv); }).vv;
  };
  const auto history = phase_history(scene, radar, small_area, {.interval_s = 0.02});
  const std::size_t last = history.samples.rows() - 1;
  const double first_s = history.pulses.front().time_s, last_s = history.pulses.back().time_s;
  const double turns = 2.0 * (range_m(last_s) - range_m(first_s)) / wavelength_m(radar.frequency_hz);
  const double measured = std::arg(brightest(history.samples.row(0)) * std::conj(brightest(history.samples.row(last))));
  EXPECT_NEAR(std::remainder(measured / (2.0 * pi) - turns, 1.0), 0.0, 0.05);

  const auto image = range_doppler_image(scene, radar, small_area, {.interval_s = 0.5});
  const double rate_mps = (range_m(0.01) - range_m(-0.01)) / 0.02;
  const double doppler_hz = -2.0 * rate_mps / wavelength_m(radar.frequency_hz);
  const double seen_hz =
      image.doppler_hz.middle_of(image.place_of({mover.track.position_at(0.0), mover.track.velocity_at(0.0)}).x);
  EXPECT_NEAR(std::remainder(seen_hz - doppler_hz, radar.waveform.pulse_repetition_hz), 0.0, 1.0);
}

/// A helicopter among hills: what is as high as it, on the near edge, is nearer than the valley and the ridge.
TEST(Pulses, AreRecordedFromGroundAsHighAsTheRadar) {
  terrain::HeightField hills = level_ground;
  for (float& height : hills.height_m.values()) height = 500.0F;
  hills.height_m(0, 0) = 200.0F;
  hills.height_m(40, 0) = 900.0F;
  radar::Radar radar = looking_north(radar::Mode::Spotlight);
  radar.position = {0.0, -950.0, 501.0};
  radar.range_resolution_m = 1.0;
  const auto history = phase_history({&hills, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }}, radar,
                                     small_area, {.interval_s = 0.002});
  EXPECT_LE(history.first_range_m, 900.0);
  EXPECT_GT(history.first_range_m, 880.0);
}

/// Ground is as far from the squinted antenna as its gate says.
TEST(Strip, OfASquintedAntennaKeepsToTheGateOfItsReceiver) {
  radar::Radar radar = looking_north(radar::Mode::Stripmap);
  radar.position = radar::position_seeing({}, radians_from_deg(225.0), radians_from_deg(20.0), 8000.0);
  radar::Target bright;
  bright.track = radar::Track::straight({0.0, 0.0, 0.0});
  bright.rcs_m2 = radar::Channels{1e8F, 1e8F, 0.0F, 1e8F};
  const std::vector<radar::Target> targets{bright};
  const CoherentScene scene{&level_ground, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }, targets};
  const auto brightest_m2 = [&] {
    const auto image = stripmap_image(scene, radar, small_area, {.along_resolution_m = 2.0});
    float best = 0.0F;
    for (const auto& sample : image.amplitude_m.values()) best = std::max(best, std::norm(sample.vv));
    return static_cast<double>(best);
  };
  const double without_gate_m2 = brightest_m2();
  radar.receiver.first_range_m = 7900.0;
  radar.receiver.last_range_m = 8100.0;
  EXPECT_NEAR(db_from_linear(brightest_m2() / without_gate_m2), 0.0, 0.5);
}

/// Of everything that answers, the azimuths from the ground to the radar and the places.
struct Asked {
  std::vector<double> azimuths_rad;
  std::vector<Vec2d> places;

  [[nodiscard]] render::Reflectivity field() {
    return render::ReflectivityField([this](Vec2d place, const radar::Aspect& aspect) {
      azimuths_rad.push_back(std::abs(aspect.azimuth_rad));
      places.push_back(place);
      return radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
    });
  }
  [[nodiscard]] double least_rad() const { return std::ranges::min(azimuths_rad); }
};

/// Two seconds of pulses tell metres apart across ranges of 60 m.
TEST(Pulses, HaveScatterersForWhatTheyCanBeProcessedTo) {
  radar::Radar radar = looking_north(radar::Mode::RealBeam);
  radar.range_resolution_m = 60.0;
  radar.waveform.pulse_repetition_hz = 4.0;
  Asked asked;
  static_cast<void>(
      phase_history({&level_ground, asked.field()}, radar, small_area, {.interval_s = 2.0, .threads = 1}));
  const double across_m = resolution_of_interval_m(radar, {}, 2.0);
  EXPECT_LT(across_m, 1.0);
  const double side_m = scatterer_spacing_m(radar, across_m);
  EXPECT_NEAR(static_cast<double>(asked.places.size()) * side_m * side_m, 100.0 * 100.0, 300.0);
}

/// What takes minutes comes after what may be refused.
TEST(Pulses, AreRefusedBeforeTheGroundIsLookedAt) {
  radar::Radar radar = looking_north(radar::Mode::RealBeam);
  radar.waveform.pulse_repetition_hz = 1e6;
  Asked asked;
  const CoherentScene scene{&level_ground, asked.field()};
  const auto record = [&] {
    static_cast<void>(phase_history(scene, radar, {-100.0, -100.0, 100.0, 100.0}, {.interval_s = 1e-4, .threads = 1}));
  };
  EXPECT_THAT(message_of_error(record), HasSubstr("range gate"));
  EXPECT_THAT(asked.places, ::testing::IsEmpty());
}

/// Hears how many of how many are done.
struct Counting final : ProgressListener {
  double done = 0.0, total = 0.0;
  void advanced(std::string_view, double now, double of, std::string_view) override {
    EXPECT_GE(now, done);
    done = now;
    total = of;
  }
};

TEST(Pulses, TellHowManyAreRecorded) {
  Counting counting;
  static_cast<void>(
      pulses_of(looking_north(radar::Mode::RealBeam), {.interval_s = 0.02, .threads = 1, .progress = &counting}));
  EXPECT_EQ(counting.total, 40.0);
  EXPECT_EQ(counting.done, 40.0);
}

TEST(Pulses, AreRecordedFromARadarThatStandsStill) {
  radar::Radar radar = looking_north(radar::Mode::RealBeam);
  radar.velocity_mps = {};
  const auto history = pulses_of(radar, {.interval_s = 0.002});
  float best = 0.0F;
  for (const auto& sample : history.samples.row(1)) best = std::max(best, std::norm(sample.vv));
  EXPECT_NEAR(db_from_linear(static_cast<double>(best)), 79.2, 0.9);
  radar.mode = radar::Mode::Stripmap;
  EXPECT_THAT(message_of_error([&] { static_cast<void>(pulses_of(radar, {.interval_s = 0.002})); }),
              HasSubstr("stands still"));
}

/// A height above the ground that was taken for one above the sea is the usual reason.
TEST(Pulses, AndImagesAreRefusedFromWithinTheGround) {
  const terrain::HeightField high{
      .west_m = -1000.0, .north_m = 1000.0, .spacing_m = 50.0, .height_m = Array2D<float>(41, 41, 500.0F)};
  const CoherentScene scene{&high, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }};
  radar::Radar radar = looking_north(radar::Mode::Spotlight);
  const auto told = [&](Vec3d position) {
    radar.position = position;
    return std::array{
        message_of_error([&] { static_cast<void>(phase_history(scene, radar, small_area, {.interval_s = 0.002})); }),
        message_of_error(
            [&] { static_cast<void>(range_doppler_image(scene, radar, small_area, {.interval_s = 0.1})); }),
        message_of_error([&] { static_cast<void>(stripmap_image(scene, radar, small_area, {})); })};
  };
  EXPECT_THAT(told({0.0, -800.0, 300.0}), ::testing::Each(HasSubstr("and the ground under it at 500.0 m")));
  EXPECT_THAT(told({0.0, -8000.0, 300.0}), ::testing::Each(HasSubstr("and the lowest ground of the scene at 500.0 m")));
  EXPECT_THAT(told({0.0, -800.0, 510.0}), ::testing::Each(::testing::IsEmpty()));
}

/// Seen from a place that does not move, what one recording holds at half a second another one of that moment begins
/// with.
TEST(Pulses, HaveLeavesThatMoveOnFromRecordingToRecording) {
  radar::Radar radar = looking_north(radar::Mode::RealBeam);
  radar.velocity_mps = {};
  radar.wind_mps = 10.0;
  radar.waveform.pulse_repetition_hz = 10.0;
  const render::Reflectivity even = [](Vec2d, const radar::Aspect&) { return radar::Channels{1.0F, 1.0F, 0.0F, 1.0F}; };
  const CoherentScene scene{&level_ground, even, {}, [](Vec2d) { return true; }};
  const auto recorded = [&](double moment_s) {
    return phase_history(scene, radar, small_area,
                         {.interval_s = 2.0, .scatterer_spacing_m = 5.0, .moment_s = moment_s});
  };
  const auto first = recorded(0.0), later = recorded(0.5);
  const auto differs_by = [&](std::size_t pulse, std::size_t of_later) {
    double difference = 0.0, power = 0.0;
    for (std::size_t i = 0; i < first.samples.columns(); ++i) {
      difference += std::norm(std::complex<double>(first.samples(i, pulse).vv - later.samples(i, of_later).vv));
      power += std::norm(std::complex<double>(first.samples(i, pulse).vv));
    }
    return difference / power;
  };
  // Within a recording leaves change their place as well, by a small part of a resolution.
  EXPECT_LT(differs_by(15, 10), 0.01);
  EXPECT_GT(differs_by(10, 10), 0.1);
}

TEST(Pulses, AreOfTheScatterersOfTheirMap) {
  radar::Radar radar = looking_north(radar::Mode::Spotlight);
  radar.range_resolution_m = 60.0;
  radar.processing.along_resolution_m = 2.0;
  const radar::CoherentPlan plan = radar::coherent_plan(radar, {});
  Asked of_pulses, of_map;
  static_cast<void>(
      phase_history({&level_ground, of_pulses.field()}, radar, small_area, {.interval_s = 0.002, .threads = 1}));
  static_cast<void>(
      range_doppler_image({&level_ground, of_map.field()}, radar, small_area,
                          {.interval_s = plan.interval_s,
                           .scatterer_spacing_m = scatterer_spacing_m(radar, plan.along_resolution_m / plan.looks),
                           .threads = 1}));
  EXPECT_EQ(of_pulses.places, of_map.places);
}

TEST(Images, HaveScatterersForWhatTheyTellApart) {
  radar::Radar radar = looking_north(radar::Mode::Spotlight);
  radar.range_resolution_m = 60.0;
  Asked sharpened, strip;
  static_cast<void>(
      range_doppler_image({&level_ground, sharpened.field()}, radar, small_area, {.interval_s = 1.0, .threads = 1}));
  static_cast<void>(
      stripmap_image({&level_ground, strip.field()}, radar, small_area, {.along_resolution_m = 4.0, .threads = 1}));
  EXPECT_GT(sharpened.places.size(), 15'000U);
  // Ghosts of the strip ask for ground beyond the area.
  EXPECT_GE(strip.places.size(), 2500U);
}

/// A strip's beam looks north wherever it passes; from one place over 1 km the azimuth changes by 45°.
TEST(Strip, SeesAllGroundUnderTheAzimuthOfItsBeam) {
  radar::Radar radar = looking_north(radar::Mode::Stripmap);
  radar.position = {0.0, -600.0, 300.0};
  constexpr radar::Rectangle long_area{-500.0, -100.0, 500.0, 100.0};
  const CoherentSettings settings{.interval_s = 0.002, .scatterer_spacing_m = 20.0, .threads = 1};
  Asked of_strip, of_pulses, of_spotlight;
  static_cast<void>(stripmap_image({&level_ground, of_strip.field()}, radar, long_area, settings));
  static_cast<void>(phase_history({&level_ground, of_pulses.field()}, radar, long_area, settings));
  static_cast<void>(range_doppler_image({&level_ground, of_spotlight.field()}, radar, long_area, settings));
  EXPECT_NEAR(of_strip.least_rad(), pi, 1e-9);
  EXPECT_NEAR(of_pulses.least_rad(), pi, 1e-9);
  EXPECT_LT(of_spotlight.least_rad(), pi - 0.6);
}

/// 20° ahead of abeam; over the middle it passes when the platform is 600 m · tan 20° short of it.
TEST(Strip, LooksWhereItsAntennaIsFixed) {
  radar::Radar radar = looking_north(radar::Mode::Stripmap);
  radar.position = {0.0, -600.0, 300.0};
  radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = radians_from_deg(20.0)};
  const CoherentSettings settings{
      .interval_s = 0.002, .along_resolution_m = 2.0, .scatterer_spacing_m = 20.0, .threads = 1};
  Asked of_strip, of_pulses;
  const auto strip = stripmap_image({&level_ground, of_strip.field()}, radar, small_area, settings);
  static_cast<void>(phase_history({&level_ground, of_pulses.field()}, radar, small_area, settings));
  EXPECT_NEAR(of_strip.least_rad(), radians_from_deg(160.0), 1e-9);
  EXPECT_NEAR(of_pulses.least_rad(), radians_from_deg(160.0), 1e-9);
  const Vec3d way{600.0 * std::tan(radians_from_deg(20.0)), 600.0, -300.0};
  EXPECT_NEAR(strip.squint_rad, std::asin(way.x / length(way)), 1e-9);
}

/// A tower stands before the target as seen from the place at time zero, 200 m along, and beside it as the beam passes.
TEST(Strip, SeesTargetsAsItsBeamPassesThem) {
  terrain::HeightField terrain{
      .west_m = -300.0, .north_m = 100.0, .spacing_m = 2.0, .height_m = Array2D<float>(301, 101, 0.0F)};
  for (std::size_t row = 48; row <= 52; ++row)
    for (std::size_t column = 245; column <= 248; ++column) terrain.height_m(column, row) = 25.0F;
  radar::Radar radar = looking_north(radar::Mode::Stripmap);
  radar.position = {0.0, -600.0, 300.0};
  radar.processing.ambiguities = false;
  radar::Target bright;
  bright.track = radar::Track::straight({200.0, 20.0, 1.0});
  bright.rcs_m2 = radar::Channels{1e6F, 1e6F, 0.0F, 1e6F};
  const std::vector<radar::Target> targets{bright};
  const CoherentScene scene{&terrain, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }, targets};
  ASSERT_EQ(part_seen({terrain}, radar.position, {200.0, 20.0, 1.0}), 0.0);
  const auto image = stripmap_image(scene, radar, {-250.0, -50.0, 250.0, 50.0}, {.along_resolution_m = 2.0});
  float best = 0.0F;
  for (const auto& bin : image.amplitude_m.values()) best = std::max(best, std::norm(bin.vv));
  EXPECT_NEAR(db_from_linear(static_cast<double>(best)), 60.0, 1.5);
}

/// Half a beam off the axis is half the power, out and back.
TEST(Volts, KnowWhereAnAntennaIsFixed) {
  for (const radar::Mode mode : {radar::Mode::RealBeam, radar::Mode::DopplerBeamSharpening, radar::Mode::Stripmap}) {
    radar::Radar radar = looking_north(mode);
    const double on_axis_db = brightest_db(radar);
    radar.scan = {.kind = radar::ScanKind::Fixed};
    EXPECT_NEAR(brightest_db(radar), on_axis_db, 1e-3);
    radar.scan.azimuth_rad = 0.0;
    EXPECT_NEAR(brightest_db(radar), on_axis_db, 1e-3);
    radar.scan.azimuth_rad = radians_from_deg(1.0);
    EXPECT_NEAR(brightest_db(radar) - on_axis_db, -6.02, 0.05);
    radar.scan.azimuth_rad = radians_from_deg(359.0);
    EXPECT_NEAR(brightest_db(radar) - on_axis_db, -6.02, 0.05);
  }
}

/// A spotlight is the beam that is steered, and a scan that moves is taken to have come to the middle.
TEST(Volts, FollowTheMiddleOtherwise) {
  radar::Radar radar = looking_north(radar::Mode::Spotlight);
  const double on_axis_db = brightest_db(radar);
  radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = radians_from_deg(1.0)};
  EXPECT_NEAR(brightest_db(radar), on_axis_db, 1e-3);
  radar.mode = radar::Mode::RealBeam;
  radar.scan.kind = radar::ScanKind::Rotating;
  EXPECT_NEAR(brightest_db(radar), on_axis_db, 1e-3);
}

/// The powers of the brightest samples of the first pulses after time zero, in dB, and where the beam then points.
struct Heard {
  std::vector<double> decibels, azimuths_deg;
};

Heard heard_while_scanning(const radar::Scan& scan, double interval_s, double moment_s = 0.0) {
  radar::Radar radar = looking_north(radar::Mode::RealBeam);
  radar.velocity_mps = {};
  radar.waveform.pulse_repetition_hz = 30.0;
  radar.scan = scan;
  const auto history = pulses_of(radar, {.interval_s = interval_s, .moment_s = moment_s, .calibrated = true});
  Heard heard;
  for (std::size_t n = history.samples.rows() / 2; n < history.samples.rows(); ++n) {
    float best = 0.0F;
    for (const auto& sample : history.samples.row(n)) best = std::max(best, std::norm(sample.vv));
    heard.decibels.push_back(db_from_linear(static_cast<double>(best)));
    heard.azimuths_deg.push_back(
        deg_from_radians(std::remainder(history.pulses[n].beam_azimuth_rad.value(), 2.0 * pi)));
  }
  return heard;
}

/// At 30°/s and 30 pulses a second a degree a pulse, half of the beam's width: 6.02 dB out and back by it, and four
/// times that by two. A sector of 4° is swept to its right end, back over the middle to the left one.
TEST(Volts, FollowARealBeamThatScans) {
  const radar::Scan sector{.kind = radar::ScanKind::Sector,
                           .sector_width_rad = radians_from_deg(4.0),
                           .rate_rad_per_s = radians_from_deg(30.0)};
  const Heard heard = heard_while_scanning(sector, 0.6);
  const std::vector<double> expected_deg{0.0, 1.0, 2.0, 1.0, 0.0, -1.0, -2.0, -1.0, 0.0};
  ASSERT_EQ(heard.azimuths_deg.size(), expected_deg.size());
  for (std::size_t n = 0; n < expected_deg.size(); ++n) {
    EXPECT_NEAR(heard.azimuths_deg[n], expected_deg[n], 1e-6) << n;
    EXPECT_NEAR(heard.decibels[n] - heard.decibels[0], -6.0206 * expected_deg[n] * expected_deg[n], 0.1) << n;
  }
}

/// Of a stated azimuth the scan goes on from recording to recording; else it comes to the middle in each of them.
TEST(Volts, HaveTheScanOfTheirMoment) {
  radar::Scan turning{.kind = radar::ScanKind::Rotating, .rate_rad_per_s = radians_from_deg(30.0)};
  EXPECT_NEAR(heard_while_scanning(turning, 0.2, 4.0).azimuths_deg.at(1), 1.0, 1e-6);
  turning.azimuth_rad = radians_from_deg(359.0);
  EXPECT_NEAR(heard_while_scanning(turning, 0.2).azimuths_deg.at(1), 0.0, 1e-6);
  EXPECT_NEAR(heard_while_scanning(turning, 0.2, 4.0).azimuths_deg.at(1), 120.0, 1e-6);
}

/// Where the axis of the beam points whose pattern is in them, if it keeps to a place or an azimuth.
TEST(Images, KnowWhereTheBeamPointsWhosePatternTheyKeep) {
  const CoherentScene scene{&level_ground, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }};
  constexpr radar::Rectangle eastern{50.0, -50.0, 150.0, 50.0};
  const auto image_of = [&](const radar::Radar& radar) {
    return range_doppler_image(scene, radar, eastern, {.interval_s = 0.002});
  };
  radar::Radar radar = looking_north(radar::Mode::Spotlight);
  const double to_middle_rad = std::atan2(100.0 - radar.position.x, -radar.position.y);
  EXPECT_FALSE(image_of(radar).beam_azimuth_rad);
  EXPECT_FALSE(beam_azimuth_rad(radar, eastern));
  radar.processing.antenna_pattern = true;
  EXPECT_NEAR(image_of(radar).beam_azimuth_rad.value(), to_middle_rad, 1e-12);
  EXPECT_EQ(image_of(radar).beam_azimuth_rad, beam_azimuth_rad(radar, eastern));
  radar.mode = radar::Mode::DopplerBeamSharpening;
  EXPECT_FALSE(image_of(radar).beam_azimuth_rad) << "a scanning beam passes over every place";
  radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = 0.25};
  EXPECT_EQ(image_of(radar).beam_azimuth_rad, 0.25);
  radar.mode = radar::Mode::Stripmap;
  EXPECT_EQ(stripmap_image(scene, radar, eastern, {.along_resolution_m = 4.0}).beam_azimuth_rad, 0.25);
  radar.scan = {};
  const auto strip = stripmap_image(scene, radar, eastern, {.along_resolution_m = 4.0});
  EXPECT_NEAR(strip.beam_azimuth_rad.value(), to_middle_rad, 1e-12);
  EXPECT_EQ(strip.beam_azimuth_rad, beam_azimuth_rad(radar, eastern));
}

TEST(Images, OfASectorThatIsNeverScannedAreRefused) {
  const CoherentScene scene{&level_ground, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }};
  constexpr radar::Rectangle eastern{50.0, -50.0, 150.0, 50.0};
  radar::Radar radar = looking_north(radar::Mode::DopplerBeamSharpening);
  const auto fault_of = [&](double azimuth_rad) {
    radar.scan = {.kind = radar::ScanKind::Sector, .azimuth_rad = azimuth_rad, .sector_width_rad = 0.1};
    return message_of_error(
        [&] { static_cast<void>(range_doppler_image(scene, radar, eastern, {.interval_s = 0.002})); });
  };
  EXPECT_EQ(fault_of(0.0), "");
  EXPECT_THAT(fault_of(pi), ::testing::HasSubstr("never points to what is to be mapped"));
  radar.mode = radar::Mode::Spotlight;
  EXPECT_EQ(fault_of(pi), "");
}

/// Whatever the mode in the radar file, the beam of a strip passes over every place of it.
TEST(Strip, IsAsBrightAtItsEndsAsInItsMiddle) {
  const auto brightest_m2 = [&](radar::Mode mode, double east_m) {
    radar::Target bright;
    bright.track = radar::Track::straight({east_m, 0.0, 0.0});
    bright.rcs_m2 = radar::Channels{1e8F, 1e8F, 0.0F, 1e8F};
    const std::vector<radar::Target> targets{bright};
    const CoherentScene scene{&level_ground, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }, targets};
    radar::Radar radar = looking_north(mode);
    radar.processing.antenna_pattern = true;
    radar.processing.ambiguities = false;
    const auto strip = stripmap_image(scene, radar, {-600.0, -50.0, 600.0, 50.0}, {.along_resolution_m = 4.0});
    float best = 0.0F;
    for (const auto& sample : strip.amplitude_m.values()) best = std::max(best, std::norm(sample.vv));
    return static_cast<double>(best);
  };
  const double at_its_end = brightest_m2(radar::Mode::Stripmap, 500.0);
  EXPECT_NEAR(db_from_linear(brightest_m2(radar::Mode::Spotlight, 500.0) / at_its_end), 0.0, 1e-3);
  EXPECT_NEAR(db_from_linear(at_its_end / brightest_m2(radar::Mode::Stripmap, 0.0)), 0.0, 0.5);
}

TEST(CoherentInterval, HoldsTwoPulsesAtLeast) {
  const radar::Radar radar = looking_north(radar::Mode::RealBeam);
  EXPECT_EQ(pulses_of(radar, {.interval_s = 2.0 / 2000.0}).pulses.size(), 2U);
  const auto shorter = [&] { static_cast<void>(pulses_of(radar, {.interval_s = 0.0005})); };
  const std::string message = message_of_error(shorter);
  EXPECT_THAT(message, HasSubstr("of 0.0005 s is shorter than two pulses at a pulse repetition frequency of 2000 Hz"));
  EXPECT_THAT(message, HasSubstr("give at least 0.001 s"));
}

}  // namespace
}  // namespace sigmascape::simulate
