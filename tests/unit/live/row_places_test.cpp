#include "sigmascape/live/row_places.h"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/curved_earth.h"

namespace sigmascape::live {
namespace {

// A phase is to be had from it: on the ground of hills too, and as far as a frame goes.
TEST(RowPlaces, SlantRangesAreThoseOfTheCurvedEarth) {
  const radar::CurvedEarth earth;
  constexpr double radar_height_m = 3000.0;
  const RowGeometry geometry{.radar_height_m = radar_height_m, .drop_per_square_m = 0.5 * earth.curvature_per_m()};
  const auto row = std::make_unique<LatticeRow>();
  row->count = 3;
  const double distances_m[] = {2e3, 100e3, 200e3};
  const float heights_m[] = {0.0F, 500.0F, 1200.0F};
  for (std::size_t i = 0; i < row->whole_vectors(); ++i) {
    row->east_m[i] = 0.6 * distances_m[i % 3];
    row->north_m[i] = 0.8 * distances_m[i % 3];
  }
  for (const float height_m : heights_m) {
    row->height_m.fill(height_m);
    locate(*row, geometry);
    for (std::size_t i = 0; i < row->count; ++i) {
      const double expected_m = earth.slant_range_m(radar_height_m, static_cast<double>(height_m), distances_m[i]);
      EXPECT_NEAR(row->range_m[i], expected_m, 1e-3) << distances_m[i] << " m away, " << height_m << " m high";
    }
  }
}

TEST(RowPlaces, AzimuthsAreRightAllRoundTheRadar) {
  constexpr double middle_rad = 0.7, beams_per_rad = 50.0;
  const RowGeometry geometry{.radar_height_m = 100.0,
                             .sin_middle = std::sin(middle_rad),
                             .cos_middle = std::cos(middle_rad),
                             .middle_beam = 8.0,
                             .beams_per_rad = beams_per_rad,
                             .cell_m = 1.0};
  const auto row = std::make_unique<LatticeRow>();
  row->height_m.fill(0.0F);
  for (const double north_m : {-3.3, -0.4, 0.4, 3.3, 80.0}) {
    row->count = 120;
    for (std::size_t i = 0; i < row->whole_vectors(); ++i) {
      row->east_m[i] = static_cast<double>(i) - 60.3;
      row->north_m[i] = north_m;
    }
    locate(*row, geometry);
    for (std::size_t i = 0; i < row->count; ++i) {
      const double off_rad = std::remainder(std::atan2(row->east_m[i], north_m) - middle_rad, 2.0 * pi);
      EXPECT_NEAR(static_cast<double>(row->beam[i]), 8.0 + off_rad * beams_per_rad, 2e-5 * beams_per_rad)
          << row->east_m[i] << ", " << north_m;
    }
  }
}

}  // namespace
}  // namespace sigmascape::live
