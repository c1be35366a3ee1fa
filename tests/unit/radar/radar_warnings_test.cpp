#include "sigmascape/radar/radar_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sigmascape::radar {
namespace {

using ::testing::HasSubstr;

/// Seen so flatly that ranges are distances.
constexpr MappedGround flat{20e3, 21e3, 0.0};

/// A beam wide beside any cell, and a pulse of so many metres.
std::vector<std::string> warnings_of_pulse(double resolution_m, double cell_m) {
  const Radar radar{.range_resolution_m = resolution_m,
                    .beam_width_rad = 0.1,
                    .waveform = {.pulse_length_s = 1e-7, .pulse_repetition_hz = 1000.0}};
  return radar_warnings(radar, {.first_range_m = 20e3, .range_step_m = 10.0, .ranges = 100}, flat, cell_m);
}

/// tests/physics/map_cells_test.cpp measures what is lost on either side of this ratio.
TEST(WarningsOfCells, BeginWherePowerIsLost) {
  EXPECT_THAT(warnings_of_pulse(4.0, 4.0), ::testing::IsEmpty());
  EXPECT_THAT(warnings_of_pulse(3.85, 4.0), ::testing::IsEmpty());
  EXPECT_THAT(warnings_of_pulse(3.8, 4.0),
              ::testing::ElementsAre(HasSubstr("the pulse of 3.8 m is narrower than the map's cells of 4 m")));
  EXPECT_THAT(warnings_of_pulse(2.0, 4.0), ::testing::ElementsAre(HasSubstr("use cells of at most 2 m")));
}

// Coherent modes sharpen the beam: not its width counts there, but that of what is made of it.
TEST(WarningsOfCells, AskForTheBeamInRealBeamMapsAlone) {
  const RangeAzimuthGrid bins{.first_range_m = 20e3, .range_step_m = 10.0, .ranges = 100};
  Radar radar{.range_resolution_m = 4.0,
              .beam_width_rad = 1e-4,
              .waveform = {.pulse_length_s = 1e-7, .pulse_repetition_hz = 1000.0}};
  EXPECT_THAT(radar_warnings(radar, bins, flat, 4.0), ::testing::ElementsAre(HasSubstr("the beam of 1.4")));
  radar.mode = Mode::Spotlight;
  EXPECT_THAT(radar_warnings(radar, bins, flat, 4.0), ::testing::IsEmpty());
  EXPECT_EQ(narrower_than_cells("the image", 4.0, 4.0), std::nullopt);
  EXPECT_THAT(narrower_than_cells("the image", 0.3, 4.0).value_or(""), HasSubstr("the image of 0.3 m is narrower"));
}

// A pulse of 60 µs lasts until 9 km.
TEST(WarningsOfEclipsing, TellTheOwnPulseFromTheNext) {
  Radar radar{.range_resolution_m = 10.0,
              .beam_width_rad = 0.1,
              .waveform = {.pulse_length_s = 60e-6, .pulse_repetition_hz = 1000.0}};
  EXPECT_THAT(radar_warnings(radar, {.first_range_m = 2e3, .range_step_m = 10.0, .ranges = 100}, flat, 4.0),
              ::testing::ElementsAre(HasSubstr("while the pulse itself is sent; use a shorter pulse")));
  EXPECT_THAT(radar_warnings(radar, {.first_range_m = 148e3, .range_step_m = 10.0, .ranges = 100}, flat, 4.0),
              ::testing::ElementsAre(HasSubstr("while the next pulse is sent; use another pulse repetition")));
}

}  // namespace
}  // namespace sigmascape::radar
