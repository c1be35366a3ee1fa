#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <optional>

#include "end_to_end/real_data.h"
#include "unit/render/line_of_sight.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/render/visible_ground.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/terrain/terrain_reader.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape {
namespace {

/// Bare terrain, with nothing on it.
scene::Scene bare(terrain::HeightField field) {
  scene::Scene scene;
  scene.extent = field.extent();
  scene.terrain = std::move(field);
  scene.materials.push_back({});
  scene.ground.grid = {scene.extent.west_m, scene.extent.north_m, scene.extent.width_m(), 1, 1};
  scene.ground.material = Array2D<scene::MaterialIndex>(1, 1, 0);
  return scene;
}

struct Place {
  const char* name;
  const char* file;
  geo::LocalFrame frame;
  double spacing_m, smooth_within_m, half_m;
};

/// Terrain shadows as the renderer finds them against the path tracer's own shadow rays, over the same flat Earth: the
/// tracer knows no curvature.
void expect_like_shadow_rays(const Place& place, double elevation_deg, render::VisibilityMethod method) {
  const auto path = end_to_end::data_folder() / place.file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there; set SIGMASCAPE_DATA";
  terrain::TerrainSource source;
  source.raster = {path, 1, ""};
  source.spacing_m = place.spacing_m;
  source.smooth_within_m = place.smooth_within_m;
  const radar::Rectangle wanted{-place.half_m, -place.half_m, place.half_m, place.half_m};
  const scene::Scene scene = bare(terrain::read_terrain(source, place.frame, wanted).field);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  const trace::FlushDenormals flush;

  constexpr double range_m = 12e3;
  const Vec3d radar = radar::position_seeing({0.0, 0.0, scene.terrain.height_at({0.0, 0.0})}, radians_from_deg(130.0),
                                             radians_from_deg(elevation_deg), range_m);
  const double distance_m = std::hypot(radar.x, radar.y);
  const double reach_m = 0.6 * place.half_m;
  // Nodes a quarter of a cell apart at most, compared at every so many.
  const auto every = static_cast<std::size_t>(std::ceil(2.0 * reach_m / 256.0 / (0.25 * place.spacing_m)));
  const render::HorizonGrid grid{.first_azimuth_rad = radians_from_deg(310.0) - reach_m / distance_m,
                                 .azimuth_step_rad = 2.0 * reach_m / distance_m / 256.0,
                                 .azimuths = 256,
                                 .near_m = distance_m - reach_m,
                                 .step_m = 2.0 * reach_m / 256.0 / static_cast<double>(every),
                                 .distances = 256 * every};
  render::VisibleGround visible_ground({.method = method, .raster = {.pixels_per_triangle = 128.0}});
  WorkerTeam team(1);
  visible_ground.reset(grid, false);
  visible_ground.find(0, grid.azimuths, radar, {.terrain = terrain::view_of(scene.terrain)}, team);
  std::size_t compared = 0, different = 0, hidden = 0;
  for (std::size_t azimuth = 0; azimuth < grid.azimuths; ++azimuth) {
    const Vec2d outwards = radar::horizontal_direction(render::azimuth_of(grid, azimuth));
    for (std::size_t k = 0; k < grid.distances; k += every) {
      const Vec2d foot = Vec2d{radar.x, radar.y} + outwards * render::distance_of(grid, k);
      // From a little above the tracer's own surface, which is one of triangles, so that the ray does not meet where it
      // starts.
      const Vec3d above{foot.x, foot.y, geometry.highest_m() + 1.0};
      trace::SurfaceHit hit;
      ASSERT_TRUE(geometry.intersect((above - geometry.origin()).to<float>(), {0.0F, 0.0F, -1.0F}, hit));
      const Vec3f start = hit.position + Vec3f{0.0F, 0.0F, 0.02F};
      const bool in_shadow =
          geometry.occluded(start, normalized(radar - geometry.origin() - start.to<double>()).to<float>());
      ++compared;
      hidden += in_shadow ? 1 : 0;
      different +=
          render::is_seen(visible_ground.horizon(), radar, scene.terrain.height_at(foot), azimuth, k) == in_shadow ? 1
                                                                                                                   : 0;
    }
  }
  EXPECT_GT(hidden, compared / 50);
  // What lies within the 2 cm that the rays are lifted by, and between the sweep's bilinear surface and triangles.
  validation::expect_close(
      {.group = "Terrain shadows",
       .name =
           fmt::format("{}, {}°, {}, share of samples that differ from shadow rays ({:.1f} % are hidden)", place.name,
                       elevation_deg, method == render::VisibilityMethod::HorizonSweep ? "sweep" : "raster",
                       100.0 * static_cast<double>(hidden) / static_cast<double>(compared)),
       .expected = 0.0,
       .measured = 100.0 * static_cast<double>(different) / static_cast<double>(compared),
       .tolerance = 0.6,
       .unit = "%",
       .source = "occlusion by the path tracer's rays"});
}

const Place bilbao{"Bilbao", "bilbao/dem_5m_utm30n.tif", {43.312, -2.986}, 5.0, 0.5, 1400.0};
const Place san_francisco{"San Francisco", "san_francisco/dem_3dep_1arcsec_4326.tif", {37.79, -122.41}, 20.0, 0.0,
                          3000.0};

TEST(TerrainShadow, OfBilbaoIsThatOfThePathTracer) {
  expect_like_shadow_rays(bilbao, 8.6, render::VisibilityMethod::HorizonSweep);
}

TEST(TerrainShadow, OfSanFranciscoIsThatOfThePathTracer) {
  expect_like_shadow_rays(san_francisco, 4.0, render::VisibilityMethod::HorizonSweep);
}

TEST(TerrainShadow, ByRasterizationIsThatOfThePathTracer) {
  expect_like_shadow_rays(bilbao, 8.6, render::VisibilityMethod::Rasterization);
}

}  // namespace
}  // namespace sigmascape
