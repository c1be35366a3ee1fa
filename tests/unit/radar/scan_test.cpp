#include "sigmascape/radar/scan.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

const Scan rotating{.kind = ScanKind::Rotating, .rate_rad_per_s = radians_from_deg(144.0)};
const Scan sector{.kind = ScanKind::Sector,
                  .azimuth_rad = radians_from_deg(350.0),
                  .sector_width_rad = radians_from_deg(60.0),
                  .rate_rad_per_s = radians_from_deg(30.0)};
const Scan fixed{.kind = ScanKind::Fixed, .azimuth_rad = 1.0};

// 24 turns a minute.
TEST(Scan, RotatingAntennaComesRoundInTime) {
  EXPECT_NEAR(revisit_s(rotating), 2.5, 1e-12);
  EXPECT_NEAR(beam_azimuth_rad(rotating, 0.625), pi / 2.0, 1e-12);
  EXPECT_NEAR(beam_azimuth_rad(rotating, 2.5 * 7 + 1.25), pi, 1e-9);
  EXPECT_EQ(hits_per_dwell(rotating, radians_from_deg(1.2), 3000.0), 25);
  EXPECT_NEAR(dwell_s(rotating, radians_from_deg(1.2)), 1.2 / 144.0, 1e-12);
}

TEST(Scan, SectorGoesToAndFro) {
  EXPECT_NEAR(revisit_s(sector), 4.0, 1e-12);
  const auto offset_deg = [&](double time_s) {
    return deg_from_radians(std::remainder(beam_azimuth_rad(sector, time_s) - radians_from_deg(350.0), 2.0 * pi));
  };
  EXPECT_NEAR(offset_deg(0.0), 0.0, 1e-9);
  EXPECT_NEAR(offset_deg(0.5), 15.0, 1e-9);
  EXPECT_NEAR(offset_deg(1.0), 30.0, 1e-9);
  EXPECT_NEAR(offset_deg(2.0), 0.0, 1e-9);
  EXPECT_NEAR(offset_deg(3.0), -30.0, 1e-9);
  EXPECT_NEAR(offset_deg(4.0), 0.0, 1e-9);
}

TEST(Scan, FixedAntennaStays) {
  EXPECT_EQ(beam_azimuth_rad(fixed, 100.0), 1.0);
  EXPECT_TRUE(std::isinf(revisit_s(fixed)));
  EXPECT_GT(hits_per_dwell(fixed, 0.01, 1000.0), 1'000'000);
}

TEST(Scan, ReachesItsSectorAcrossNorth) {
  EXPECT_TRUE(reaches(sector, radians_from_deg(5.0)));
  EXPECT_TRUE(reaches(sector, radians_from_deg(-40.0)));
  EXPECT_FALSE(reaches(sector, radians_from_deg(25.0)));
  EXPECT_TRUE(reaches(sector, radians_from_deg(25.0), radians_from_deg(6.0)));
  EXPECT_TRUE(reaches(rotating, 2.0));
  EXPECT_TRUE(reaches(fixed, 1.0 + 2.0 * pi));
  EXPECT_FALSE(reaches(fixed, 1.1));
}

}  // namespace
}  // namespace sigmascape::radar
