#include "sigmascape/radar/radar_file.h"

#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

#include "scratch_folder.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/radar/radar_warnings.h"

namespace sigmascape::radar {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

const std::string radar_section = "[radar]\nfrequency_ghz = 9.6\nrange_resolution_m = 3.0\nbeam_width_deg = 0.01\n";
const std::string position_section = "[position]\nazimuth_deg = 130\nelevation_deg = 13\nslant_range_km = 20\n";

class RadarFileTest : public ::testing::Test {
 protected:
  [[nodiscard]] RadarFile read(const std::string& text) const { return read_radar_file(folder_.write("x.toml", text)); }
  /// The message that a file is refused with, without the folder.
  [[nodiscard]] std::string fault_of(const std::string& text) const {
    const std::string message = message_of_error([&] { static_cast<void>(read(text)); });
    const std::string file = folder_.path("x.toml").string();
    EXPECT_EQ(message.substr(0, file.size()), file);
    return message.size() > file.size() ? message.substr(file.size()) : message;
  }
  ScratchFolder folder_;
};

TEST_F(RadarFileTest, ReadsEveryKey) {
  const RadarFile file = read(
      "[radar]\nname = \"a\"\nfrequency_ghz = 35.0\npolarization = \"sum\"\nrange_resolution_m = 0.5\nbeam_width_deg = "
      "0.5\n" +
      position_section + "target_east_m = 10\ntarget_north_m = -20\n" +
      "[map]\ncell_m = 4\nwest_m = -100\nsouth_m = -200\neast_m = 300\nnorth_m = 400\n");
  EXPECT_EQ(file.radar.name, "a");
  EXPECT_DOUBLE_EQ(file.radar.frequency_hz, 35e9);
  EXPECT_EQ(file.radar.polarization, Polarization::Sum);
  EXPECT_EQ(file.radar.range_resolution_m, 0.5);
  EXPECT_DOUBLE_EQ(file.radar.beam_width_rad, radians_from_deg(0.5));
  const auto& seen = std::get<SeenFrom>(file.place);
  EXPECT_DOUBLE_EQ(seen.azimuth_rad, radians_from_deg(130.0));
  EXPECT_DOUBLE_EQ(seen.elevation_rad, radians_from_deg(13.0));
  EXPECT_EQ(seen.slant_range_m, 20e3);
  EXPECT_EQ(seen.target, (Vec2d{10.0, -20.0}));
  EXPECT_EQ(file.map.cell_m, 4.0);
  EXPECT_EQ(file.map.area, (Rectangle{-100.0, -200.0, 300.0, 400.0}));
}

TEST_F(RadarFileTest, LeavesOutWhatHasADefault) {
  const RadarFile file = read(radar_section + position_section);
  EXPECT_EQ(file.radar.name, "radar");
  EXPECT_EQ(file.radar.polarization, Polarization::VV);
  EXPECT_FALSE(std::get<SeenFrom>(file.place).target.has_value());
  EXPECT_FALSE(file.map.area.has_value());
  EXPECT_EQ(file.map.cell_m, 2.0);
}

TEST_F(RadarFileTest, ReadsTheOtherPlaces) {
  const auto local = read(radar_section + "[position]\neast_m = 1\nnorth_m = 2\naltitude_m = 3000\n").place;
  EXPECT_EQ(std::get<LocalPlace>(local).position, (Vec3d{1, 2, 3000}));
  const auto earth =
      read(radar_section + "[position]\nlatitude_deg = 43.2\nlongitude_deg = -2.9\naltitude_m = 9000\n").place;
  EXPECT_EQ(std::get<GeographicPlace>(earth).latitude_deg, 43.2);
  EXPECT_EQ(std::get<GeographicPlace>(earth).longitude_deg, -2.9);
  EXPECT_EQ(std::get<GeographicPlace>(earth).altitude_m, 9000.0);
}

// The shore of the Dead Sea lies 430 m below sea level, and radars stand on it.
TEST_F(RadarFileTest, RadarsMayStandInADepression) {
  const auto local = read(radar_section + "[position]\neast_m = 1\nnorth_m = 2\naltitude_m = -380\n").place;
  EXPECT_EQ(std::get<LocalPlace>(local).position.z, -380.0);
  const auto earth =
      read(radar_section + "[position]\nlatitude_deg = 31.5\nlongitude_deg = 35.5\naltitude_m = -380\n").place;
  EXPECT_EQ(std::get<GeographicPlace>(earth).altitude_m, -380.0);
}

TEST_F(RadarFileTest, MissingSectionsAreNamed) {
  EXPECT_EQ(fault_of(position_section), ": radar: is missing; add a [radar] section");
  EXPECT_EQ(fault_of(radar_section), ": position: is missing; add a [position] section");
  EXPECT_THAT(fault_of(radar_section + "[position]\n"), HasSubstr(": position: does not say where the radar stands"));
}

TEST_F(RadarFileTest, WhoPlacesTheRadarElsewhereNeedsNoPosition) {
  const auto without = folder_.write("x.toml", radar_section);
  EXPECT_DOUBLE_EQ(read_radar_file(without, PlaceOfRadar::Optional).radar.frequency_hz, 9.6e9);
  const auto wrong = folder_.write("x.toml", radar_section + "[position]\naltitude_m = -3\n");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_radar_file(wrong, PlaceOfRadar::Optional)); }),
              HasSubstr("position.east_m: is missing"));
}

