#include "sigmascape/radar/radar_file.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "scratch_folder.h"

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

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

TEST_F(RadarFileTest, MissingSectionsAreNamed) {
  EXPECT_EQ(fault_of(position_section), ": radar: is missing; add a [radar] section");
  EXPECT_EQ(fault_of(radar_section), ": position: is missing; add a [position] section");
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
  EXPECT_THAT(fault_of(radar_section + position_section + "latitude_deg = 43\n"),
              HasSubstr(": position.latitude_deg: is not a known key"));
}

TEST_F(RadarFileTest, OutOfRangeNamesTheUnit) {
  EXPECT_EQ(
      fault_of("[radar]\nfrequency_ghz = 9.6e9\nrange_resolution_m = 3.0\nbeam_width_deg = 0.01\n" + position_section),
      ": radar.frequency_ghz: is 9.6e+09; give a number from 0.1 to 300 GHz");
  EXPECT_EQ(fault_of(radar_section + "[position]\nazimuth_deg = 130\nelevation_deg = 0\nslant_range_km = 20\n"),
            ": position.elevation_deg: is 0; give a number from 0.5 to 89 degrees");
  EXPECT_EQ(fault_of(radar_section + "[position]\neast_m = 0\nnorth_m = 0\naltitude_m = -3\n"),
            ": position.altitude_m: is -3; give a number from 1 to 1e+06 m above mean sea level");
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

}  // namespace
}  // namespace sigmascape::radar
