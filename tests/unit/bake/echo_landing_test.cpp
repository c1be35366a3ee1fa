#include "sigmascape/bake/echo_landing.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::bake {
namespace {

/// Rises steadily northward by `slope`, from height zero at y = 0.
terrain::HeightField northward_slope(double slope) {
  terrain::HeightField field{-500.0, 500.0, 500.0, Array2D<float>(3, 3)};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      field.height_m(column, row) = static_cast<float>(slope * (500.0 - 500.0 * static_cast<double>(row)));
  }
  return field;
}

/// Smooth hills of 30 m.
terrain::HeightField hills() {
  terrain::HeightField field{-400.0, 400.0, 4.0, Array2D<float>(201, 201)};
  for (std::size_t row = 0; row < 201; ++row) {
    for (std::size_t column = 0; column < 201; ++column) {
      const auto x = static_cast<double>(column), y = static_cast<double>(row);
      field.height_m(column, row) = static_cast<float>(40.0 + 15.0 * std::sin(0.11 * x) + 15.0 * std::cos(0.13 * y));
    }
  }
  return field;
}

radar::Echo echo_of(Vec3d point, const radar::Aspect& aspect) {
  const Vec3d to_radar = radar::direction_to_radar(aspect);
  const Vec2d towards = radar::horizontal_direction(aspect.azimuth_rad);
  return {.range_m = -dot(point, to_radar), .cross = -point.x * towards.y + point.y * towards.x, .rcs_m2 = {}};
}

EchoLanding landing_on(const radar::Aspect& aspect, const terrain::HeightField& relief) {
  return {aspect, relief, static_cast<double>(relief.lowest_m()), static_cast<double>(relief.highest_m())};
}

TEST(EchoLanding, GroundOnHillsStandsWhereItIs) {
  const terrain::HeightField relief = hills();
  for (const double elevation_deg : {5.0, 21.0, 37.0}) {
    for (const double azimuth_deg : {0.0, 77.0, 135.0, 260.0}) {
      const radar::Aspect aspect{radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)};
      const EchoLanding landing = landing_on(aspect, relief);
      for (const Vec2d place : {Vec2d{3.0, -20.0}, {151.0, 133.0}, {-230.0, 90.0}}) {
        const Vec2d found = landing.place_of(echo_of({place.x, place.y, relief.height_at(place)}, aspect));
        EXPECT_NEAR(found.x, place.x, 0.05) << azimuth_deg << "° " << elevation_deg << "°";
        EXPECT_NEAR(found.y, place.y, 0.05) << azimuth_deg << "° " << elevation_deg << "°";
      }
    }
  }
}

// Before a wall that faces the radar, ground at its foot and ground upon it have one range; both are level here, so
// that both are found at once.
TEST(EchoLanding, BeforeAWallTheFootOfItIsTaken) {
  constexpr double wall_m = 12.0;
  terrain::HeightField quay{-400.0, 400.0, 2.0, Array2D<float>(401, 401)};
  for (std::size_t row = 0; row < 401; ++row) {
    for (std::size_t column = 0; column < 401; ++column) quay.height_m(column, row) = row < 200 ? wall_m : 0.0F;
  }
  for (const double elevation_deg : {21.0, 37.0, 53.0, 60.0}) {
    const radar::Aspect aspect{pi, radians_from_deg(elevation_deg)};
    const EchoLanding landing = landing_on(aspect, quay);
    for (const double before_m : {0.01, 0.3, 1.7, 3.1}) {
      const Vec2d found = landing.place_of(echo_of({7.0, -before_m, 0.0}, aspect));
      EXPECT_NEAR(found.x, 7.0, 0.02);
      EXPECT_NEAR(found.y, -before_m, 0.02) << elevation_deg << "°";
    }
  }
}

TEST(EchoLanding, HeightLiesOverTowardsTheRadarByTheHeightTimesTheTangentOnLevelGround) {
  for (const double azimuth_deg : {0.0, 45.0, 130.0, 180.0, 270.0, 310.0}) {
    for (const double elevation_deg : {5.0, 37.0, 80.0}) {
      const radar::Aspect aspect{radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)};
      for (const double height_m : {0.0, 6.0, 30.0}) {
        const Vec2d place = EchoLanding(aspect).place_of(echo_of({12.25, -30.75, height_m}, aspect));
        const double over_m = height_m * std::tan(aspect.elevation_rad);
        EXPECT_NEAR(place.x, 12.25 + over_m * std::sin(aspect.azimuth_rad), 1e-9) << azimuth_deg << "° " << height_m;
        EXPECT_NEAR(place.y, -30.75 + over_m * std::cos(aspect.azimuth_rad), 1e-9) << azimuth_deg << "° " << height_m;
      }
    }
  }
}

// A top h above ground that falls away from the radar with slope s lies over by h / (cot ψ + s), s rising towards it.
TEST(EchoLanding, HeightLiesOverUntilItMeetsTheSlope) {
  const radar::Aspect from_north{0.0, radians_from_deg(30.0)};
  for (const double slope : {-0.4, -0.1, 0.2, 0.5}) {
    const terrain::HeightField relief = northward_slope(slope);
    const EchoLanding landing = landing_on(from_north, relief);
    const double top_m = 6.0, y = 10.0;
    const Vec2d place = landing.place_of(echo_of({7.0, y, slope * y + top_m}, from_north));
    EXPECT_NEAR(place.x, 7.0, 1e-9);
    EXPECT_NEAR(place.y, y + top_m / (1.0 / std::tan(from_north.elevation_rad) + slope), 0.02) << slope;
  }
}

}  // namespace
}  // namespace sigmascape::bake