TEST_F(RadarFileTest, KeysOfAnotherShapeSayWhichShapeTheyAreOf) {
  const auto antenna = [&](const std::string& key) {
    return fault_of(radar_section + position_section + "[antenna]\n" + key + "\n");
  };
  EXPECT_EQ(antenna("azimuth_csv = \"beam.csv\""),
            ": antenna.azimuth_csv: means nothing where azimuth_shape is \"gaussian\"; leave it out, or state "
            "azimuth_shape = \"table\"");
  EXPECT_THAT(antenna("azimuth_taylor_terms = 4"), EndsWith("state azimuth_shape = \"taylor\""));
  EXPECT_THAT(antenna("steepest_depression_deg = 40"), EndsWith("state elevation_shape = \"cosecant-squared\""));
  EXPECT_THAT(fault_of(radar_section + position_section + "[waveform]\nwindow = \"cosine\"\nside_lobe_db = -30\n"),
              HasSubstr(": waveform.side_lobe_db: means nothing where window is \"cosine\""));
}

TEST_F(RadarFileTest, KeysOfWhatIsNotStatedSayWhatTheyBelongTo) {
  const auto fault = [&](const std::string& section) { return fault_of(radar_section + position_section + section); };
  EXPECT_EQ(fault("[receiver]\nadc_full_scale_v = 2\n"),
            ": receiver.adc_full_scale_v: means nothing where adc_bits is not stated; leave it out, or state adc_bits");
  EXPECT_EQ(fault("[receiver]\nstc_exponent = 2\n"),
            ": receiver.stc_exponent: means nothing where stc_full_gain_range_km is not stated; leave it out, or state "
            "stc_full_gain_range_km");
  for (const std::string shape : {"even", "table"}) {
    EXPECT_EQ(fault("[antenna]\nelevation_shape = \"" + shape + "\"\nelevation_width_deg = 3\n"),
              ": antenna.elevation_width_deg: means nothing where elevation_shape is \"" + shape +
                  "\"; leave it out, or state another elevation_shape");
  }
  EXPECT_THAT(fault("[antenna]\nelevation_width_deg = 3\n"), HasSubstr("means nothing where elevation_shape is"));
  EXPECT_EQ(fault("[scan]\nrate_deg_per_s = 90\nsector_deg = 60\n"),
            ": scan.sector_deg: means nothing where kind is \"rotating\"; leave it out, or state kind = \"sector\"");
  EXPECT_EQ(fault("[scan]\nkind = \"fixed\"\nrate_deg_per_s = 90\n"),
            ": scan.rate_deg_per_s: means nothing where kind is \"fixed\"; leave it out, or state another kind");
}

TEST_F(RadarFileTest, MissingKeysAreNamed) {
  EXPECT_EQ(fault_of("[radar]\nrange_resolution_m = 3.0\nbeam_width_deg = 0.01\n" + position_section),
            ": radar.frequency_ghz: is missing; give a number from 0.1 to 300 GHz");
  EXPECT_EQ(fault_of(radar_section + "[position]\nazimuth_deg = 130\nelevation_deg = 13\n"),
            ": position.slant_range_km: is missing; give a number from 0.1 to 1000 km");
  EXPECT_EQ(fault_of(radar_section + "[position]\nlongitude_deg = 3\naltitude_m = 1000\n"),
            ": position.latitude_deg: is missing; give a number from -90 to 90 degrees");
  EXPECT_THAT(fault_of(radar_section + position_section + "[map]\nwest_m = 0\n"),
              HasSubstr(": map.south_m: is missing;"));
}

TEST_F(RadarFileTest, UnknownKeysComeWithAHint) {
  EXPECT_EQ(fault_of(radar_section + "polarisation = \"hh\"\n" + position_section),
            ": radar.polarisation: is not a known key; did you mean polarization?");
  EXPECT_EQ(fault_of(radar_section + position_section + "[mapp]\ncell_m = 1\n"),
            ": mapp: is not a known key; did you mean map?");
  EXPECT_THAT(fault_of(radar_section + position_section + "[map]\ncells_m = 1\n"), EndsWith("did you mean cell_m?"));
}

TEST_F(RadarFileTest, TwoKindsOfPlaceAreRefused) {
  EXPECT_EQ(fault_of(radar_section + position_section + "east_m = 10\n"),
            ": position.east_m: means nothing where azimuth_deg says where the radar stands; leave it out, or give "
            "azimuth_deg, elevation_deg and slant_range_km, or altitude_m with latitude_deg and longitude_deg, or "
            "altitude_m with east_m and north_m");
  for (const std::string key : {"latitude_deg", "longitude_deg", "north_m", "altitude_m"}) {
    EXPECT_THAT(fault_of(radar_section + position_section + key + " = 43\n"),
                HasSubstr(": position." + key + ": means nothing where azimuth_deg says where the radar stands"));
  }
  const std::string height = radar_section + "[position]\naltitude_m = 1000\n";
  EXPECT_THAT(fault_of(height + "longitude_deg = 1\nlatitude_deg = 43\nnorth_m = 0\n"),
              HasSubstr(": position.north_m: means nothing where latitude_deg says where the radar stands"));
  EXPECT_THAT(fault_of(height + "north_m = 1\neast_m = 43\ntarget_east_m = 0\n"),
              HasSubstr(": position.target_east_m: means nothing where east_m says where the radar stands"));
}

