#include "sigmascape/render/visible_ground.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <optional>

#include "unit/render/line_of_sight.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/terrain/terrain_reader.h"

namespace sigmascape::render {
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
  GroundSector sector = {};
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
  scene.sector = {.first_azimuth_rad = radians_from_deg(azimuth_deg + 180.0) - 0.8 * half_m / distance_m,
                  .azimuth_step_rad = 1.6 * half_m / distance_m / static_cast<double>(azimuths),
                  .azimuths = azimuths,
                  .first_distance_m = first_m,
                  .distance_step_m = step_m,
                  .distances = static_cast<std::size_t>((distance_m + half_m - first_m) / step_m)};
  return scene;
}

/// Compares with the long way over the same surface: the bilinear one, or the triangles that are drawn of it.
void expect_like_lines_of_sight(const Scene& scene, const VisibleGroundSettings& settings, const char* name) {
  constexpr std::size_t every = 16;
  const auto surface = [&](Vec2d point) {
    return settings.method == VisibilityMethod::Rasterization ? height_of_triangles(scene.terrain, point)
                                                              : scene.terrain.height_at(point);
  };
  const auto truth =
      walked_lines_of_sight(scene.terrain, surface, scene.radar, scene.sector, settings.earth, every, 32.0);
  VisibleGround visible_ground(settings);
  GroundSamples samples;
  visible_ground.find(scene.radar, scene.sector, terrain::view_of(scene.terrain), samples);
  const Disagreement found = disagreement(truth, scene.sector, samples, every, 0.06 * scene.terrain.spacing_m);
  std::printf("  %s: %zu samples, %.1f %% hidden, %.4f %% differ, %zu of them away from silhouettes\n", name,
              found.compared, 100.0 * static_cast<double>(found.hidden) / static_cast<double>(found.compared),
              100.0 * found.share(), found.away_from_silhouettes);
  EXPECT_GT(found.hidden, found.compared / 100) << name;
  EXPECT_LT(found.share(), 1e-3) << name;
  // What falls between the pixel centres of a picture is lost to it: a sample in several thousand, anywhere.
  const std::size_t lost = settings.method == VisibilityMethod::Rasterization ? found.compared / 5000 : 0;
  EXPECT_LE(found.away_from_silhouettes, lost) << name;
}

class VisibleGroundByBothMethods : public ::testing::TestWithParam<VisibilityMethod> {};

/// Fine enough for one part in a thousand at grazing angles of a few degrees.
VisibleGroundSettings fine(VisibilityMethod method) {
  return {.method = method, .longest_step_cells = 0.125, .raster = {.pixels_per_triangle = 256.0}};
}

TEST_P(VisibleGroundByBothMethods, AgreesWithEveryLineOfSightOverBilbao) {
  const auto terrain = real_terrain("bilbao/dem_5m_utm30n.tif", {43.312, -2.986}, 5.0, 0.5, 700.0);
  if (!terrain) GTEST_SKIP() << "the folder bilbao is not in " << data_folder() << "; set SIGMASCAPE_DATA";
  expect_like_lines_of_sight(seen_from(*terrain, 30.0, 5.0, 20e3, 4.0, 512), fine(GetParam()), "Bilbao, 5°");
  expect_like_lines_of_sight(seen_from(*terrain, 130.0, 8.6, 10e3, 4.0, 512), fine(GetParam()), "Bilbao, 8.6°");
}

TEST_P(VisibleGroundByBothMethods, AgreesWithEveryLineOfSightOverSanFrancisco) {
  const auto terrain = real_terrain("san_francisco/dem_3dep_1arcsec_4326.tif", {37.79, -122.41}, 20.0, 0.0, 2800.0);
  if (!terrain) GTEST_SKIP() << "the folder san_francisco is not in " << data_folder() << "; set SIGMASCAPE_DATA";
  expect_like_lines_of_sight(seen_from(*terrain, 250.0, 3.0, 40e3, 16.0, 512), fine(GetParam()), "San Francisco, 3°");
}

/// Flags and layers of two runs, over the azimuths that count.
bool same(const GroundSamples& a, const GroundSamples& b) {
  for (std::size_t k = 0; k < a.distances(); ++k) {
    for (std::size_t azimuth = 0; azimuth < a.azimuths(); ++azimuth) {
      const std::size_t i = a.index(azimuth, k);
      if (a.visible()[i] != b.visible()[i] || a.range_excess_m()[i] != b.range_excess_m()[i] ||
          a.sin_local_grazing()[i] != b.sin_local_grazing()[i]) {
        return false;
      }
    }
  }
  return true;
}

