#include "sigmascape/dataset/dataset_warnings.h"

#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <utility>

#include "scratch_folder.h"

#include "sigmascape/base/units.h"

namespace sigmascape::dataset {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr radar::Rectangle terrain_extent{-3000, -3000, 3000, 3000};

/// Level, but for one corner.
terrain::HeightField terrain_up_to(float highest_m) {
  terrain::HeightField terrain{-3000, 3000, 6000, Array2D<float>(2, 2, 0.0F)};
  terrain.height_m(0, 0) = highest_m;
  return terrain;
}

std::vector<std::string> warnings_of(const DatasetSpec& spec) {
  return dataset_warnings(spec, terrain_up_to(0.0F), terrain_extent);
}

/// Cells of 4 m, a pulse as wide, and a beam of 4.2 m at 15 km, two-way.
DatasetSpec fitting_spec() {
  DatasetSpec spec;
  spec.file = "spec.toml";
  spec.radar.radar.range_resolution_m = 4.0;
  spec.radar.radar.beam_width_rad = radians_from_deg(0.023);
  spec.radar.radar.waveform = {.pulse_length_s = 1e-7, .pulse_repetition_hz = 1000.0};
  spec.count = 4;
  spec.cells = 64;
  spec.cell_m = 4.0;
  spec.azimuth_rad = {0.0, 6.0};
  spec.elevation_rad = {0.2, 0.3};
  spec.slant_range_m = {15e3, 20e3};
  return spec;
}

TEST(DatasetWarnings, AreOfTheFinestBeamAndPulseThatMayBeDrawn) {
  DatasetSpec spec = fitting_spec();
  EXPECT_THAT(warnings_of(spec), IsEmpty());
  spec.radar_ranges.beam_width_rad = {radians_from_deg(0.011), radians_from_deg(0.03)};
  EXPECT_THAT(warnings_of(spec), ElementsAre(StartsWith("in maps 15 km away the beam of 1.97")));
  spec.radar_ranges.beam_width_rad = {radians_from_deg(0.023), radians_from_deg(0.03)};
  EXPECT_THAT(warnings_of(spec), IsEmpty());
  spec.radar.has_shortest_pulse = true;
  spec.radar_ranges.range_resolution_m = {2.5, 8.0};
  EXPECT_THAT(warnings_of(spec),
              ElementsAre("in maps 15 km away the pulse of 2.55 m is narrower than the map's cells of "
                          "4 m, and part of what stands between their centres is lost or counted "
                          "twice; use cells of at most 2.55 m"));
}

/// A pattern whose peak was left at the horizon.
TEST(DatasetWarnings, AreOfABeamThatPointsOverTheMaps) {
  DatasetSpec spec = fitting_spec();
  spec.radar.radar.antenna.elevation = radar::GaussianBeam{};
  spec.radar.radar.antenna.elevation_width_rad = radians_from_deg(4.0);
  EXPECT_THAT(warnings_of(spec),
              ElementsAre(StartsWith("of maps seen under 11.5°, the beam points to an elevation of")));
  spec.radar.radar.antenna.tilt_rad = -0.25;
  EXPECT_THAT(warnings_of(spec), IsEmpty());
}

TEST(DatasetWarnings, AreOfTheNearestMapsAndTellOfTheFarthestWhatIsWrongThere) {
  DatasetSpec spec = fitting_spec();
  spec.slant_range_m = {10e3, 20e3};
  spec.radar.radar.receiver.last_range_m = 12e3;
  EXPECT_THAT(warnings_of(spec), ElementsAre(StartsWith("in maps 10 km away the beam of 2.7"),
                                             StartsWith("in maps 20 km away the range gate from")));
  spec.slant_range_m = {20e3, 20e3};
  EXPECT_THAT(warnings_of(spec), ElementsAre(StartsWith("in maps 20 km away the range gate from")));
}

TEST(DatasetWarnings, FollowARadarThatFliesUpToItsMap) {
  DatasetSpec spec = fitting_spec();
  spec.azimuth_rad = {0.0, 0.0};
  spec.slant_range_m = {15e3, 15e3};
  spec.sequence = {.frames = 4, .interval_s = 10.0, .speed_mps = {150.0, 150.0}, .course_rad = {0.0, 0.0}};
  EXPECT_THAT(warnings_of(spec), IsEmpty()) << "flies away";
  spec.sequence.course_rad = {pi, pi};
  EXPECT_THAT(warnings_of(spec), ElementsAre(StartsWith("in maps 10.")));
}

// 15 km away under 11.5° it stands 2980 m up and 14.7 km before the map; 60 s of 200 m/s later 2.7 km, which is under
// 48°.
TEST(DatasetWarnings, SayUnderWhatAngleARadarThatFliesSeesItsMap) {
  DatasetSpec spec = fitting_spec();
  spec.azimuth_rad = {0.0, 0.0};
  spec.elevation_rad = {0.2, 0.2};
  spec.slant_range_m = {15e3, 15e3};
  spec.radar.radar.antenna.elevation = radar::GaussianBeam{};
  spec.radar.radar.antenna.elevation_width_rad = radians_from_deg(4.0);
  spec.sequence = {.frames = 4, .interval_s = 20.0, .speed_mps = {200.0, 200.0}, .course_rad = {pi, pi}};
  EXPECT_THAT(warnings_of(spec), Contains(StartsWith("of maps seen under 47.8°, the beam points to an elevation of")));
}

// The example shows vehicles, none of which may be lost between cells.
TEST(DatasetWarnings, AreNoneOfTheExampleOfSanFrancisco) {
  const ScratchFolder folder;
  ::setenv("SIGMASCAPE_ATLAS", folder.path("").c_str(), 1);
  DatasetSpec spec =
      read_dataset_spec(std::filesystem::path(SIGMASCAPE_SOURCE_DIR) / "examples/datasets/san_francisco.toml");
  ::unsetenv("SIGMASCAPE_ATLAS");
  const auto warnings = [&] { return dataset_warnings(spec, terrain_up_to(280.0F), terrain_extent); };
  EXPECT_THAT(warnings(), IsEmpty());
  ASSERT_TRUE(spec.radar_ranges.beam_width_rad);
  spec.radar_ranges.beam_width_rad.reset();
  EXPECT_THAT(warnings(), ElementsAre(HasSubstr("the beam of 3.38 m")))
      << "that of the radar file, sharper than the cells";
}

}  // namespace
}  // namespace sigmascape::dataset