TEST_F(RadarFileTest, OutOfRangeNamesTheUnit) {
  EXPECT_EQ(
      fault_of("[radar]\nfrequency_ghz = 9.6e9\nrange_resolution_m = 3.0\nbeam_width_deg = 0.01\n" + position_section),
      ": radar.frequency_ghz: is 9.6e+09; give a number from 0.1 to 300 GHz");
  EXPECT_EQ(fault_of(radar_section + "[position]\nazimuth_deg = 130\nelevation_deg = 0\nslant_range_km = 20\n"),
            ": position.elevation_deg: is 0; give a number from 0.5 to 89 degrees");
  EXPECT_EQ(fault_of(radar_section + "[position]\neast_m = 0\nnorth_m = 0\naltitude_m = -501\n"),
            ": position.altitude_m: is -501; give a number from -500 to 1e+06 m above mean sea level");
  EXPECT_THAT(fault_of(radar_section + position_section + "[map]\ncell_m = 0\n"), HasSubstr(": map.cell_m: is 0;"));
}

TEST_F(RadarFileTest, UnknownPolarizationListsTheChoices) {
  EXPECT_EQ(fault_of(radar_section + "polarization = \"VV\"\n" + position_section),
            ": radar.polarization: is \"VV\"; choose among vv, hh, hv, vh, sum");
}

TEST_F(RadarFileTest, HalfATargetIsRefused) {
  EXPECT_THAT(fault_of(radar_section + position_section + "target_east_m = 10\n"),
              ::testing::StartsWith(": position.target_north_m: is missing beside its partner; give both"));
  EXPECT_THAT(fault_of(radar_section + position_section + "target_north_m = 10\n"),
              ::testing::StartsWith(": position.target_east_m: is missing beside its partner; give both"));
}

TEST_F(RadarFileTest, AreaWithoutACellIsRefused) {
  const std::string area = radar_section + position_section + "[map]\ncell_m = 2\nsouth_m = 0\n";
  EXPECT_THAT(fault_of(area + "west_m = 10\neast_m = 0\nnorth_m = 10\n"), HasSubstr(": map.east_m: does not lie east"));
  EXPECT_THAT(fault_of(area + "west_m = 0\neast_m = 10\nnorth_m = 1\n"),
              HasSubstr(": map.north_m: does not lie north"));
}

TEST_F(RadarFileTest, NotAFileAndNotToml) {
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_radar_file(folder_.path("none.toml"))); }),
              HasSubstr("none.toml: the file does not exist"));
  EXPECT_THAT(fault_of("[radar\n"), ::testing::StartsWith(":1: is not TOML"));
}

/// The first ```toml block of docs/radar_file.md.
std::string documented_example() {
  std::ifstream file(std::string(SIGMASCAPE_SOURCE_DIR) + "/docs/radar_file.md");
  std::stringstream all;
  all << file.rdbuf();
  const std::string text = all.str(), fence = "```toml\n";
  const auto start = text.find(fence);
  if (start == std::string::npos) return "";
  return text.substr(start + fence.size(), text.find("```", start + fence.size()) - start - fence.size());
}

TEST_F(RadarFileTest, TheDocumentedExampleIsRead) {
  const RadarFile file = read(documented_example());
  EXPECT_DOUBLE_EQ(file.radar.frequency_hz, 10e9);
  EXPECT_EQ(file.radar.name, "side-looking X band");
  EXPECT_EQ(std::get<SeenFrom>(file.place).slant_range_m, 20e3);
}

const std::string simple = radar_section + position_section;
const std::string without_resolution = "[radar]\nfrequency_ghz = 9.6\nbeam_width_deg = 1.0\n" + position_section;

