#include "sigmascape/radar/target_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "scratch_folder.h"

namespace sigmascape::radar {
namespace {

using ::testing::HasSubstr;

class TargetFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<TargetSource> read(const std::string& text) const {
    return read_target_file(folder_.write("x.toml", text));
  }
  [[nodiscard]] std::string fault_of(const std::string& text) const {
    return message_of_error([&] { static_cast<void>(read(text)); });
  }
  ScratchFolder folder_;
};

const std::string plain = "[[targets]]\nposition_m = [1, 2]\nrcs_dbsm = 10\n";

TEST_F(TargetFile, RefusesACrossSectionOfNoChannel) {
  EXPECT_THAT(fault_of("[[targets]]\nposition_m = [1, 2]\nrcs_dbsm = {}\n"),
              HasSubstr("rcs_dbsm: names no channel; give at least one of vv, hh and hv"));
}

TEST_F(TargetFile, ReadsWhatStandsAndWhatMoves) {
  const auto targets = read(
      "[[targets]]\nname = \"lorry\"\nposition_m = [10, -20]\nheading_deg = 90\nspeed_mps = 8\nclimb_mps = 1\n"
      "rcs_dbsm = {vv = 20, hh = 10}\nbounces = \"even\"\nswerling = 3\nsize_m = [9, 2.5, 4]\n"
      "[[targets]]\nposition_lat_lon_deg = [43, -3]\naltitude_m = 500\nrcs_dbsm = 0\n");
  ASSERT_EQ(targets.size(), 2U);
  const TargetSource& lorry = targets[0];
  EXPECT_EQ(lorry.target.name, "lorry");
  EXPECT_EQ(std::get<Vec2d>(lorry.places.at(0).place), (Vec2d{10.0, -20.0}));
  EXPECT_EQ(lorry.places.at(0).height_m, 2.0);  // the middle of the box
  EXPECT_TRUE(lorry.places.at(0).above_ground);
  EXPECT_NEAR(lorry.velocity_mps.x, 8.0, 1e-12);
  EXPECT_NEAR(lorry.velocity_mps.y, 0.0, 1e-12);
  EXPECT_EQ(lorry.velocity_mps.z, 1.0);
  EXPECT_NEAR(lorry.target.heading_rad, std::numbers::pi / 2.0, 1e-12);
  const auto& rcs = std::get<Channels>(lorry.target.rcs_m2);
  EXPECT_NEAR(rcs.vv, 100.0F, 1e-3F);
  EXPECT_NEAR(rcs.hh, 10.0F, 1e-4F);
  EXPECT_EQ(rcs.hv, 0.0F);
  EXPECT_LT(rcs.re_vvhh, 0.0F);
  EXPECT_EQ(lorry.target.fluctuation, Swerling::Case3);
  EXPECT_EQ(lorry.target.size_m, (Vec3d{9.0, 2.5, 4.0}));
  EXPECT_EQ(targets[1].target.name, "target 2");
  EXPECT_EQ(std::get<LatitudeLongitude>(targets[1].places.at(0).place).longitude_deg, -3.0);
  EXPECT_FALSE(targets[1].places.at(0).above_ground);
}

TEST_F(TargetFile, ReadsWayPointsAndTables) {
  folder_.write("car.csv", "azimuth_deg,vv_dbsm,hh_dbsm\n0,10,10\n180,20,20\n");
  const auto targets = read(
      "[[targets]]\nrcs_csv = \"car.csv\"\n[[targets.way_points]]\ntime_s = 0\nposition_m = [0, 0]\n"
      "[[targets.way_points]]\ntime_s = 10\nposition_m = [0, 50]\nheight_m = 3\n");
  ASSERT_EQ(targets.at(0).places.size(), 2U);
  EXPECT_EQ(targets[0].places[1].time_s, 10.0);
  EXPECT_EQ(targets[0].places[1].height_m, 3.0);
  EXPECT_NEAR(std::get<RcsTable>(targets[0].target.rcs_m2).rcs_m2.at(1).vv, 100.0F, 1e-3F);
}

TEST_F(TargetFile, TheExampleIsRead) {
  EXPECT_EQ(read_target_file(SIGMASCAPE_SOURCE_DIR "/examples/targets/reflector_and_movers.toml").size(), 3U);
}

TEST_F(TargetFile, FaultsNameFileAndKey) {
  EXPECT_THAT(fault_of("# nothing\n"), HasSubstr("x.toml: targets: is missing; add a [[targets]] table"));
  EXPECT_THAT(fault_of("[[targets]]\nrcs_dbsm = 10\n"), HasSubstr("position_m: is missing; give either"));
  EXPECT_THAT(fault_of("[[targets]]\nposition_m = [1, 2]\n"), HasSubstr("rcs_dbsm: is missing"));
  EXPECT_THAT(fault_of(plain + "position_lat_lon_deg = [43, -3]\n"), HasSubstr("both say where it is"));
  EXPECT_THAT(fault_of(plain + "height_m = 1\naltitude_m = 1\n"), HasSubstr("altitude_m: and height_m both"));
  EXPECT_THAT(fault_of(plain + "swerling = 5\n"), HasSubstr("swerling: is 5; give"));
  EXPECT_THAT(fault_of(plain + "size_m = [1, 2]\n"), HasSubstr("size_m: holds 2 numbers; give 3"));
  EXPECT_THAT(fault_of(plain + "speed_mp = 2\n"), HasSubstr("did you mean speed_mps?"));
  EXPECT_THAT(fault_of(plain + "rcs_csv = \"car.csv\"\n"), HasSubstr("both give the cross-section"));
  EXPECT_THAT(fault_of("[[targets]]\nposition_lat_lon_deg = [143, 3]\nrcs_dbsm = 0\n"), HasSubstr("latitude first"));
  EXPECT_THAT(fault_of(plain + "[[targets.way_points]]\ntime_s = 0\nposition_m = [0, 0]\n"),
              HasSubstr("position_m: and way_points both"));
  for (const char* key : {"height_m", "altitude_m"}) {
    EXPECT_THAT(fault_of(fmt::format("[[targets]]\nrcs_dbsm = 1\n{} = 5\n[[targets.way_points]]\ntime_s = 1\n"
                                     "position_m = [0, 0]\n",
                                     key)),
                HasSubstr(std::string(key) + ": and way_points both"));
  }
  EXPECT_THAT(fault_of("[[targets]]\nposition_m = [0, 0]\nrcs_csv = \"car.csv\"\nbounces = \"even\"\n"),
              HasSubstr("bounces: means nothing beside rcs_csv"));
  EXPECT_THAT(fault_of("[[targets]]\nrcs_dbsm = 1\n[[targets.way_points]]\ntime_s = 1\nposition_m = [0, 0]\n"
                       "[[targets.way_points]]\ntime_s = 1\nposition_m = [0, 1]\n"),
              HasSubstr("time_s: is not later"));
}

}  // namespace
}  // namespace sigmascape::radar
