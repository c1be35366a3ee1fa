#include "sigmascape/simulate/map_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/range_ambiguity.h"

namespace sigmascape::simulate {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr radar::Rectangle extent{-500, -500, 500, 500};

/// Of a radar that nothing else is said about.
std::vector<std::string> warnings_of_area(const std::optional<radar::Rectangle>& area) {
  const terrain::HeightField terrain{-500, 500, 1000, Array2D<float>(2, 2, 0.0F)};
  radar::Radar radar{.range_resolution_m = 10.0,
                     .beam_width_rad = 0.01,
                     .waveform = {.pulse_length_s = 1e-7, .pulse_repetition_hz = 1000.0}};
  radar.position = {0, -20e3, 3e3};
  return map_warnings(radar, {.area = area, .cell_m = 10.0}, terrain, extent);
}

TEST(MapWarnings, NameTheSidesOnWhichAnAreaIsCutOff) {
  EXPECT_THAT(warnings_of_area(radar::Rectangle{-500, -620, 300, 540}),
              ElementsAre("the map's area reaches beyond the scene, 120 m in the south and 40 m in the north, and is "
                          "cut off there; 80 x 100 cells of it are left"));
  EXPECT_THAT(warnings_of_area(radar::Rectangle{-510, -100, 510, 100}),
              ElementsAre(::testing::StartsWith("the map's area reaches beyond the scene, 10 m in the west and 10 m in "
                                                "the east")));
}

TEST(MapWarnings, AreNoneWhereNoCellIsMissing) {
  EXPECT_THAT(warnings_of_area(std::nullopt), IsEmpty());
  EXPECT_THAT(warnings_of_area(extent), IsEmpty());
  EXPECT_THAT(warnings_of_area(radar::Rectangle{-505, -505, 505, 505}), IsEmpty());
}

/// 3 km high and 20 km to the south of what is mapped, which lies 8.3° to 8.7° below the horizon.
radar::Radar with_elevation_beam(double tilt_deg) {
  radar::Radar radar{.range_resolution_m = 10.0,
                     .beam_width_rad = 0.01,
                     .waveform = {.pulse_length_s = 1e-7, .pulse_repetition_hz = 1000.0}};
  radar.position = {0, -20e3, 3e3};
  radar.antenna.elevation = radar::GaussianBeam{};
  radar.antenna.elevation_width_rad = radians_from_deg(3.0);
  radar.antenna.tilt_rad = radians_from_deg(tilt_deg);
  return radar;
}

const terrain::HeightField terrain_of_extent{-500, 500, 1000, Array2D<float>(2, 2, 0.0F)};

TEST(MapWarnings, TellOfABeamThatPointsOverTheMap) {
  const auto warnings = [&](const radar::Radar& radar) {
    return map_warnings(radar, {.area = std::nullopt, .cell_m = 10.0}, terrain_of_extent, extent);
  };
  EXPECT_THAT(warnings(with_elevation_beam(-8.5)), IsEmpty());
  EXPECT_THAT(warnings(with_elevation_beam(-6.0)), IsEmpty()) << "−14 dB both ways";
  EXPECT_THAT(
      warnings(with_elevation_beam(0.0)),
      ElementsAre(::testing::AllOf(::testing::StartsWith("the beam points to an elevation of 0° (antenna.tilt_deg), "
                                                         "and what is mapped lies at -8.75° to -8.32°"),
                                   // 2 · 12.04 dB (8.32°/3°)²
                                   ::testing::EndsWith("at least 185 dB weaker than at its peak"))));
}

TEST(MapWarnings, TellOfAFixedBeamThatPointsBesideTheMap) {
  radar::Radar radar = with_elevation_beam(-8.5);
  radar.mode = radar::Mode::DopplerBeamSharpening;
  radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = radians_from_deg(1.0)};
  EXPECT_THAT(map_warnings(radar, {.area = std::nullopt, .cell_m = 10.0}, terrain_of_extent, extent), IsEmpty());
  radar.scan.azimuth_rad = radians_from_deg(90.0);
  EXPECT_THAT(
      map_warnings(radar, {.area = std::nullopt, .cell_m = 10.0}, terrain_of_extent, extent),
      ElementsAre(::testing::StartsWith("the beam points to 90° (scan.azimuth_deg), and what is mapped lies -91")));
}