TEST_F(RadarFileTest, ReadsHowTheRadarIsMade) {
  const Radar radar =
      read(without_resolution +
           "[platform]\nspeed_mps = 100\nheading_deg = 80\ncourse_deg = 90\nclimb_mps = 5\n"
           "[antenna]\nazimuth_shape = \"taylor\"\nazimuth_side_lobe_db = -30\nazimuth_taylor_terms = 4\n"
           "elevation_shape = \"cosecant-squared\"\nelevation_width_deg = 4\ntilt_deg = -5\n"
           "steepest_depression_deg = 40\ngain_dbi = 33\nside_lobe_floor_db = -50\n"
           "[waveform]\nbandwidth_mhz = 10\nwindow = \"hamming\"\npeak_power_w = 5000\npulse_length_us = 2\n"
           "pulse_repetition_hz = 2000\n"
           "[receiver]\nlosses_db = 3\nnoise_figure_db = 4\ngain_db = 60\nimpedance_ohm = 75\nfirst_range_km = 10\n"
           "last_range_km = 30\nstc_full_gain_range_km = 25\nstc_exponent = 4\ndetector = \"log\"\n"
           "pulses_integrated = 8\nadc_bits = 10\nadc_full_scale_v = 2\n"
           "[scan]\nkind = \"sector\"\nazimuth_deg = 310\nsector_deg = 60\nrate_deg_per_s = 45\n"
           "[mode]\nkind = \"stripmap\"\n")
          .radar;
  EXPECT_NEAR(radar.velocity_mps.x, 100.0, 1e-9);
  EXPECT_NEAR(radar.velocity_mps.y, 0.0, 1e-9);
  EXPECT_EQ(radar.velocity_mps.z, 5.0);
  EXPECT_DOUBLE_EQ(radar.heading_rad, radians_from_deg(80.0));
  const Window taper = std::get<ApertureBeam>(radar.antenna.azimuth).taper;
  EXPECT_EQ(taper.shape, WindowShape::Taylor);
  EXPECT_DOUBLE_EQ(taper.taylor_side_lobe, 1e-3);
  EXPECT_EQ(taper.taylor_terms, 4);
  EXPECT_DOUBLE_EQ(std::get<CosecantSquaredBeam>(radar.antenna.elevation).steepest_depression_rad,
                   radians_from_deg(40.0));
  EXPECT_DOUBLE_EQ(radar.antenna.elevation_width_rad, radians_from_deg(4.0));
  EXPECT_DOUBLE_EQ(radar.antenna.tilt_rad, radians_from_deg(-5.0));
  EXPECT_DOUBLE_EQ(radar.antenna.gain, linear_from_db(33.0));
  EXPECT_DOUBLE_EQ(radar.antenna.side_lobe_floor, 1e-5);
  EXPECT_EQ(radar.waveform.window.shape, WindowShape::Hamming);
  EXPECT_NEAR(radar.range_resolution_m, 1.303 * 299.792458 / 20.0, 1e-3);
  EXPECT_EQ(radar.waveform.peak_power_w, 5000.0);
  EXPECT_DOUBLE_EQ(radar.waveform.pulse_length_s, 2e-6);
  EXPECT_EQ(radar.waveform.pulse_repetition_hz, 2000.0);
  const Receiver& receiver = radar.receiver;
  EXPECT_DOUBLE_EQ(receiver.losses, linear_from_db(3.0));
  EXPECT_DOUBLE_EQ(receiver.noise_figure, linear_from_db(4.0));
  EXPECT_DOUBLE_EQ(receiver.gain, 1e6);
  EXPECT_EQ(receiver.impedance_ohm, 75.0);
  EXPECT_EQ(receiver.first_range_m, 10e3);
  EXPECT_EQ(receiver.last_range_m, 30e3);
  EXPECT_EQ(receiver.sensitivity_time_control->full_gain_range_m, 25e3);
  EXPECT_EQ(receiver.sensitivity_time_control->exponent, 4.0);
  EXPECT_EQ(receiver.detector, Detector::Log);
  EXPECT_EQ(receiver.pulses_integrated, 8);
  EXPECT_EQ(receiver.analog_to_digital->bits, 10);
  EXPECT_EQ(receiver.analog_to_digital->full_scale_v, 2.0);
  EXPECT_EQ(radar.scan.kind, ScanKind::Sector);
  EXPECT_DOUBLE_EQ(*radar.scan.azimuth_rad, radians_from_deg(310.0));
  EXPECT_DOUBLE_EQ(radar.scan.sector_width_rad, radians_from_deg(60.0));
  EXPECT_DOUBLE_EQ(radar.scan.rate_rad_per_s, radians_from_deg(45.0));
  EXPECT_EQ(radar.mode, Mode::Stripmap);
}

TEST_F(RadarFileTest, TakesTheWidthOfAMeasuredBeam) {
  folder_.write("cut.csv", "offset_deg,gain_db\n-4,10\n-2,26.98970004336\n0,30\n2,26.98970004336\n4,10\n");
  const Radar radar = read("[radar]\nfrequency_ghz = 9.6\nrange_resolution_m = 3\n" + position_section +
                           "[antenna]\nazimuth_shape = \"table\"\nazimuth_csv = \"cut.csv\"\n")
                          .radar;
  EXPECT_NEAR(deg_from_radians(radar.beam_width_rad), 4.0, 1e-6);
  EXPECT_THAT(fault_of(simple + "[antenna]\nazimuth_shape = \"table\"\nazimuth_csv = \"cut.csv\"\n"),
              HasSubstr(": antenna.azimuth_csv: and radar.beam_width_deg both give the beam its width"));
}

// Whether the file has a beam_width_deg or not: neither having it nor leaving it out would help.
TEST_F(RadarFileTest, AMeasuredBeamWithoutItsTableLacksTheTable) {
  const std::string lacking = "[antenna]\nazimuth_shape = \"table\"\n", fault = ": antenna.azimuth_csv: is missing";
  EXPECT_THAT(fault_of(simple + lacking), ::testing::StartsWith(fault));
  EXPECT_THAT(fault_of("[radar]\nfrequency_ghz = 9.6\nrange_resolution_m = 3\n" + position_section + lacking),
              ::testing::StartsWith(fault));
}

// 500 m are some 0.4 MHz or 2.6 µs, and at 200 kHz a pulse may be 2.5 µs long.
TEST_F(RadarFileTest, RepetitionsThatLeaveNoTimeForTheShortestPulseAreRefused) {
  const auto with = [](const std::string& resolution_m, const std::string& waveform) {
    return "[radar]\nfrequency_ghz = 9.6\nbeam_width_deg = 1\nrange_resolution_m = " + resolution_m + "\n" +
           position_section + "[waveform]\n" + waveform;
  };
  for (const std::string pulse : {"", "pulse_length_us = 2.5\n", "pulse_length_us = 5\n"}) {
    const std::string fault = fault_of(with("500", "pulse_repetition_hz = 200000\n" + pulse));
    EXPECT_THAT(fault,
                AllOf(::testing::StartsWith(": waveform.pulse_repetition_hz: is 200000, at which the shortest pulse"),
                      HasSubstr("give at most "), HasSubstr("or a radar.range_resolution_m of at most ")));
    // What is advised does.
    const auto advised_after = [&](const std::string& words) {
      return fmt::format("{}", std::stod(fault.substr(fault.find(words) + words.size())));
    };
    const std::string repetition_hz = advised_after("give at most "),
                      resolution_m = advised_after("a radar.range_resolution_m of at most ");
    EXPECT_NO_THROW(static_cast<void>(read(with("500", "pulse_repetition_hz = " + repetition_hz + "\n"))));
    EXPECT_NO_THROW(static_cast<void>(read(with(resolution_m, "pulse_repetition_hz = 200000\n"))));
  }
  EXPECT_THAT(fault_of(without_resolution + "[waveform]\nbandwidth_mhz = 0.3\npulse_repetition_hz = 200000\n"),
              HasSubstr("3.33333 µs, leaves the receiver less than half of the time between pulses; give at most "
                        "150000, or a bandwidth_mhz of at least 0.4"));
}

