#include "sigmascape/radar/rcs_table.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "scratch_folder.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

class RcsTableFile : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& text) {
    std::ofstream(path_) << text;
    return path_;
  }
  std::string fault_of(const std::string& text) {
    try {
      (void)read_rcs_table(written(text));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  ScratchFolder folder_;
  std::filesystem::path path_ = folder_.path("ship.csv");
};

constexpr const char* two_frequencies =
    "# a ship\n"
    "frequency_ghz, azimuth_deg, vv_dbsm, hh_dbsm, hv_dbsm, vv_hh_correlation\n"
    "9, 0, 10, 13, 0, -1\n"
    "9, 180, 20, 20, 10, 1\n"
    "10, 180, 30, 30, 10, 1\n"
    "10, 0, 0, 0, 0, 1\n";

TEST_F(RcsTableFile, is_read_in_any_order_and_interpolated_in_power) {
  const RcsTable table = read_rcs_table(written(two_frequencies));
  const auto at = [&](double azimuth_deg, double ghz) {
    return table.at({{radians_from_deg(azimuth_deg), 0.3}, ghz * 1e9});
  };
  EXPECT_NEAR(at(0.0, 9.0).vv, 10.0, 1e-3);
  EXPECT_NEAR(at(0.0, 9.0).hh, 19.953, 1e-3);
  EXPECT_NEAR(at(0.0, 9.0).hv, 1.0, 1e-4);
  EXPECT_NEAR(at(0.0, 9.0).re_vvhh, -14.125, 1e-3);
  EXPECT_NEAR(at(90.0, 9.0).vv, 55.0, 1e-2);
  EXPECT_NEAR(at(270.0, 9.0).vv, 55.0, 1e-2);  // around the back
  EXPECT_NEAR(at(-90.0, 9.0).vv, 55.0, 1e-2);
  EXPECT_NEAR(at(180.0, 9.5).vv, 550.0, 1e-1);
  EXPECT_NEAR(at(180.0, 20.0).vv, 1000.0, 1e-1);  // held
}

TEST_F(RcsTableFile, says_in_which_line_it_is_wrong) {
  using testing::HasSubstr;
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n0, 1, two\n"),
              HasSubstr("ship.csv, line 2: hh_dbsm is \"two\""));
  EXPECT_THAT(fault_of("azimuth_deg, vv, hh_dbsm\n0, 1, 2\n"), HasSubstr("line 1: has an unknown column \"vv\""));
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm\n0, 1\n"), HasSubstr("must have one column hh_dbsm"));
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n0, 1\n"), HasSubstr("line 2: has 2 fields"));
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n0, 1, 2\n0, 1, 2\n"),
              HasSubstr("line 3: tells a second time what is returned at an azimuth of 0°"));
  EXPECT_THAT(
      fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n0, 1, 2\n360, 1, 3\n"),
      HasSubstr("line 3: tells a second time what is returned at an azimuth of 360°; give each azimuth, elevation and "
                "frequency once; whole turns make no difference"));
  EXPECT_EQ(fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n0, 1, 2\n180, 3, 4\n360, 1, 2\n"), "") << "a closed circle";
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n"), HasSubstr("holds no cross-sections"));
  EXPECT_THAT(fault_of("azimuth_deg, elevation_deg, vv_dbsm, hh_dbsm\n0, 0, 1, 2\n90, 10, 1, 2\n"),
              HasSubstr("holds 2 of the 4 combinations"));
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm, hh_dbsm, vv_hh_correlation\n0, 1, 2, 1.5\n"),
              HasSubstr("vv_hh_correlation is 1.5"));
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n0, 4, 4\n45, 4, 4\n90, 7, 7\n135, 4, 4\n180, 4, 4\n"),
              HasSubstr("ship.csv: tells nothing between azimuths of 180° and 0°; tell it all round"));
  for (const char* const of_one_side : {"0, 4, 4\n90, 7, 7\n", "0, 4, 4\n90, 7, 7\n180, 4, 4\n"})
    EXPECT_THAT(fault_of(std::string("azimuth_deg, vv_dbsm, hh_dbsm\n") + of_one_side),
                HasSubstr("tell it all round, in steps of at most 90°"));
  for (const char* const all_round : {"0, 4, 4\n180, 7, 7\n", "0, 4, 4\n120, 7, 7\n240, 4, 4\n", "30, 1, 1\n"})
    EXPECT_EQ(fault_of(std::string("azimuth_deg, vv_dbsm, hh_dbsm\n") + all_round), "");
  EXPECT_EQ(fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n0, 4, 4\n45, 4, 4\n90, 7, 7\n180, 4, 4\n270, 7, 7\n"), "");
  EXPECT_THROW((void)read_rcs_table(folder_.path("nowhere.csv")), Error);
  EXPECT_THROW((void)read_rcs_table(folder_.path(".")), Error);
}

/// At one elevation from 0 to 350°, at the next the same directions from −180 to 170°.
TEST_F(RcsTableFile, knows_an_azimuth_by_whole_turns_of_it) {
  std::string text = "azimuth_deg, elevation_deg, vv_dbsm, hh_dbsm\n";
  for (int azimuth = 0; azimuth < 360; ++azimuth) {
    text += std::to_string(azimuth) + ", 0, 1, 1\n";
    text += std::to_string(azimuth - 180) + ", 10, 1, 1\n";
  }
  EXPECT_EQ(fault_of(text), "");
  EXPECT_THAT(fault_of(text + "-20, 0, 2, 2\n"),
              testing::HasSubstr("tells a second time what is returned at an azimuth "
                                 "of -20°"));
}

TEST_F(RcsTableFile, refuses_what_no_radar_measures) {
  using testing::HasSubstr;
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n0, 1e6, 2\n"),
              HasSubstr("ship.csv, line 2: vv_dbsm is 1e6; give a number from -300 to 300"));
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n1e300, 1, 2\n"), HasSubstr("azimuth_deg is 1e300"));
  EXPECT_THAT(fault_of("azimuth_deg, elevation_deg, vv_dbsm, hh_dbsm\n0, 91, 1, 2\n"),
              HasSubstr("elevation_deg is 91"));
  EXPECT_THAT(fault_of("azimuth_deg, frequency_ghz, vv_dbsm, hh_dbsm\n0, -3, 1, 2\n"),
              HasSubstr("frequency_ghz is -3"));
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm, hh_dbsm\n0, nan, 2\n"), HasSubstr("vv_dbsm is \"nan\""));
  EXPECT_THAT(fault_of("azimuth_deg, vv_dbsm, hh_dbsm, hv_dbsm, hv_dbsm\n0, 1, 2, 3, 4\n"),
              HasSubstr("must have one column hv_dbsm"));
}

}  // namespace
}  // namespace sigmascape::radar
