#include "sigmascape/live/visible_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <optional>

#include "unit/live/line_of_sight.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/terrain/terrain_reader.h"

namespace sigmascape::live {
namespace {

std::filesystem::path data_folder() {
  const char* stated = std::getenv("SIGMASCAPE_DATA");
  return stated != nullptr && *stated != '\0' ? std::filesystem::path(stated)
                                              : std::filesystem::path(SIGMASCAPE_SOURCE_DIR) / "../shared/data";
}

/// Real terrain; nothing when the data are not there.
std::optional<terrain::HeightField> real_terrain(const char* file, geo::LocalFrame frame, double spacing_m,
                                                 double smooth_within_m, double half_m) {
  const auto path = data_folder() / file;
  if (!std::filesystem::exists(path)) return std::nullopt;
  terrain::TerrainSource source;
  source.raster = {path, 1, ""};
  source.spacing_m = spacing_m;
  source.smooth_within_m = smooth_within_m;
  return terrain::read_terrain(source, frame, radar::Rectangle{-half_m, -half_m, half_m, half_m}).field;
}

template <typename Height>
terrain::HeightField made_up(std::size_t side, double spacing_m, const Height& height) {
  const double half_m = 0.5 * spacing_m * static_cast<double>(side - 1);
  terrain::HeightField field{
      .west_m = -half_m, .north_m = half_m, .spacing_m = spacing_m, .height_m = Array2D<float>(side, side)};
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      field.height_m(column, row) = static_cast<float>(
          height(-half_m + spacing_m * static_cast<double>(column), half_m - spacing_m * static_cast<double>(row)));
    }
  }
  return field;
}

/// The sector over all of a terrain from a radar that sees its middle under the given angles.
struct Scene {
  terrain::HeightField terrain;
  Vec3d radar;
  HorizonGrid grid = {};
};

Scene seen_from(terrain::HeightField terrain, double azimuth_deg, double elevation_deg, double range_m, double step_m,
                std::size_t azimuths) {
  const radar::Rectangle extent = terrain.extent();
  const Vec2d centre = extent.centre();
  const Vec3d target{centre.x, centre.y, terrain.height_at(centre)};
  Scene scene{
      .terrain = std::move(terrain),
      .radar = radar::position_seeing(target, radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg), range_m)};
  const double distance_m = range_m * std::cos(radians_from_deg(elevation_deg));
  const double half_m = 0.5 * extent.width_m();
  const double first_m = std::max(distance_m - half_m, 2.0 * step_m);
  scene.grid = {.first_azimuth_rad = radians_from_deg(azimuth_deg + 180.0) - 0.8 * half_m / distance_m,
                .azimuth_step_rad = 1.6 * half_m / distance_m / static_cast<double>(azimuths),
                .azimuths = azimuths,
                .near_m = first_m,
                .step_m = step_m,
                .distances = static_cast<std::size_t>((distance_m + half_m - first_m) / step_m),
                .before_near = 1U << 20U,
                .drop_per_square_m = radar::CurvedEarth().drop_m(1.0)};
  return scene;
}

/// The horizon of all of a scene by one of the ways.
VisibleGround found(const Scene& scene, const VisibleGroundSettings& settings, unsigned threads = 1) {
  VisibleGround ground(settings, threads);
  WorkerTeam team(threads);
  ground.reset(scene.grid, false);
  ground.find(0, scene.grid.azimuths, scene.radar, {.terrain = terrain::view_of(scene.terrain)}, team);
  return ground;
}

/// The sweep walks in fortieths of a cell: fine enough for one part in a thousand at grazing angles of
/// a few degrees. A picture is as fine as its pixels.
std::size_t nodes_a_sample(VisibilityMethod method) {
  return method == VisibilityMethod::HorizonSweep ? 32 : 1;
}

