#include "sigmascape/bake/terrain_horizon.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::bake {
namespace {

/// Level but for a ridge 20 m high along y = 100.
terrain::HeightField ridge() {
  terrain::HeightField field{-200.0, 200.0, 2.0, Array2D<float>(201, 201, 0.0F)};
  for (std::size_t column = 0; column < 201; ++column) field.height_m(column, 50) = 20.0F;
  return field;
}

constexpr double tangent = 0.2;

TerrainHorizon seen_from(double azimuth_deg, const terrain::HeightField& field) {
  return {{radians_from_deg(azimuth_deg), std::atan(tangent)}, field, static_cast<double>(field.highest_m()), 2.0};
}

TEST(TerrainHorizon, HidesWhatStandsBelowTheLineOfSightOverARidge) {
  const terrain::HeightField field = ridge();
  const TerrainHorizon from_north = seen_from(0.0, field);
  // The line over the ridge falls by a fifth of the way: 60 m behind it is 8 m above the ground, 110 m behind below.
  EXPECT_NEAR(from_north.hidden_m({0.0, 40.0}), 8.0, 0.01);
  EXPECT_DOUBLE_EQ(from_north.hidden_m({0.0, -10.0}), 0.0);
  // What is no taller than 3 m is hidden altogether, which is all that is asked.
  EXPECT_GE(from_north.hidden_m({0.0, 40.0}, 3.0), 3.0);
  EXPECT_NEAR(from_north.hidden_m({0.0, 40.0}, 20.0), 8.0, 0.01);
}

TEST(TerrainHorizon, HidesNothingBeforeARidgeOrAlongIt) {
  const terrain::HeightField field = ridge();
  EXPECT_DOUBLE_EQ(seen_from(0.0, field).hidden_m({0.0, 140.0}), 0.0);
  EXPECT_DOUBLE_EQ(seen_from(180.0, field).hidden_m({0.0, 40.0}), 0.0);
  EXPECT_DOUBLE_EQ(seen_from(90.0, field).hidden_m({0.0, 40.0}), 0.0);
}

TEST(TerrainHorizon, HidesBehindASlopeFacingAway) {
  terrain::HeightField field{-200.0, 200.0, 2.0, Array2D<float>(201, 201)};
  for (std::size_t row = 0; row < 201; ++row) {
    for (std::size_t column = 0; column < 201; ++column)
      field.height_m(column, row) = 0.3F * 2.0F * (200.0F - static_cast<float>(row));
  }
  EXPECT_DOUBLE_EQ(seen_from(180.0, field).hidden_m({0.0, 0.0}), 0.0);
  // Ground goes on rising towards the radar by a tenth more than the line of sight, up to the edge 200 m away.
  EXPECT_NEAR(seen_from(0.0, field).hidden_m({0.0, 0.0}), 20.0, 0.3);
}

}  // namespace
}  // namespace sigmascape::bake
