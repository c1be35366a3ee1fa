#include "sigmascape/radar/pattern_table.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

using ::testing::HasSubstr;

TEST(PatternTable, GivesBackTheBeamItWasMadeFrom) {
  ScratchFolder folder;
  const AntennaCut made(GaussianBeam{}, radians_from_deg(4.0));
  std::string text = "offset_deg,gain_db\n";
  for (int k = -60; k <= 60; ++k) {
    const double offset_deg = 0.1 * k;
    text += fmt::format("{},{:.9f}\n", offset_deg, 31.0 + db_from_linear(made.power(radians_from_deg(offset_deg))));
  }
  const PatternTable read = read_pattern_table(folder.write("cut.csv", text));
  EXPECT_NEAR(deg_from_radians(read.half_power_width_rad), 4.0, 1e-3);
  const AntennaCut cut(read.beam, read.half_power_width_rad);
  for (const double offset_deg : {-3.3, -1.0, 0.0, 0.73, 2.0, 5.5}) {
    const double offset = radians_from_deg(offset_deg);
    EXPECT_NEAR(db_from_linear(cut.power(offset)), db_from_linear(made.power(offset)), 0.01) << offset_deg;
  }
}

TEST(PatternTable, FaultsAreToldWithTheirLine) {
  ScratchFolder folder;
  const auto fault_of = [&](const std::string& text) {
    const auto file = folder.write("cut.csv", text);
    return message_of_error([&] { static_cast<void>(read_pattern_table(file)); });
  };
  EXPECT_THAT(fault_of("offset_deg,gain_db\n-1,-4\n0;0\n1,-4\n"), HasSubstr("cut.csv:3: \"0;0\" is not a pair"));
  EXPECT_THAT(fault_of("-1,-4\n0,0\n0,-4\n"), HasSubstr("cut.csv:3: does not lie beyond the line before it"));
  EXPECT_THAT(fault_of("-1,-4\n0,0\n1,-2\n"), HasSubstr("does not fall to half of its peak on both sides"));
  EXPECT_THAT(fault_of("0,0\n1,-4\n2,-9\n"), HasSubstr("does not fall to half of its peak on both sides"));
  EXPECT_THAT(fault_of("offset_deg,gain_db\n"), HasSubstr("fewer than three lines"));
  EXPECT_THAT(fault_of("0,1e17\n1,0\n2,-50\n"), HasSubstr("cut.csv:1: \"0,1e17\" is out of range"));
  EXPECT_THAT(fault_of("-1e300,-10\n0,0\n1e300,-10\n"), HasSubstr("give offsets of at most 180 degrees"));
  EXPECT_THAT(fault_of("-1e-7,-3.2\n0,0\n1e-7,-3.2\n"), HasSubstr("give one of 1e-05 to 90 degrees"));
  EXPECT_THAT(fault_of("-179,-10\n0,0\n179,-10\n"), HasSubstr("give one of 1e-05 to 90 degrees"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_pattern_table(folder.path("none.csv"))); }),
              HasSubstr("none.csv: cannot be read"));
}

// As spreadsheets and measuring programs write them.
TEST(PatternTable, MarksRemarksAndBlankLinesAreNoNumbers) {
  const ScratchFolder folder;
  const auto read = [&](const std::string& text) { return read_pattern_table(folder.write("cut.csv", text)); };
  const std::size_t plain = read("-2,-20\n0,0\n2,-20\n").beam.samples.size();
  EXPECT_EQ(plain, 3U);
  EXPECT_EQ(read("\xef\xbb\xbfoffset_deg,gain_db\r\n-2,-20\r\n\r\n0,0\r\n2,+0.5\r\n4,-20\r\n").beam.samples.size(), 4U);
  EXPECT_EQ(read("# measured\noffset_deg,gain_db\n -2 , -20\n0,0\n  \n2,-20\n").beam.samples.size(), plain);
  for (const char* junk : {"-2,-20 dB", "-2,-20,1", "-2,5,-20", "-2", "a,b"})
    EXPECT_THAT(message_of_error([&] { static_cast<void>(read(std::string(junk) + "\n0,0\n2,-20\n")); }),
                HasSubstr("is not a pair of numbers"))
        << junk;
}

// A beam whose peak lies off the axis is as wide as one whose peak does not.
TEST(PatternTable, WidthIsThatAboutThePeak) {
  ScratchFolder folder;
  const AntennaCut made(GaussianBeam{}, radians_from_deg(4.0));
  for (const double peak_deg : {0.0, 2.0, -5.0}) {
    std::string text;
    for (int k = -120; k <= 120; ++k) {
      const double offset_deg = 0.1 * k;
      text += fmt::format("{},{:.9f}\n", offset_deg,
                          std::max(-60.0, db_from_linear(made.power(radians_from_deg(offset_deg - peak_deg)))));
    }
    const PatternTable read = read_pattern_table(folder.write("cut.csv", text));
    EXPECT_NEAR(AntennaCut(read.beam, read.half_power_width_rad).two_way_width_rad(), made.two_way_width_rad(), 1e-4)
        << peak_deg;
  }
}

}  // namespace
}  // namespace sigmascape::radar