TEST_F(RadarFileTest, BadWaveformsAreRefused) {
  EXPECT_THAT(fault_of(without_resolution + "[waveform]\nbandwidth_mhz = -10\n"),
              HasSubstr(": waveform.bandwidth_mhz: is -10; give a number from 0.001 to 20000 MHz"));
  EXPECT_THAT(fault_of(without_resolution + "[waveform]\nwindow = \"taylor\"\n"),
              HasSubstr(": radar.range_resolution_m: is missing;"));
  EXPECT_THAT(fault_of(simple + "[waveform]\nbandwidth_mhz = 10\n"),
              HasSubstr(": waveform.bandwidth_mhz: and radar.range_resolution_m say the same thing"));
  EXPECT_THAT(fault_of(without_resolution + "[waveform]\nbandwidth_mhz = 10\npulse_length_us = 0.05\n"),
              HasSubstr(": waveform.pulse_length_us: is 0.05, too short a pulse to have its bandwidth of 10 MHz"));
  EXPECT_THAT(fault_of(simple + "[waveform]\npulse_length_us = 600\npulse_repetition_hz = 1000\n"),
              HasSubstr("give at most 500"));
  EXPECT_THAT(fault_of(simple + "[waveform]\nwindow = \"kaiser\"\n"), HasSubstr("choose among rectangular"));
}

// Of windows over the band and over the aperture.
TEST_F(RadarFileTest, TaylorWindowsHoldTheSideLobesThatAreStated) {
  const auto terms = [&](const std::string& keys) {
    return read(simple + "[waveform]\n" + keys).radar.waveform.window.taylor_terms;
  };
  EXPECT_EQ(terms(""), 6);
  EXPECT_EQ(terms("side_lobe_db = -35\n"), 6);
  EXPECT_EQ(terms("side_lobe_db = -35\ntaylor_terms = 5\n"), 5);
  for (const int level_db : {-10, -50, -60, -80, -100}) {
    const Radar radar = read(simple + fmt::format("[waveform]\nside_lobe_db = {0}\n[antenna]\nazimuth_shape = "
                                                  "\"taylor\"\nazimuth_side_lobe_db = {0}\n",
                                                  level_db))
                            .radar;
    for (const Window& window : {radar.waveform.window, std::get<ApertureBeam>(radar.antenna.azimuth).taper})
      EXPECT_NEAR(db_from_linear(WindowResponse(window).peak_side_lobe()), level_db - 0.1, 0.11);
  }
  EXPECT_EQ(fault_of(simple + "[waveform]\nside_lobe_db = -80\ntaylor_terms = 6\n"),
            ": waveform.taylor_terms: is 6, too few to hold side lobes at -80 dB; give at least 15, or leave it out");
  EXPECT_EQ(terms("side_lobe_db = -80\ntaylor_terms = 15\n"), 15);
  EXPECT_THAT(
      fault_of(simple + "[antenna]\nelevation_shape = \"taylor\"\nelevation_width_deg = 5\n"
                        "elevation_side_lobe_db = -30\nelevation_taylor_terms = 2\n"),
      HasSubstr(": antenna.elevation_taylor_terms: is 2, too few to hold side lobes at -30 dB; give at least 3"));
}

// The lower edge of a band of 2 f is at the frequency zero.
TEST_F(RadarFileTest, BandsThatTheCarrierHasNoRoomForAreRefused) {
  const auto with = [](const std::string& resolution, const std::string& bandwidth) {
    return "[radar]\nfrequency_ghz = 0.3\nbeam_width_deg = 1.0\n" + resolution + position_section +
           "[waveform]\nwindow = \"rectangular\"\n" + bandwidth;
  };
  EXPECT_EQ(
      fault_of(with("", "bandwidth_mhz = 2000\n")),
      ": waveform.bandwidth_mhz: is 2000, a band about 0.3 GHz that reaches down to no frequency at all; give less "
      "than 600");
  EXPECT_THAT(fault_of(with("", "bandwidth_mhz = 600\n")), HasSubstr(": waveform.bandwidth_mhz: is 600"));
  EXPECT_NO_THROW(static_cast<void>(read(with("", "bandwidth_mhz = 599\n"))));
  // 0.8859 c/(2 · 600 MHz).
  EXPECT_THAT(
      fault_of(with("range_resolution_m = 0.2\n", "")),
      AllOf(HasSubstr(": radar.range_resolution_m: is 0.2, which takes 663.9"), HasSubstr("give more than 0.2213")));
  RadarFile file = read(with("range_resolution_m = 0.222\n", ""));
  EXPECT_THAT(message_of_error([&] { set_range_resolution(file, 0.2); }), HasSubstr("give more than 0.2213"));
  EXPECT_EQ(file.radar.range_resolution_m, 0.222);
  EXPECT_THAT(message_of_error([&] { set_frequency(file, 0.29e9); }),
              HasSubstr("frequency_hz: is 2.9e+08, about which a band of"));
  EXPECT_EQ(file.radar.frequency_hz, 0.3e9);
  set_frequency(file, 9e9);
  set_range_resolution(file, 0.2);
  EXPECT_EQ(file.radar.frequency_hz, 9e9);
}

