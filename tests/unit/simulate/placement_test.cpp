#include "sigmascape/simulate/placement.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/base/units.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/radar/never_scanned.h"

namespace sigmascape::simulate {
namespace {

using ::testing::HasSubstr;

constexpr double arc_second_rad = pi / (180.0 * 3600.0);

double degrees(double whole, double minutes, double seconds) {
  return whole + minutes / 60.0 + seconds / 3600.0;
}

// The worked example of the Geocentric Datum of Australia Technical Manual (ICSM): length and azimuths of the geodesic
// from Flinders Peak to Buninyong.
const geo::GeographicPosition flinders{-degrees(37, 57, 3.72030), degrees(144, 25, 29.52440)};
const radar::GeographicPlace buninyong{-degrees(37, 39, 10.15610), degrees(143, 55, 35.38390), 3000.0};
constexpr double between_m = 54'972.271;
const double there_rad = radians_from_deg(degrees(306, 52, 5.37)), back_rad = radians_from_deg(degrees(127, 10, 25.07));

/// Flat ground of 10 km about a place of a frame.
struct FlatScene {
  geo::LocalFrame frame;
  Vec2d middle;
  radar::Rectangle extent{middle.x - 5e3, middle.y - 5e3, middle.x + 5e3, middle.y + 5e3};
  terrain::HeightField terrain{extent.west_m, extent.north_m, 1e3, Array2D<float>(11, 11, 0.0F)};

