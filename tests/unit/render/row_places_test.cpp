#include "sigmascape/render/row_places.h"

#include <gtest/gtest.h>
#include <memory>

#include "sigmascape/radar/curved_earth.h"

namespace sigmascape::render {
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

}  // namespace
}  // namespace sigmascape::render