// Seen from 75° above 6 m of beam along the line of sight are 1.6 m on the ground; 2 m of pulse at 65° are 4.7 m.
TEST(MapWarnings, MeasureBeamAndPulseOnTheGround) {
  const auto warnings = [&](double elevation_deg, double beam_rad, double pulse_m, double cell_m) {
    radar::Radar radar{.range_resolution_m = pulse_m,
                       .beam_width_rad = beam_rad,
                       .waveform = {.pulse_length_s = 1e-7, .pulse_repetition_hz = 1000.0}};
    radar.position = radar::position_seeing({0, 0, 0}, 0.0, radians_from_deg(elevation_deg), 10e3);
    return map_warnings(radar, {.area = radar::Rectangle{-100, -100, 100, 100}, .cell_m = cell_m}, terrain_of_extent,
                        extent);
  };
  EXPECT_THAT(warnings(75.0, 8.6e-4, 10.0, 6.0), ElementsAre(::testing::StartsWith("the beam of 1.51 m")));
  EXPECT_THAT(warnings(15.0, 8.6e-4, 10.0, 6.0), IsEmpty());
  EXPECT_THAT(warnings(75.0, 8.6e-4, 40.0, 6.0), ElementsAre(::testing::StartsWith("the beam of 1.51 m")));
  EXPECT_THAT(warnings(88.0, 0.5, 8.0, 4.0), IsEmpty());
  EXPECT_THAT(warnings(65.0, 0.02, 2.0, 4.0), IsEmpty());
  EXPECT_THAT(warnings(15.0, 0.02, 2.0, 4.0), ElementsAre(::testing::StartsWith("the pulse of 2.0")));
}

// 900 km away under 40° the ground is 21 km farther on a sphere than on a plane.
TEST(MapWarnings, KnowTheEarthThatPulsesDo) {
  radar::Radar radar = with_elevation_beam(-40.0);
  radar.antenna.elevation = {};
  radar.waveform.pulse_repetition_hz = 3000.0;
  radar.mode = radar::Mode::Spotlight;
  radar.earth_refraction = 1.0;
  radar.position = radar::position_seeing({0, 0, 0}, 0.0, radians_from_deg(40.0), 900e3, radar::earth_of(radar));
  radar.receiver.first_range_m = 898e3;
  radar.receiver.last_range_m = 902e3;
  EXPECT_THAT(map_warnings(radar, {.area = std::nullopt, .cell_m = 10.0}, terrain_of_extent, extent),
              Each(::testing::Not(::testing::HasSubstr("holds nothing"))));
  radar::Target target;
  target.track = radar::Track::straight({0.0, 0.0, 1.0});
  const std::vector<radar::Target> targets{target};
  EXPECT_THAT(recording_warnings(radar, extent, terrain_of_extent, false, targets),
              Each(::testing::Not(::testing::HasSubstr("targets"))));
}

/// Pulses have no cells: the beam of 28 m is narrower than those of 100 m, and the cut side is told all the same.
TEST(AreaWarnings, SayNothingOfCells) {
  const radar::Radar radar = with_elevation_beam(-8.5);
  const radar::MapRequest request{.area = radar::Rectangle{-500, -500, 500, 700}, .cell_m = 100.0};
  const auto of_map = map_warnings(radar, request, terrain_of_extent, extent);
  EXPECT_THAT(of_map, ElementsAre(::testing::HasSubstr("narrower than the map's cells of 100 m"),
                                  ::testing::HasSubstr("200 m in the north")));
  EXPECT_THAT(area_warnings(radar, request, terrain_of_extent, extent), ElementsAre(of_map.back()));
}

/// The area is 2.9° wide; the sector is swept from its middle to the right.
TEST(RecordingWarnings, TellOfAScanThatIsElsewhere) {
  radar::Radar radar = with_elevation_beam(-8.5);
  const auto told = [&](std::optional<double> azimuth_deg, double interval_s, double moment_s) {
    radar.scan = {.kind = radar::ScanKind::Sector,
                  .sector_width_rad = radians_from_deg(40.0),
                  .rate_rad_per_s = radians_from_deg(30.0)};
    if (azimuth_deg) radar.scan.azimuth_rad = radians_from_deg(*azimuth_deg);
    return scan_beside(radar, extent, interval_s, moment_s);
  };
  EXPECT_FALSE(told(std::nullopt, 0.1, 0.5));
  EXPECT_FALSE(told(0.0, 0.1, 0.0));
  EXPECT_THAT(told(0.0, 0.1, 0.5).value(), ::testing::StartsWith("the beam scans elsewhere, 15° in the middle"));
  EXPECT_FALSE(told(0.0, 1.0, 0.5)) << "at 0 s it points to the middle";
  EXPECT_FALSE(told(-15.0, 0.1, 0.5));
  radar.mode = radar::Mode::Spotlight;
  EXPECT_FALSE(told(0.0, 0.1, 0.5));
}

