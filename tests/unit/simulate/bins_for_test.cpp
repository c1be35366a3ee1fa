#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::simulate {
namespace {

// The middle of an edge that faces the radar is nearer than its corners: by 25 m for 2 km at 20 km.
TEST(BinsFor, HoldEveryPointOfTheArea) {
  const radar::Rectangle area{-1000, -1000, 1000, 1000};
  const terrain::HeightField terrain{-1000, 1000, 2000, Array2D<float>(2, 2, 80.0F)};
  for (int degrees = 0; degrees < 360; degrees += 30) {
    radar::Radar radar;
    radar.position = radar::position_seeing({0, 0, 80}, radians_from_deg(degrees), radians_from_deg(13.0), 20e3);
    radar.beam_width_rad = 1e-4;
    const radar::RangeAzimuthGrid bins = bins_for(radar, area, terrain);
    const double middle = bins.first_azimuth_rad + 0.5 * static_cast<double>(bins.azimuths) * bins.azimuth_step_rad;
    for (int row = 0; row <= 40; ++row) {
      for (int column = 0; column <= 40; ++column) {
        const Vec3d away = Vec3d{-1000.0 + 50.0 * column, -1000.0 + 50.0 * row, 80.0} - radar.position;
        const double range_bin = (length(away) - bins.first_range_m) / bins.range_step_m;
        const double azimuth = middle + std::remainder(azimuth_of(away) - middle, 2.0 * pi);
        const double azimuth_bin = (azimuth - bins.first_azimuth_rad) / bins.azimuth_step_rad;
        ASSERT_GT(range_bin, 2.0) << degrees << "°";
        ASSERT_LT(range_bin, static_cast<double>(bins.ranges) - 2.0) << degrees << "°";
        ASSERT_GT(azimuth_bin, 2.0) << degrees << "°";
        ASSERT_LT(azimuth_bin, static_cast<double>(bins.azimuths) - 2.0) << degrees << "°";
      }
    }
  }
}

// A radar over the map sees it all round.
TEST(BinsFor, HoldEveryPointAroundARadarOverTheArea) {
  const radar::Rectangle area{-1000, -1000, 1000, 1000};
  const terrain::HeightField terrain{-1000, 1000, 2000, Array2D<float>(2, 2, 80.0F)};
  for (const Vec2d foot : {Vec2d{0, 0}, {-900, 120}, {1000, -1000}, {0, 1000}}) {
    radar::Radar radar;
    radar.position = {foot.x, foot.y, 700.0};
    radar.beam_width_rad = 0.02;
    const radar::RangeAzimuthGrid bins = bins_for(radar, area, terrain);
    EXPECT_TRUE(bins.goes_round()) << foot.x << " " << foot.y;
    EXPECT_LT(bins.first_range_m, 620.0);
    EXPECT_GT(bins.first_range_m + static_cast<double>(bins.ranges) * bins.range_step_m,
              std::hypot(1000.0 + std::abs(foot.x), 1000.0 + std::abs(foot.y), 620.0));
  }
}

}  // namespace
}  // namespace sigmascape::simulate