TEST_F(RadarFileTest, BadAntennasAndScansAreRefused) {
  const std::string cosecant = simple + "[antenna]\nelevation_shape = \"cosecant-squared\"\nelevation_width_deg = 4\n";
  EXPECT_THAT(fault_of(cosecant + "steepest_depression_deg = 40\n"),
              HasSubstr(": antenna.tilt_deg: does not point below"));
  EXPECT_THAT(fault_of(cosecant + "steepest_depression_deg = 4\ntilt_deg = -5\n"), HasSubstr("give more than 5"));
  EXPECT_THAT(fault_of(simple + "[antenna]\ntilt_deg = -5\n"),
              HasSubstr(": antenna.tilt_deg: means nothing where elevation_shape is \"even\""));
  EXPECT_THAT(fault_of(simple + "[antenna]\nelevation_shape = \"gaussian\"\n"),
              HasSubstr(": antenna.elevation_width_deg: is missing"));
  EXPECT_THAT(fault_of(simple + "[scan]\nkind = \"sector\"\nrate_deg_per_s = 3\n"),
              HasSubstr(": scan.sector_deg: is missing"));
  EXPECT_THAT(fault_of(simple + "[receiver]\nfirst_range_km = 20\nlast_range_km = 10\n"),
              HasSubstr(": receiver.last_range_km: does not lie beyond"));
  EXPECT_THAT(fault_of(simple + "[receiver]\nadc_bits = 12\n"), HasSubstr(": receiver.adc_full_scale_v: is missing"));
}

// A radar that states no gain has that of its beam: 4π over the solid angle of an even fan is 2π/θ, about.
TEST_F(RadarFileTest, GainFollowsFromTheBeam) {
  const Radar radar = read("[radar]\nfrequency_ghz = 9.6\nrange_resolution_m = 3\nbeam_width_deg = 1\n" +
                           position_section + "[antenna]\nelevation_shape = \"gaussian\"\nelevation_width_deg = 2\n")
                          .radar;
  const double theta = radians_from_deg(1.0), phi = radians_from_deg(2.0);
  EXPECT_NEAR(radar.antenna.gain / (16.0 * std::numbers::ln2 / (theta * phi)), 1.0, 0.002);
}

TEST_F(RadarFileTest, AGainHoldsItsEfficiency) {
  EXPECT_THAT(fault_of(radar_section + position_section + "[antenna]\ngain_dbi = 33\nefficiency = 0.6\n"),
              HasSubstr("antenna.efficiency: means nothing beside gain_dbi, which holds it"));
}

// What is changed afterwards is what the file would have been read to say.
TEST_F(RadarFileTest, AnotherBeamWidthIsThatOfAnotherFile) {
  const auto file_of = [&](double width_deg, const std::string& antenna) {
    return read(fmt::format("[radar]\nfrequency_ghz = 9.6\nrange_resolution_m = 3\nbeam_width_deg = {}\n", width_deg) +
                position_section + antenna);
  };
  for (const std::string antenna : {"", "[antenna]\nazimuth_shape = \"taylor\"\nefficiency = 0.4\n"}) {
    RadarFile changed = file_of(2.0, antenna);
    const RadarFile expected = file_of(0.5, antenna);
    set_beam_width(changed, radians_from_deg(0.5));
    EXPECT_EQ(changed.radar.beam_width_rad, expected.radar.beam_width_rad);
    EXPECT_EQ(changed.radar.antenna.gain, expected.radar.antenna.gain);
  }
  RadarFile stated = file_of(2.0, "[antenna]\ngain_dbi = 33\n");
  set_beam_width(stated, radians_from_deg(0.5));
  EXPECT_DOUBLE_EQ(stated.radar.antenna.gain, linear_from_db(33.0));
}

TEST_F(RadarFileTest, AMeasuredBeamKeepsItsWidth) {
  folder_.write("cut.csv", "offset_deg,gain_db\n-4,10\n-2,26.98970004336\n0,30\n2,26.98970004336\n4,10\n");
  RadarFile file = read("[radar]\nfrequency_ghz = 9.6\nrange_resolution_m = 3\n" + position_section +
                        "[antenna]\nazimuth_shape = \"table\"\nazimuth_csv = \"cut.csv\"\n");
  const double width_rad = file.radar.beam_width_rad;
  EXPECT_THAT(message_of_error([&] { set_beam_width(file, 0.5 * width_rad); }),
              HasSubstr("beam_width_deg: is that of the antenna's table"));
  EXPECT_EQ(file.radar.beam_width_rad, width_rad);
}