  FlatScene(const geo::LocalFrame& in, geo::GeographicPosition about)
      : frame(in), middle(geo::position_in_frame(in, about)) {}
  [[nodiscard]] radar::Radar placed(const radar::RadarFile& file, double time_s = 0.0) const {
    return placed_radar(file, frame, terrain, extent, time_s);
  }
  [[nodiscard]] Vec2d towards_middle(const radar::Radar& radar) const {
    return middle - Vec2d{radar.position.x, radar.position.y};
  }
};

/// A radar whose nose, course and beam all lie at an azimuth.
radar::RadarFile all_at(double azimuth_rad, const decltype(radar::RadarFile::place)& place) {
  radar::RadarFile file;
  file.radar.heading_rad = azimuth_rad;
  file.radar.velocity_mps = {100.0 * std::sin(azimuth_rad), 100.0 * std::cos(azimuth_rad), 5.0};
  file.radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = azimuth_rad};
  file.place = place;
  return file;
}

void expect_all_towards(const radar::Radar& radar, Vec2d way, double tolerance_rad) {
  for (const double azimuth_rad : {radar.heading_rad, *radar.scan.azimuth_rad, azimuth_of(radar.velocity_mps)}) {
    EXPECT_NEAR(turned_by_least(azimuth_rad - azimuth_of(way)), 0.0, tolerance_rad);
  }
  EXPECT_NEAR(std::hypot(radar.velocity_mps.x, radar.velocity_mps.y), 100.0, 1e-9);
  EXPECT_EQ(radar.velocity_mps.z, 5.0);
}

TEST(PlacedRadar, OnTheGlobeStandsAtTheEndOfItsGeodesic) {
  const FlatScene scene({flinders.latitude_deg, flinders.longitude_deg}, flinders);
  const radar::Radar radar = scene.placed(all_at(back_rad, buninyong));
  EXPECT_NEAR(radar.position.x, between_m * std::sin(there_rad), 5e-3);
  EXPECT_NEAR(radar.position.y, between_m * std::cos(there_rad), 5e-3);
  EXPECT_EQ(radar.position.z, 3000.0);
  expect_all_towards(radar, scene.towards_middle(radar), 0.02 * arc_second_rad);
}

TEST(PlacedRadar, OnTheGlobeFliesOnWhereItsCourseGoes) {
  const FlatScene scene({flinders.latitude_deg, flinders.longitude_deg}, flinders);
  const radar::Radar radar = scene.placed(all_at(back_rad, buninyong), 100.0);
  EXPECT_NEAR(length(scene.towards_middle(radar)), between_m - 100.0 * 100.0, 0.01);
}

// In a frame about another origin, 2° of longitude to the west, the scene is turned and larger by x²/2R²: so are the
// way to the radar and all that it measures.
TEST(PlacedRadar, OnTheGlobeGoesWithTheFrameFarFromItsOrigin) {
  const FlatScene scene({flinders.latitude_deg, flinders.longitude_deg - 2.0}, flinders);
  const radar::Radar radar = scene.placed(all_at(back_rad, buninyong));
  const Vec2d back = scene.towards_middle(radar);
  const double x_m = scene.middle.x, radius_m = 6'371e3;
  EXPECT_NEAR(length(back) / between_m, 1.0 + x_m * x_m / (2.0 * radius_m * radius_m), 5e-6);
  // Azimuths of the frame are true ones less the convergence of meridians, Δλ sin φ.
  const double turned_rad = turned_by_least(azimuth_of(back * -1.0) - there_rad);
  EXPECT_NEAR(turned_rad, -radians_from_deg(2.0) * std::sin(radians_from_deg(flinders.latitude_deg)), 2e-5);
  expect_all_towards(radar, back, 0.02 * arc_second_rad);
}

// 2° of longitude away at 60 N the beam that looks west along the parallel sees the scene beside its axis: on a sphere
// the azimuth of the great circle is 270° + atan(tan 1° sin 60°), and in the frame it was 269.13°.
TEST(PlacedRadar, OnTheGlobeSeesTheSceneAtItsTrueAzimuth) {
  const FlatScene scene({60.0, 0.0}, {60.0, 0.0});
  const double true_rad = 1.5 * pi + std::atan(std::tan(radians_from_deg(1.0)) * std::sin(radians_from_deg(60.0)));
  const radar::GeographicPlace place{60.0, 2.0, 9000.0};
  const radar::Radar radar = scene.placed(all_at(true_rad, place));
  expect_all_towards(radar, scene.towards_middle(radar), radians_from_deg(0.01));
  EXPECT_NO_THROW(radar::require_scanned(radar, scene.extent));
  // What is advised is what the file is to say, to the middle of the angle that the square fills, 0.02° beside its own.
  const radar::Radar astray = scene.placed(all_at(pi, place));
  EXPECT_THAT(message_of_error([&] { radar::require_scanned(astray, scene.extent); }),
              HasSubstr("let its scan take in azimuth 270.8°"));
}

// There the frame is the globe, be it over the scene's very middle or on one of its hills.
TEST(PlacedRadar, OnTheGlobeOverTheSceneIsWhereTheFrameHasThePlace) {
  const FlatScene scene({flinders.latitude_deg, flinders.longitude_deg}, flinders);
  for (const double north_deg : {0.0, 1e-9, 0.02}) {
    const radar::GeographicPlace place{flinders.latitude_deg + north_deg, flinders.longitude_deg + north_deg, 3000.0};
    const radar::Radar radar = scene.placed(all_at(1.0, place));
    const Vec2d projected = geo::position_in_frame(scene.frame, {place.latitude_deg, place.longitude_deg});
    EXPECT_NEAR(radar.position.x, projected.x, 1e-3);
    EXPECT_NEAR(radar.position.y, projected.y, 1e-3);
    EXPECT_NEAR(radar.heading_rad, 1.0, 5e-4);  // 0.02° of longitude turn north by as much times sin φ
  }
}

// 176 km from the frame's origin the way of its geodesic would end d² x / 2R², 7 cm, beside a mast at 5.6 km. North
// there is turned by the convergence of meridians, Δλ sin φ.
TEST(PlacedRadar, OnTheGlobeOverASceneFarFromTheOriginStandsOnItsHill) {
  const FlatScene scene({flinders.latitude_deg, flinders.longitude_deg - 2.0}, flinders);
  const radar::GeographicPlace mast{flinders.latitude_deg + 0.04, flinders.longitude_deg + 0.04, 300.0};
  const radar::Radar radar = scene.placed(all_at(1.0, mast));
  const Vec2d projected = geo::position_in_frame(scene.frame, {mast.latitude_deg, mast.longitude_deg});
  ASSERT_GT(length(projected - scene.middle), 5e3);
  EXPECT_NEAR(radar.position.x, projected.x, 1e-6);
  EXPECT_NEAR(radar.position.y, projected.y, 1e-6);
  const double north_rad = -radians_from_deg(2.04) * std::sin(radians_from_deg(mast.latitude_deg));
  EXPECT_NEAR(radar.north_rad, north_rad, 5e-5);
  EXPECT_NEAR(radar.heading_rad, 1.0 + north_rad, 5e-5);
  EXPECT_NEAR(*radar.scan.azimuth_rad, 1.0 + north_rad, 5e-5);
}

TEST(PlacedRadar, InMetresMeasuresAzimuthsInTheFrame) {
  const FlatScene scene({60.0, 0.0}, {60.0, 2.0});
  const radar::Radar radar = scene.placed(all_at(1.0, radar::LocalPlace{{1e4, 2e4, 3000.0}}));
  EXPECT_EQ(radar.position, (Vec3d{1e4, 2e4, 3000.0}));
  EXPECT_EQ(radar.heading_rad, 1.0);
  EXPECT_EQ(radar.scan.azimuth_rad, 1.0);
  EXPECT_EQ(radar.north_rad, 0.0);
}

TEST(PlacedRadar, OnTheGlobeStandsWithinReachOfTheScene) {
  const FlatScene scene({60.0, 0.0}, {60.0, 0.0});
  // Along a meridian a degree is 111.4 km there.
  EXPECT_NO_THROW(static_cast<void>(scene.placed(all_at(0.0, radar::GeographicPlace{51.1, 0.0, 9000.0}))));
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(scene.placed(all_at(0.0, radar::GeographicPlace{-50.0, 100.0, 9000.0})));
              }),
              HasSubstr("place it within 1000 km"));
}

// Where the equator meets the meridian 90° away the projection has no place for anything.
TEST(PlacedTargets, WhereTheFrameDoesNotReachAreRefused) {
  const FlatScene scene({43.25, -2.95}, {43.25, -2.95});
  radar::TargetSource source;
  source.where = "targets.toml: targets[1]";
  source.places = {{.place = radar::LatitudeLongitude{0.0, 87.05}, .height_m = 100.0, .above_ground = false}};
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(placed_targets({&source, 1}, scene.frame, scene.terrain, 1));
              }),
              HasSubstr("targets.toml: targets[1]: has a place on the globe that the scene's frame does not reach"));
}

}  // namespace
}  // namespace sigmascape::simulate