/// Compares with the long way over the same surface: the bilinear one, or the triangles that are drawn of it.
void expect_like_lines_of_sight(const Scene& scene, const VisibleGroundSettings& settings, const char* name) {
  constexpr std::size_t every = 16;
  const std::size_t every_distance = nodes_a_sample(settings.method);
  const auto surface = [&](Vec2d point) {
    return settings.method == VisibilityMethod::Rasterization ? height_of_triangles(scene.terrain, point)
                                                              : scene.terrain.height_at(point);
  };
  const auto truth = walked_lines_of_sight(scene.terrain, surface, scene.radar, scene.grid, every, 64.0);
  const VisibleGround ground = found(scene, settings);
  const Disagreement differ = disagreement(truth, scene.terrain, ground.horizon(), scene.radar, every, every_distance,
                                           0.06 * scene.terrain.spacing_m, 2 * every_distance);
  std::printf("  %s: %zu samples, %.1f %% hidden, %.4f %% differ, %zu of them away from silhouettes\n", name,
              differ.compared, 100.0 * static_cast<double>(differ.hidden) / static_cast<double>(differ.compared),
              100.0 * differ.share(), differ.away_from_silhouettes);
  EXPECT_GT(differ.hidden, differ.compared / 100) << name;
  EXPECT_LT(differ.share(), 1e-3) << name;
  // What falls between the pixel centres of a picture is lost to it: a sample in several thousand, anywhere.
  const std::size_t lost = settings.method == VisibilityMethod::Rasterization ? differ.compared / 5000 : 0;
  EXPECT_LE(differ.away_from_silhouettes, lost) << name;
}

class VisibleGroundByBothMethods : public ::testing::TestWithParam<VisibilityMethod> {};

VisibleGroundSettings by(VisibilityMethod method) {
  return {.method = method, .raster = {.pixels_per_triangle = 256.0}};
}

TEST_P(VisibleGroundByBothMethods, AgreesWithEveryLineOfSightOverBilbao) {
  const auto terrain = real_terrain("bilbao/dem_5m_utm30n.tif", {43.312, -2.986}, 5.0, 0.5, 700.0);
  if (!terrain) GTEST_SKIP() << "the folder bilbao is not in " << data_folder() << "; set SIGMASCAPE_DATA";
  const double step_m = 4.0 / static_cast<double>(nodes_a_sample(GetParam()));
  expect_like_lines_of_sight(seen_from(*terrain, 30.0, 5.0, 20e3, step_m, 512), by(GetParam()), "Bilbao, 5°");
  expect_like_lines_of_sight(seen_from(*terrain, 130.0, 8.6, 10e3, step_m, 512), by(GetParam()), "Bilbao, 8.6°");
}

TEST_P(VisibleGroundByBothMethods, AgreesWithEveryLineOfSightOverSanFrancisco) {
  const auto terrain = real_terrain("san_francisco/dem_3dep_1arcsec_4326.tif", {37.79, -122.41}, 20.0, 0.0, 2800.0);
  if (!terrain) GTEST_SKIP() << "the folder san_francisco is not in " << data_folder() << "; set SIGMASCAPE_DATA";
  const double step_m = 16.0 / static_cast<double>(nodes_a_sample(GetParam()));
  expect_like_lines_of_sight(seen_from(*terrain, 250.0, 3.0, 40e3, step_m, 512), by(GetParam()), "San Francisco, 3°");
}

double rolling(double x, double y) {
  return 60.0 + 50.0 * std::sin(0.011 * x + 0.004 * y) + 20.0 * std::cos(0.031 * y - 0.013 * x);
}

TEST_P(VisibleGroundByBothMethods, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = seen_from(made_up(201, 10.0, rolling), 70.0, 6.0, 9e3, 8.0, 200);
  const VisibleGround one = found(scene, by(GetParam()), 1), three = found(scene, by(GetParam()), 3);
  for (std::size_t azimuth = 0; azimuth < scene.grid.azimuths; ++azimuth) {
    const float* const slopes = one.horizon().slopes(azimuth);
    ASSERT_TRUE(std::equal(slopes, slopes + scene.grid.distances, three.horizon().slopes(azimuth))) << azimuth;
  }
}