TEST_F(RadarFileTest, AnotherRangeResolutionIsThatOfAnotherFile) {
  const auto file_of = [&](double resolution_m, const std::string& waveform) {
    return read(
        fmt::format("[radar]\nfrequency_ghz = 9.6\nrange_resolution_m = {}\nbeam_width_deg = 1\n", resolution_m) +
        position_section + waveform);
  };
  for (const std::string waveform : {"", "[waveform]\nwindow = \"hamming\"\n", "[waveform]\npulse_length_us = 3\n"}) {
    RadarFile changed = file_of(2.0, waveform);
    const RadarFile expected = file_of(6.0, waveform);
    set_range_resolution(changed, 6.0);
    EXPECT_EQ(changed.radar.range_resolution_m, 6.0);
    EXPECT_EQ(changed.radar.waveform.pulse_length_s, expected.radar.waveform.pulse_length_s);
  }
  RadarFile stated = file_of(2.0, "[waveform]\npulse_length_us = 0.1\n");
  EXPECT_THAT(message_of_error([&] { set_range_resolution(stated, 40.0); }),
              HasSubstr("range_resolution_m: is 40, coarser than a pulse of 0.1 µs can be; give at most 1"));
  EXPECT_EQ(stated.radar.range_resolution_m, 2.0);
}

// Whatever the file would be refused with is refused afterwards too.
TEST_F(RadarFileTest, PulsesLeaveTheReceiverHalfOfTheTime) {
  RadarFile file = read(simple + "[waveform]\npulse_length_us = 20\npulse_repetition_hz = 1000\n");
  set_pulse_repetition(file, 25e3);
  EXPECT_EQ(file.radar.waveform.pulse_repetition_hz, 25e3);
  EXPECT_THAT(
      message_of_error([&] { set_pulse_repetition(file, 30e3); }),
      HasSubstr("pulse_repetition_hz: is 30000, at which a pulse of 20 µs leaves the receiver less than half of "
                "the time between pulses; give at most 25000"));
  EXPECT_EQ(file.radar.waveform.pulse_repetition_hz, 25e3);

  RadarFile shortest = read(simple);
  set_pulse_repetition(shortest, 1e6);
  EXPECT_THAT(message_of_error([&] { set_range_resolution(shortest, 100.0); }),
              HasSubstr("range_resolution_m: is 100, whose shortest pulse leaves the receiver less than half"));
  set_range_resolution(shortest, coarsest_range_resolution_m(shortest));
  EXPECT_NEAR(shortest.radar.waveform.pulse_length_s, 0.5e-6, 1e-12);
}

TEST(RealBeams, LookOverAFlatEarth) {
  Radar radar{.name = "far", .earth_refraction = 4.0 / 3.0};
  EXPECT_EQ(
      message_of_error([&] { check_earth(radar, "far.toml"); }),
      "far.toml: radar.earth_refraction: is given, and real-beam maps are made over a flat Earth; leave it out, or "
      "choose another [mode]");
  radar.mode = Mode::Spotlight;
  EXPECT_NO_THROW(check_earth(radar, "far.toml"));
}

TEST(ExampleRadars, AreReadAndHearTheGround) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SIGMASCAPE_SOURCE_DIR "/examples/radars")) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    const RadarFile file = read_radar_file(entry.path());
    const auto& seen = std::get<SeenFrom>(file.place);
    // Ground of −20 dB over the cell of a compressed pulse and a two-way beam.
    const double cell_m2 = file.radar.range_resolution_m / std::cos(seen.elevation_rad) * seen.slant_range_m *
                           antenna_pattern(file.radar).azimuth().two_way_width_rad();
    EXPECT_GT(db_from_linear(signal_to_noise(file.radar, 0.01 * cell_m2, seen.slant_range_m)), 3.0) << entry.path();
    const double step_m = file.radar.range_resolution_m / 2.0;
    const RangeAzimuthGrid bins{.first_range_m = 0.8 * seen.slant_range_m,
                                .range_step_m = step_m,
                                .ranges = static_cast<std::size_t>(0.4 * seen.slant_range_m / step_m)};
    EXPECT_THAT(radar_warnings(file.radar, bins, {bins.first_range_m, bins.first_range_m, 0.0}, file.map.cell_m),
                ::testing::IsEmpty())
        << entry.path();
  }
  EXPECT_EQ(count, 7);
}

class RadarWarnings : public ::testing::Test {
 protected:
  static RangeAzimuthGrid swath(double near_m, double far_m) {
    return {.first_range_m = near_m, .range_step_m = 10.0, .ranges = static_cast<std::size_t>((far_m - near_m) / 10.0)};
  }
  Radar radar_{.range_resolution_m = 20.0, .waveform = {.pulse_length_s = 1e-6, .pulse_repetition_hz = 5000.0}};
};

TEST_F(RadarWarnings, NameTheUnambiguousRange) {
  const auto warnings = radar_warnings(radar_, swath(31e3, 71e3), {31e3, 71e3, 0.0}, 10.0);
  ASSERT_FALSE(warnings.empty());
  EXPECT_THAT(warnings.front(), HasSubstr("the swath of 40 km is longer than the unambiguous range of 29.98 km"));
  EXPECT_THAT(warnings.front(), HasSubstr("use at most 3747 Hz"));
  EXPECT_THAT(radar_warnings(radar_, swath(31e3, 51e3), {31e3, 51e3, 0.0}, 10.0), ::testing::IsEmpty());
}

