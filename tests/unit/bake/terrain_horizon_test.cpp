#include "sigmascape/bake/terrain_horizon.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::bake {
namespace {

/// Level but for a ridge 20 m high along y = 100.
terrain::HeightField ridge() {
  terrain::HeightField field{-200.0, 200.0, 2.0, Array2D<float>(201, 201, 0.0F)};
  for (std::size_t column = 0; column < 201; ++column) field.height_m(column, 50) = 20.0F;
  return field;
}

/// Hills of all sizes, rough and level stretches: a hash of the place, under a few waves.
terrain::HeightField rough_land() {
  terrain::HeightField field{-300.0, 500.0, 3.0, Array2D<float>(173, 261)};
  for (std::size_t row = 0; row < 261; ++row) {
    for (std::size_t column = 0; column < 173; ++column) {
      const double x = static_cast<double>(column), y = static_cast<double>(row);
      const double hills =
          20.0 * std::sin(x / 23.0) * std::cos(y / 31.0) + 60.0 * std::exp(-std::hypot(x - 90, y - 60));
      const auto roughness = static_cast<double>(unit_float(hashed(row * 173 + column)));
      field.height_m(column, row) = static_cast<float>(std::max(hills + 3.0 * roughness, 0.0));
    }
  }
  return field;
}

/// As what hides is defined: the most by which ground rises above a line of sight, at every step of it.
double hidden_at_every_step(const terrain::HeightField& field, const radar::Aspect& aspect, double step_m,
                            Vec2d place) {
  const Vec2d towards_radar = radar::horizontal_direction(aspect.azimuth_rad);
  double hidden_m = 0.0;
  for (double away_m = step_m; field.extent().contains(place + towards_radar * away_m); away_m += step_m) {
    const double line_m = field.height_at(place) + away_m * std::tan(aspect.elevation_rad);
    hidden_m = std::max(hidden_m, field.height_at(place + towards_radar * away_m) - line_m);
  }
  return hidden_m;
}

constexpr double tangent = 0.2;

/// What is seen of a field from one azimuth.
class SeenFrom {
 public:
  SeenFrom(double azimuth_deg, const terrain::HeightField& field)
      : highest_(field), horizon_({radians_from_deg(azimuth_deg), std::atan(tangent)}, field, highest_, 2.0) {}

  template <typename... Enough>
  [[nodiscard]] double hidden_m(Vec2d place, Enough... enough_m) const {
    return horizon_.hidden_m(place, enough_m...);
  }

 private:
  HighestGround highest_;
  TerrainHorizon horizon_;
};

TEST(TerrainHorizon, HidesWhatStandsBelowTheLineOfSightOverARidge) {
  const terrain::HeightField field = ridge();
  const SeenFrom from_north(0.0, field);
  // The line over the ridge falls by a fifth of the way: 60 m behind it is 8 m above the ground, 110 m behind below.
  EXPECT_NEAR(from_north.hidden_m({0.0, 40.0}), 8.0, 0.01);
  EXPECT_DOUBLE_EQ(from_north.hidden_m({0.0, -10.0}), 0.0);
  // What is no taller than 3 m is hidden altogether, which is all that is asked.
  EXPECT_GE(from_north.hidden_m({0.0, 40.0}, 3.0), 3.0);
  EXPECT_NEAR(from_north.hidden_m({0.0, 40.0}, 20.0), 8.0, 0.01);
}

TEST(TerrainHorizon, HidesNothingBeforeARidgeOrAlongIt) {
  const terrain::HeightField field = ridge();
  EXPECT_DOUBLE_EQ(SeenFrom(0.0, field).hidden_m({0.0, 140.0}), 0.0);
  EXPECT_DOUBLE_EQ(SeenFrom(180.0, field).hidden_m({0.0, 40.0}), 0.0);
  EXPECT_DOUBLE_EQ(SeenFrom(90.0, field).hidden_m({0.0, 40.0}), 0.0);
}

TEST(TerrainHorizon, HidesBehindASlopeFacingAway) {
  terrain::HeightField field{-200.0, 200.0, 2.0, Array2D<float>(201, 201)};
  for (std::size_t row = 0; row < 201; ++row) {
    for (std::size_t column = 0; column < 201; ++column)
      field.height_m(column, row) = 0.3F * 2.0F * (200.0F - static_cast<float>(row));
  }
  EXPECT_DOUBLE_EQ(SeenFrom(180.0, field).hidden_m({0.0, 0.0}), 0.0);
  // Ground goes on rising towards the radar by a tenth more than the line of sight, up to the edge 200 m away.
  EXPECT_NEAR(SeenFrom(0.0, field).hidden_m({0.0, 0.0}), 20.0, 0.3);
}

// Ground that is too low to hide anything more is passed over in squares, whatever way lines of sight take through
// them.
TEST(TerrainHorizon, PassesOverNothingThatHides) {
  const terrain::HeightField field = rough_land();
  const HighestGround highest(field);
  std::size_t hidden = 0;
  for (const double azimuth_deg : {0.0, 17.0, 90.0, 135.0, 180.0, 200.0, 270.0, 301.0}) {
    for (const double elevation_deg : {0.5, 4.0, 15.0}) {
      for (const double step_m : {1.0, 3.0}) {
        const radar::Aspect aspect{radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)};
        const TerrainHorizon horizon(aspect, field, highest, step_m);
        for (double y = -270.0; y < 500.0; y += 41.0) {
          for (double x = -295.0; x < 216.0; x += 37.0) {
            const double hidden_m = hidden_at_every_step(field, aspect, step_m, {x, y});
            ASSERT_NEAR(horizon.hidden_m({x, y}), hidden_m, 1e-6)
                << azimuth_deg << "°, " << elevation_deg << "°, " << x << ", " << y;
            hidden += hidden_m > 0.0 ? 1U : 0U;
          }
        }
      }
    }
  }
  EXPECT_GT(hidden, 1000U);
}

}  // namespace
}  // namespace sigmascape::bake