TEST(RecordingWarnings, TellOfWhatIsNotInThePulses) {
  radar::Radar radar = with_elevation_beam(-8.5);
  const auto told = [&](bool calibrated) { return recording_warnings(radar, extent, terrain_of_extent, calibrated); };
  EXPECT_THAT(told(true), IsEmpty());
  radar.beam_width_rad = 0.1;  // 0.1/√2 both ways, of 20 km
  EXPECT_THAT(told(false), IsEmpty());
  EXPECT_THAT(told(true), ElementsAre(::testing::StartsWith("the beam is 1414 m wide where what is mapped is 1000 m")));
  radar.receiver.first_range_m = 15e3;
  EXPECT_THAT(told(false), ElementsAre(::testing::StartsWith("the range gate from 15 to 20.")));
}

/// 20.2 km away, the area folds by 15 km at 10 kHz: a gate of 4.7 to 5.8 km is as long as its echoes, one from 3 km
/// not.
TEST(RecordingWarnings, KnowIntoWhichGateEchoesFold) {
  radar::Radar radar = with_elevation_beam(-8.5);
  radar.waveform.pulse_repetition_hz = 10e3;
  radar.receiver.first_range_m = 4.7e3;
  radar.receiver.last_range_m = 5.8e3;
  EXPECT_THAT(recording_warnings(radar, extent, terrain_of_extent, false), IsEmpty());
  radar.receiver.first_range_m = 3e3;
  EXPECT_THAT(recording_warnings(radar, extent, terrain_of_extent, false),
              ElementsAre(::testing::AllOf(::testing::StartsWith("the range gate from 3 to 5.8 km is wider"),
                                           ::testing::HasSubstr("km away and folded to 4.67"))));
}

/// 2v/λ · 1000 m/20 km are 667 Hz at 3 cm; a beam of 0.01 rad, two-way 0.0071, has 94 of them.
TEST(RecordingWarnings, TellOfDopplerThatFolds) {
  radar::Radar radar = with_elevation_beam(-8.5);
  radar.frequency_hz = speed_of_light_mps / 0.03;
  radar.velocity_mps = {200.0, 0.0, 0.0};
  const auto told = [&](double prf_hz, bool calibrated) {
    radar.waveform.pulse_repetition_hz = prf_hz;
    return recording_warnings(radar, extent, terrain_of_extent, calibrated);
  };
  EXPECT_THAT(told(700.0, false), IsEmpty());
  EXPECT_THAT(told(600.0, false), ElementsAre(::testing::HasSubstr("and folds over")));
  EXPECT_THAT(told(600.0, true), IsEmpty());
  EXPECT_THAT(told(90.0, true),
              ElementsAre(::testing::HasSubstr("Hz, more than the pulse repetition frequency of 90 Hz")));
  radar.velocity_mps = {};
  EXPECT_THAT(told(90.0, false), IsEmpty());
}

TEST(RecordingWarnings, TellOfTargetsOutsideTheGate) {
  radar::Radar radar = with_elevation_beam(-8.5);
  radar.waveform.pulse_repetition_hz = 1000.0;
  const auto told = [&](Vec3d place) {
    radar::Target target;
    target.name = "lone";
    target.track = radar::Track::straight(place);
    const std::vector<radar::Target> targets{target};
    return recording_warnings(radar, extent, terrain_of_extent, false, targets);
  };
  EXPECT_THAT(told({0.0, 0.0, 10.0}), IsEmpty());
  const Vec3d before = radar.position * 0.5;
  EXPECT_THAT(told(before),
              ElementsAre(::testing::StartsWith("of 1 targets 1 (lone) answers from outside the range gate")));
  // An ambiguous range behind what is mapped.
  const Vec3d away = normalized(Vec3d{} - radar.position);
  EXPECT_THAT(told(away * radar::unambiguous_range_m(1000.0)), IsEmpty());
}

TEST(MapWarnings, RefuseAnAreaOutside) {
  EXPECT_THROW(static_cast<void>(warnings_of_area(radar::Rectangle{600, 600, 700, 700})), Error);
}

}  // namespace
}  // namespace sigmascape::simulate
