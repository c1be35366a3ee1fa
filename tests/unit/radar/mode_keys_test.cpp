#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/radar/radar_file.h"

namespace sigmascape::radar {
namespace {

using ::testing::HasSubstr;

class ModeKeys : public ::testing::Test {
 protected:
  [[nodiscard]] Radar read(const std::string& mode, const std::string& platform = "speed_mps = 100\n") const {
    return read_radar_file(folder_.write("x.toml",
                                         "[radar]\nfrequency_ghz = 9.6\nrange_resolution_m = 3.0\n"
                                         "beam_width_deg = 2\n[position]\nazimuth_deg = 130\n"
                                         "elevation_deg = 13\nslant_range_km = 20\n[platform]\n" +
                                             platform + "[mode]\n" + mode))
        .radar;
  }
  [[nodiscard]] std::string fault_of(const std::string& mode, const std::string& platform = "speed_mps = 100\n") const {
    return message_of_error([&] { static_cast<void>(read(mode, platform)); });
  }
  ScratchFolder folder_;
};

TEST_F(ModeKeys, SayHowPulsesAreAddedUp) {
  const Radar spot = read("kind = \"spotlight\"\nalong_resolution_m = 0.5\nlooks = 3\n");
  EXPECT_EQ(spot.mode, Mode::Spotlight);
  EXPECT_EQ(spot.processing, (Processing{{}, 0.5, {}, 3}));
  EXPECT_EQ(read("kind = \"doppler-beam-sharpening\"\nsharpening = 20\n").processing.sharpening, 20.0);
  EXPECT_EQ(read("kind = \"doppler-beam-sharpening\"\ninterval_s = 0.2\n").processing.interval_s, 0.2);
  EXPECT_EQ(read("kind = \"stripmap\"\n").processing, Processing{});
}

TEST_F(ModeKeys, SayWhatIsLeftInAnImage) {
  const Processing plain = read("kind = \"stripmap\"\n").processing;
  EXPECT_TRUE(plain.ambiguities);
  EXPECT_FALSE(plain.antenna_pattern);
  EXPECT_FALSE(plain.thermal_noise);
  const Processing all =
      read("kind = \"stripmap\"\nambiguities = false\nantenna_pattern = true\nthermal_noise = true\n").processing;
  EXPECT_FALSE(all.ambiguities);
  EXPECT_TRUE(all.antenna_pattern);
  EXPECT_TRUE(all.thermal_noise);
  EXPECT_THAT(fault_of("kind = \"spotlight\"\nambiguities = true\n"),
              HasSubstr("mode.ambiguities: means nothing in a spotlight mode; leave it out, or use it with stripmap"));
  EXPECT_THAT(fault_of("thermal_noise = true\n"), HasSubstr("mode.thermal_noise: means nothing in a real-beam mode"));
}

TEST_F(ModeKeys, NonsenseIsRefused) {
  EXPECT_THAT(fault_of("kind = \"stripmap\"\n", "heading_deg = 40\n"),
              HasSubstr("x.toml: mode.kind: is stripmap, and the platform stands still; give platform.speed_mps"));
  EXPECT_THAT(fault_of("kind = \"spotlight\"\ninterval_s = 1\nalong_resolution_m = 1\n"),
              HasSubstr("mode.interval_s: and along_resolution_m say the same thing"));
  EXPECT_THAT(fault_of("kind = \"stripmap\"\ninterval_s = 1\n"),
              HasSubstr("mode.interval_s: means nothing in a stripmap mode; leave it out, or use it with "
                        "doppler-beam-sharpening or spotlight"));
  EXPECT_THAT(fault_of("looks = 4\n"), HasSubstr("mode.looks: means nothing in a real-beam mode"));
  EXPECT_THAT(fault_of("kind = \"spotlight\"\nlooks = 0\n"), HasSubstr("mode.looks: is 0"));
  EXPECT_THAT(fault_of("kind = \"spotlight\"\nlook = 2\n"), HasSubstr("did you mean looks?"));
}

}  // namespace
}  // namespace sigmascape::radar