TEST_F(RadarWarnings, TellOfDeafRangesGatesAndCells) {
  radar_.waveform.pulse_length_s = 40e-6;
  EXPECT_THAT(radar_warnings(radar_, swath(20e3, 40e3), {20e3, 40e3, 0.0}, 10.0),
              ::testing::ElementsAre(HasSubstr("% of the swath the receiver is deaf")));
  // The next pulse leaves within 20 µs from 26,981 m on, which are the last 59 m of 9 km.
  EXPECT_THAT(radar_warnings(radar_, swath(18e3, 27.04e3), {18e3, 27.04e3, 0.0}, 10.0),
              ::testing::ElementsAre(HasSubstr("over less than 1 % of the swath the receiver is deaf")));
  radar_.waveform.pulse_length_s = 1e-6;
  radar_.receiver.last_range_m = 18e3;
  EXPECT_THAT(radar_warnings(radar_, swath(20e3, 25e3), {20e3, 25e3, 0.0}, 10.0),
              ::testing::ElementsAre(HasSubstr("holds nothing")));
  radar_.receiver.last_range_m.reset();
  radar_.beam_width_rad = 1e-4;
  EXPECT_THAT(radar_warnings(radar_, swath(20e3, 25e3), {20e3, 25e3, 0.0}, 10.0),
              ::testing::ElementsAre(HasSubstr("the beam of 1.41 m is narrower than the map's cells")));
}

TEST_F(RadarWarnings, SayNothingOfTheBeamRightBelowTheRadar) {
  EXPECT_THAT(radar_warnings(radar_, swath(0.0, 20e3), {0.0, 20e3, 0.0}, 10.0),
              ::testing::Each(::testing::Not(HasSubstr("narrower"))));
}

TEST_F(RadarWarnings, TellOpeningAndClosingOfAGateBeyondTheSwath) {
  radar_.receiver.first_range_m = 100e3;
  EXPECT_THAT(radar_warnings(radar_, swath(20e3, 25e3), {20e3, 25e3, 0.0}, 10.0),
              ::testing::ElementsAre(HasSubstr("the range gate from 100 to 130 km holds nothing")));
}

/// At 5000 Hz 24.8 to 25.4 km fold by 29.98 km.
TEST_F(RadarWarnings, TellWhereEchoesFoldIntoAGateBeyondTheSwath) {
  radar_.receiver.first_range_m = 54e3;
  radar_.receiver.last_range_m = 56e3;
  EXPECT_THAT(radar_warnings(radar_, swath(24.8e3, 25.4e3), {24.8e3, 25.4e3, 0.0}, 10.0),
              ::testing::ElementsAre(HasSubstr("holds nothing of what is mapped, 24.8 to 25.4 km away, but in pulses, "
                                               "where it folds to 54.78 to 55.38 km")));
  radar_.receiver.first_range_m = 57e3;
  radar_.receiver.last_range_m = 58e3;
  EXPECT_THAT(radar_warnings(radar_, swath(24.8e3, 25.4e3), {24.8e3, 25.4e3, 0.0}, 10.0),
              ::testing::ElementsAre(::testing::EndsWith("24.8 to 25.4 km away")));
}

TEST_F(RadarFileTest, IsReadFromItsTextToo) {
  const std::string text =
      "[radar]\nfrequency_ghz = 9.6\nrange_resolution_m = 3.0\n[antenna]\nazimuth_shape = \"table\"\n"
      "azimuth_csv = \"cut.csv\"\n";
  folder_.write("cut.csv", "offset_deg,gain_db\n-4,10\n0,30\n4,10\n");
  const RadarFile read = read_radar_text(text, folder_.path("text"), PlaceOfRadar::Optional);
  EXPECT_DOUBLE_EQ(read.radar.frequency_hz, 9.6e9);
  EXPECT_TRUE(std::holds_alternative<Unplaced>(read.place));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_radar_text(text, "text")); }),
              HasSubstr("text: antenna.azimuth_csv"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_radar_text(text, folder_.path("text"))); }),
              HasSubstr("text: position"));
}

// A gain that follows from the beam is that of the file which states the tilt, and what is stated stays.
TEST_F(RadarFileTest, TiltAndPulseAreSetAsTheFileWouldHaveThem) {
  const auto text = [](double tilt_deg) {
    return fmt::format(
        "[radar]\nfrequency_ghz = 9.6\nrange_resolution_m = 3.0\nbeam_width_deg = 1.0\n[antenna]\n"
        "elevation_shape = \"cosecant-squared\"\nelevation_width_deg = 4.0\n"
        "steepest_depression_deg = 40.0\ntilt_deg = {:g}\n",
        tilt_deg);
  };
  const auto read = [&](double tilt_deg) { return read_radar_text(text(tilt_deg), "x", PlaceOfRadar::Optional); };
  RadarFile file = read(-3.0);
  set_tilt(file, radians_from_deg(-10.0));
  EXPECT_DOUBLE_EQ(file.radar.antenna.gain, read(-10.0).radar.antenna.gain);
  EXPECT_NE(file.radar.antenna.gain, read(-3.0).radar.antenna.gain);
  for (const double wrong_deg : {1.0, -40.0, -41.0})
    EXPECT_THAT(message_of_error([&] { set_tilt(file, radians_from_deg(wrong_deg)); }), HasSubstr("tilt_deg: is"));
  EXPECT_NEAR(deg_from_radians(file.radar.antenna.tilt_rad), -10.0, 1e-12);
  set_antenna_gain(file, 500.0);
  set_tilt(file, radians_from_deg(-5.0));
  EXPECT_EQ(file.radar.antenna.gain, 500.0) << "stated";
  set_pulse_length(file, 4e-6);
  set_range_resolution(file, 6.0);
  EXPECT_EQ(file.radar.waveform.pulse_length_s, 4e-6) << "stated";
  EXPECT_THAT(message_of_error([&] { set_pulse_length(file, 1e-9); }), HasSubstr("pulse_length_s: is 1e-09; give"));
}

}  // namespace
}  // namespace sigmascape::radar