TEST_P(VisibleGroundByBothMethods, LevelGroundIsSeenThroughoutUpToTheHorizon) {
  // From 100 m the sea is seen out to 41 km.
  const Scene scene{.terrain = made_up(301, 400.0, [](double, double) { return 0.0; }),
                    .radar = {0.0, 0.0, 100.0},
                    .grid = {.azimuth_step_rad = 0.01,
                             .azimuths = 20,
                             .near_m = 2000.0,
                             .step_m = 200.0,
                             .distances = 270,
                             .drop_per_square_m = radar::CurvedEarth().drop_m(1.0)}};
  const VisibleGround ground = found(scene, {.method = GetParam()});
  const double horizon_m = radar::CurvedEarth().horizon_m(100.0);
  // Towards the horizon the rows of the oblique picture fall together: the last tenths of a degree are beyond it.
  const double blurred_m = GetParam() == VisibilityMethod::HorizonSweep ? 1200.0 : 14e3;
  EXPECT_NEAR(horizon_m, 41.2e3, 0.1e3);
  for (std::size_t azimuth = 0; azimuth < scene.grid.azimuths; ++azimuth) {
    for (std::size_t k = 0; k < scene.grid.distances; ++k) {
      const double distance_m = distance_of(scene.grid, k);
      if (std::abs(distance_m - horizon_m) < blurred_m) continue;
      ASSERT_EQ(is_seen(ground.horizon(), scene.radar, 0.0, azimuth, k), distance_m < horizon_m) << distance_m;
    }
  }
}

TEST_P(VisibleGroundByBothMethods, BeyondTheHorizonTheSeaHidesThoughNoneIsKnown) {
  // Two kilometres of a plain 60 km away, which rises above the sea before it from 21 m on.
  const Scene scene{.terrain = made_up(65, 32.0, [](double, double) { return 5.0; }),
                    .radar = {0.0, -60e3, 100.0},
                    .grid = {.first_azimuth_rad = -0.01,
                             .azimuth_step_rad = 0.001,
                             .azimuths = 20,
                             .near_m = 59.2e3,
                             .step_m = 16.0,
                             .distances = 100,
                             .drop_per_square_m = radar::CurvedEarth().drop_m(1.0)}};
  const radar::CurvedEarth earth;
  const VisibleGround ground = found(scene, {.method = GetParam()});
  for (std::size_t k = 0; k < scene.grid.distances; ++k) {
    const double hidden_m = earth.drop_m(distance_of(scene.grid, k) - earth.horizon_m(scene.radar.z));
    ASSERT_NEAR(hidden_m, 21.0, 2.5);
    EXPECT_FALSE(is_seen(ground.horizon(), scene.radar, hidden_m - 0.1, 7, k)) << k;
    EXPECT_TRUE(is_seen(ground.horizon(), scene.radar, hidden_m + 0.1, 7, k)) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, VisibleGroundByBothMethods,
                         ::testing::Values(VisibilityMethod::HorizonSweep, VisibilityMethod::Rasterization),
                         [](const auto& method) {
                           return method.param == VisibilityMethod::HorizonSweep ? "HorizonSweep" : "Rasterization";
                         });

TEST(VisibleGround, GroundBeyondTheTerrainDoesNotHide) {
  // Terrain ends in a cliff 520 m high over nothing, before a radar that looks from beyond its edge.
  const Scene scene{.terrain = made_up(101, 10.0, [](double, double) { return 20.0; }),
                    .radar = {0.0, -1500.0, 400.0},
                    .grid = {.first_azimuth_rad = -0.4,
                             .azimuth_step_rad = 0.01,
                             .azimuths = 80,
                             .near_m = 100.0,
                             .step_m = 10.0,
                             .distances = 300}};
  const VisibleGround ground = found(scene, {});
  for (std::size_t azimuth = 0; azimuth < scene.grid.azimuths; ++azimuth) {
    const Vec2d outwards = radar::horizontal_direction(azimuth_of(scene.grid, azimuth));
    for (std::size_t k = 0; k < scene.grid.distances; ++k) {
      const Vec2d point = Vec2d{scene.radar.x, scene.radar.y} + outwards * distance_of(scene.grid, k);
      if (!scene.terrain.extent().contains(point)) continue;
      ASSERT_TRUE(is_seen(ground.horizon(), scene.radar, 20.0, azimuth, k)) << azimuth << " " << k;
    }
  }
}

TEST(VisibleGround, RasterizationTellsOfTerrainThatReachesUpToTheRadar) {
  const Scene scene =
      seen_from(made_up(101, 10.0, [](double x, double) { return x > 300.0 ? 500.0 : 0.0; }), 180.0, 5.0, 4e3, 8.0, 64);
  EXPECT_GT(found(scene, {.method = VisibilityMethod::Rasterization}).triangles_left_out(), 0U);
}

}  // namespace
}  // namespace sigmascape::live