double rolling(double x, double y) {
  return 60.0 + 50.0 * std::sin(0.011 * x + 0.004 * y) + 20.0 * std::cos(0.031 * y - 0.013 * x);
}

TEST_P(VisibleGroundByBothMethods, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = seen_from(made_up(201, 10.0, rolling), 70.0, 6.0, 9e3, 8.0, 200);
  GroundSamples one, three;
  VisibleGround({.method = GetParam(), .threads = 1})
      .find(scene.radar, scene.sector, terrain::view_of(scene.terrain), one);
  VisibleGround({.method = GetParam(), .threads = 3})
      .find(scene.radar, scene.sector, terrain::view_of(scene.terrain), three);
  EXPECT_TRUE(same(one, three));
}

TEST_P(VisibleGroundByBothMethods, LevelGroundIsSeenThroughoutUpToTheHorizon) {
  // From 100 m the sea is seen out to 41 km.
  const terrain::HeightField sea = made_up(301, 400.0, [](double, double) { return 0.0; });
  const GroundSector sector{.first_azimuth_rad = 0.0,
                            .azimuth_step_rad = 0.01,
                            .azimuths = 20,
                            .first_distance_m = 2000.0,
                            .distance_step_m = 200.0,
                            .distances = 270};
  GroundSamples samples;
  VisibleGround({.method = GetParam()}).find({0.0, 0.0, 100.0}, sector, terrain::view_of(sea), samples);
  const double horizon_m = radar::CurvedEarth().horizon_m(100.0);
  // Towards the horizon the rows of the oblique picture fall together: the last tenths of a degree are beyond it.
  const double blurred_m = GetParam() == VisibilityMethod::HorizonSweep ? 800.0 : 14e3;
  EXPECT_NEAR(horizon_m, 41.2e3, 0.1e3);
  for (std::size_t azimuth = 0; azimuth < sector.azimuths; ++azimuth) {
    for (std::size_t k = 0; k < sector.distances; ++k) {
      const double distance_m = sector.distance_m(k);
      if (std::abs(distance_m - horizon_m) < blurred_m) continue;
      ASSERT_EQ(samples.visible()[samples.index(azimuth, k)] == 1, distance_m < horizon_m) << distance_m;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, VisibleGroundByBothMethods,
                         ::testing::Values(VisibilityMethod::HorizonSweep, VisibilityMethod::Rasterization),
                         [](const auto& method) {
                           return method.param == VisibilityMethod::HorizonSweep ? "HorizonSweep" : "Rasterization";
                         });

TEST(VisibleGround, LayersAreThoseOfTheSurface) {
  const Scene scene = seen_from(made_up(201, 10.0, rolling), 200.0, 5.0, 9e3, 7.0, 48);
  GroundSamples samples;
  const auto counts = VisibleGround().find(scene.radar, scene.sector, terrain::view_of(scene.terrain), samples);
  EXPECT_EQ(counts.samples, scene.sector.azimuths * scene.sector.distances);
  const radar::CurvedEarth earth;
  std::size_t visible = 0, on_terrain = 0;
  for (std::size_t azimuth = 0; azimuth < scene.sector.azimuths; ++azimuth) {
    const Vec2d outwards = radar::horizontal_direction(scene.sector.azimuth_rad(azimuth));
    for (std::size_t k = 0; k < scene.sector.distances; ++k) {
      const double distance_m = scene.sector.distance_m(k);
      const Vec2d point = Vec2d{scene.radar.x, scene.radar.y} + outwards * distance_m;
      const double height_m = scene.terrain.height_at(point);
      const std::size_t i = samples.index(azimuth, k);
      visible += samples.visible()[i];
      if (!scene.terrain.extent().contains(point)) continue;
      ++on_terrain;
      ASSERT_NEAR(static_cast<double>(samples.height_m()[i]), height_m, 1e-3);
      ASSERT_NEAR(samples.slant_range_m(azimuth, k), earth.slant_range_m(scene.radar.z, height_m, distance_m), 2e-4);
      const double sine = earth.sin_grazing(scene.radar.z, height_m, distance_m);
      ASSERT_NEAR(static_cast<double>(samples.sin_grazing()[i]), sine, 1e-6);
      const double cosine = std::sqrt(1.0 - sine * sine);
      const Vec3d normal = scene.terrain.normal_at(point);
      const double local = dot(normal, {-outwards.x * cosine, -outwards.y * cosine, sine});
      ASSERT_NEAR(static_cast<double>(samples.sin_local_grazing()[i]), local, 2e-4) << azimuth << " " << k;
      ASSERT_NEAR(static_cast<double>(samples.slope_area()[i]), 1.0 / normal.z, 1e-4);
    }
  }
  EXPECT_EQ(visible, counts.visible);
  EXPECT_EQ(on_terrain, counts.on_terrain);
  EXPECT_GT(on_terrain, counts.samples / 2);
}

TEST(VisibleGround, RangeIsGoodToAPhaseAtAHundredKilometres) {
  const terrain::HeightField hill =
      made_up(64, 1000.0, [](double x, double y) { return 700.0 + 0.01 * x - 0.005 * y; });
  const Vec3d radar{0.0, -100e3, 9000.0};
  const GroundSector sector{
      .azimuth_step_rad = 0.001, .azimuths = 16, .first_distance_m = 90e3, .distance_step_m = 100.0, .distances = 200};
  GroundSamples samples;
  VisibleGround().find(radar, sector, terrain::view_of(hill), samples);
  const radar::CurvedEarth earth;
  for (std::size_t k = 0; k < sector.distances; ++k) {
    const double height_m = static_cast<double>(samples.height_m()[samples.index(3, k)]);
    // A hundredth of the wavelength at 10 GHz.
    ASSERT_NEAR(samples.slant_range_m(3, k), earth.slant_range_m(radar.z, height_m, sector.distance_m(k)), 3e-4);
  }
}

TEST(VisibleGround, GroundBeyondTheTerrainIsNeitherSeenNorHides) {
  const terrain::HeightField field = made_up(101, 10.0, [](double, double) { return 20.0; });
  const GroundSector sector{.first_azimuth_rad = -0.4,
                            .azimuth_step_rad = 0.01,
                            .azimuths = 80,
                            .first_distance_m = 100.0,
                            .distance_step_m = 10.0,
                            .distances = 300};
  const Vec3d radar{0.0, -1500.0, 400.0};
  GroundSamples samples;
  const auto counts = VisibleGround().find(radar, sector, terrain::view_of(field), samples);
  std::size_t inside = 0;
  for (std::size_t azimuth = 0; azimuth < sector.azimuths; ++azimuth) {
    for (std::size_t k = 0; k < sector.distances; ++k) {
      const Vec2d point =
          Vec2d{radar.x, radar.y} + radar::horizontal_direction(sector.azimuth_rad(azimuth)) * sector.distance_m(k);
      const bool here = field.extent().contains(point);
      inside += here ? 1 : 0;
      ASSERT_EQ(samples.visible()[samples.index(azimuth, k)], here ? 1 : 0) << azimuth << " " << k;
    }
  }
  EXPECT_EQ(counts.on_terrain, inside);
  EXPECT_LT(inside, counts.samples / 2);
}

TEST(VisibleGround, GivenSlopesAreInterpolated) {
  const terrain::HeightField field = made_up(101, 10.0, rolling);
  std::vector<terrain::PackedSlope> slopes(field.height_m.size(), {.east = 512, .north = -1024});
  terrain::TerrainView view = terrain::view_of(field);
  view.slope = slopes;
  const Vec3d radar{0.0, -3000.0, 900.0};
  const GroundSector sector{
      .azimuth_step_rad = 0.001, .azimuths = 20, .first_distance_m = 2700.0, .distance_step_m = 10.0, .distances = 50};
  GroundSamples samples;
  VisibleGround().find(radar, sector, view, samples);
  EXPECT_NEAR(static_cast<double>(samples.slope_area()[samples.index(5, 20)]), std::sqrt(1.0 + 0.0625 + 0.25), 1e-5);
}

TEST(VisibleGround, RasterizationTellsOfTerrainThatReachesUpToTheRadar) {
  const Scene scene =
      seen_from(made_up(101, 10.0, [](double x, double) { return x > 300.0 ? 500.0 : 0.0; }), 180.0, 5.0, 4e3, 8.0, 64);
  GroundSamples samples;
  const auto counts = VisibleGround({.method = VisibilityMethod::Rasterization})
                          .find(scene.radar, scene.sector, terrain::view_of(scene.terrain), samples);
  EXPECT_GT(counts.triangles_left_out, 0U);
}

}  // namespace
}  // namespace sigmascape::render
