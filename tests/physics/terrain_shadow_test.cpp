#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <optional>

#include "end_to_end/real_data.h"
#include "unit/live/line_of_sight.h"
#include "unit/live/live_ground_example.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/live/visible_ground.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/scatterer_lattice.h"
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
  const char* file;  ///< of real terrain; null: hills made up
  geo::LocalFrame frame;
  double spacing_m, smooth_within_m, half_m;
};

std::filesystem::path file_of(const Place& place) {
  return end_to_end::data_folder() / place.file;
}

bool is_missing(const Place& place) {
  return place.file != nullptr && !std::filesystem::exists(file_of(place));
}

/// Waves of lengths that have nothing in common, across one another, and so no two hills alike; they sink towards the
/// edge, beyond which tracer and sweep each go on in their own way.
double made_up_hills_m(Vec2d at, double half_m) {
  struct Wave {
    double height_m, length_m, azimuth_deg;
  };
  double sum_m = -0.4 * std::max(0.0, std::max(std::abs(at.x), std::abs(at.y)) - 0.75 * half_m);
  for (const Wave& wave : {Wave{60.0, 907.0, 20.0}, {35.0, 613.0, 118.0}, {20.0, 311.0, 61.0}, {3.0, 127.0, 160.0}}) {
    const Vec2d along = radar::horizontal_direction(radians_from_deg(wave.azimuth_deg));
    sum_m += wave.height_m * std::cos(2.0 * pi / wave.length_m * dot(along, at));
  }
  return sum_m;
}

terrain::HeightField made_up_hills(const Place& place) {
  const auto nodes = static_cast<std::size_t>(2.0 * place.half_m / place.spacing_m) + 1;
  terrain::HeightField field{.west_m = -place.half_m,
                             .north_m = place.half_m,
                             .spacing_m = place.spacing_m,
                             .height_m = Array2D<float>(nodes, nodes)};
  for (std::size_t row = 0; row < nodes; ++row) {
    for (std::size_t column = 0; column < nodes; ++column) {
      const Vec2d node{field.west_m + static_cast<double>(column) * field.spacing_m,
                       field.north_m - static_cast<double>(row) * field.spacing_m};
      field.height_m(column, row) = static_cast<float>(made_up_hills_m(node, place.half_m));
    }
  }
  return field;
}

scene::Scene bare_ground_of(const Place& place) {
  if (place.file == nullptr) return bare(made_up_hills(place));
  terrain::TerrainSource source;
  source.raster = {file_of(place), 1, ""};
  source.spacing_m = place.spacing_m;
  source.smooth_within_m = place.smooth_within_m;
  const radar::Rectangle wanted{-place.half_m, -place.half_m, place.half_m, place.half_m};
  return bare(terrain::read_terrain(source, place.frame, wanted).field);
}

/// Terrain shadows as the renderer finds them against the path tracer's own shadow rays, over the same flat Earth: the
/// tracer knows no curvature.
void expect_like_shadow_rays(const Place& place, double elevation_deg, live::VisibilityMethod method) {
  if (is_missing(place)) GTEST_SKIP() << file_of(place) << " is not there; set SIGMASCAPE_DATA";
  const scene::Scene scene = bare_ground_of(place);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  const trace::FlushDenormals flush;

  constexpr double range_m = 12e3;
  const Vec3d radar = radar::position_seeing({0.0, 0.0, scene.terrain.height_at({0.0, 0.0})}, radians_from_deg(130.0),
                                             radians_from_deg(elevation_deg), range_m);
  const double distance_m = std::hypot(radar.x, radar.y);
  const double reach_m = 0.6 * place.half_m;
  // Nodes a quarter of a cell apart at most, compared at every so many.
  const auto every = static_cast<std::size_t>(std::ceil(2.0 * reach_m / 256.0 / (0.25 * place.spacing_m)));
  const live::HorizonGrid grid{.first_azimuth_rad = radians_from_deg(310.0) - reach_m / distance_m,
                               .azimuth_step_rad = 2.0 * reach_m / distance_m / 256.0,
                               .azimuths = 256,
                               .near_m = distance_m - reach_m,
                               .step_m = 2.0 * reach_m / 256.0 / static_cast<double>(every),
                               .distances = 256 * every};
  live::VisibleGround visible_ground({.method = method, .raster = {.pixels_per_triangle = 128.0}});
  WorkerTeam team(1);
  visible_ground.reset(grid, false);
  visible_ground.find(0, grid.azimuths, radar, {.terrain = terrain::view_of(scene.terrain)}, team);
  std::size_t compared = 0, different = 0, hidden = 0;
  for (std::size_t azimuth = 0; azimuth < grid.azimuths; ++azimuth) {
    const Vec2d outwards = radar::horizontal_direction(live::azimuth_of(grid, azimuth));
    for (std::size_t k = 0; k < grid.distances; k += every) {
      const Vec2d foot = Vec2d{radar.x, radar.y} + outwards * live::distance_of(grid, k);
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
          live::is_seen(visible_ground.horizon(), radar, scene.terrain.height_at(foot), azimuth, k) == in_shadow ? 1
                                                                                                                 : 0;
    }
  }
  EXPECT_GT(hidden, compared / 50);
  // What lies within the 2 cm that the rays are lifted by, and between the sweep's bilinear surface and triangles.
  validation::expect_close(
      {.group = "Terrain shadows",
       .name =
           fmt::format("{}, {}°, {}, share of samples that differ from shadow rays ({:.1f} % are hidden)", place.name,
                       elevation_deg, method == live::VisibilityMethod::HorizonSweep ? "sweep" : "raster",
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
const Place hills{"made-up hills", nullptr, {}, 5.0, 0.0, 1000.0};

TEST(TerrainShadow, OfMadeUpHillsIsThatOfThePathTracer) {
  expect_like_shadow_rays(hills, 6.0, live::VisibilityMethod::HorizonSweep);
  expect_like_shadow_rays(hills, 6.0, live::VisibilityMethod::Rasterization);
}

TEST(TerrainShadow, OfBilbaoIsThatOfThePathTracer) {
  expect_like_shadow_rays(bilbao, 8.6, live::VisibilityMethod::HorizonSweep);
}

TEST(TerrainShadow, OfSanFranciscoIsThatOfThePathTracer) {
  expect_like_shadow_rays(san_francisco, 4.0, live::VisibilityMethod::HorizonSweep);
}

/// An atlas of constant-gamma ground, the same in all looks, about the origin.
atlas::Store gamma_store(const std::filesystem::path& folder, double gamma, double texel_m, double half_m) {
  atlas::AtlasDescription description;
  description.name = "level reflectivity";
  description.patches = {.texel_m = texel_m, .texels_per_side = atlas::tile_side};
  const double side_m = description.patches.side_m(), reach_m = std::ceil(half_m / side_m) * side_m;
  description.extent = {-reach_m, -reach_m, reach_m, reach_m};
  description.aspects.azimuths_rad = {0.0};
  description.aspects.elevations_rad = {radians_from_deg(2.0), radians_from_deg(30.0)};
  description.aspects.frequencies_hz = {10e9};
  description.scene_hash = "none";
  atlas::Store store = atlas::Store::create(folder, description);
  live::ExampleGround::write(store, [gamma](const radar::Look& look) { return live::constant_gamma(gamma, look); });
  atlas::Pyramid(store).make_above(store.units());
  return store;
}

/// A live frame over real terrain against the same sum over the same scatterers, each of which a shadow ray of the path
/// tracer lets pass or not.
void expect_frame_like_shadow_rays(const Place& place, double elevation_deg) {
  if (is_missing(place)) GTEST_SKIP() << file_of(place) << " is not there; set SIGMASCAPE_DATA";
  const scene::Scene scene = bare_ground_of(place);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  const trace::FlushDenormals flush;

  // Texels that tell the terrain's own shape.
  const double gamma = 0.1, texel_m = place.spacing_m < 8.0 ? 4.0 : 8.0;
  const ScratchFolder folder;
  const atlas::Store store = gamma_store(folder.path("atlas"), gamma, texel_m, place.half_m);
  const auto ground = std::make_shared<live::LiveGround>(store, scene.terrain, 10e9);
  const double ground_m = scene.terrain.height_at({0.0, 0.0});
  live::ExampleView view;
  view.target = {};
  view.azimuth_deg = 130.0;
  view.elevation_deg = elevation_deg;
  view.slant_range_m = 12e3;
  view.bin_m = 16.0;
  view.beams = view.ranges = static_cast<std::size_t>(place.half_m / view.bin_m);
  live::LiveSettings settings = view.settings(live::FrameContent::Powers);
  settings.cells_per_bin = 0.9 * view.bin_m / texel_m;
  live::Pose pose = view.pose();
  pose.position.z += ground_m;
  live::LiveRenderer renderer(ground, settings);
  const live::Frame& frame = live::settled_frame(renderer, *ground, pose);
  ASSERT_EQ(frame.report.coarse, 0U);
  ASSERT_EQ(frame.report.level, 0U);

  // Every scatterer of the lattice that the bins may hold, shared between bins as the frame shares them.
  const radar::ScattererLattice lattice({.seed = settings.seed, .cell_m = texel_m, .levels = 1});
  const radar::RangeAzimuthGrid& grid = frame.grid;
  Array2D<double> expected(grid.ranges, grid.azimuths, 0.0);
  std::size_t hidden = 0, looked_at = 0;
  const auto cells = static_cast<std::int32_t>(place.half_m / texel_m);
  for (std::int32_t row = -cells; row < cells; ++row) {
    for (std::int32_t column = -cells; column < cells; ++column) {
      const Vec2d at = lattice.position_in({column, row}, 0);
      const Vec3d foot{at.x, at.y, scene.terrain.height_at(at)};
      const Vec3d away = pose.position - foot;
      const double range_m = length(away);
      const double beam = wrapped_azimuth(std::atan2(-away.x, -away.y) - grid.first_azimuth_rad + pi) - pi;
      const double b = beam / grid.azimuth_step_rad - 0.5, r = (range_m - grid.first_range_m) / grid.range_step_m - 0.5;
      if (!(b >= 0.0 && r >= 0.0 && b < static_cast<double>(grid.azimuths) - 1.0 &&
            r < static_cast<double>(grid.ranges) - 1.0)) {
        continue;
      }
      trace::SurfaceHit hit;
      const Vec3d above{at.x, at.y, geometry.highest_m() + 1.0};
      ASSERT_TRUE(geometry.intersect((above - geometry.origin()).to<float>(), {0.0F, 0.0F, -1.0F}, hit));
      const Vec3f start = hit.position + Vec3f{0.0F, 0.0F, 0.02F};
      ++looked_at;
      if (geometry.occluded(start, normalized(pose.position - geometry.origin() - start.to<double>()).to<float>())) {
        ++hidden;
        continue;
      }
      const double power = gamma * away.z / range_m * texel_m * texel_m;
      const auto first_b = static_cast<std::size_t>(b), first_r = static_cast<std::size_t>(r);
      const double next_b = b - std::floor(b), next_r = r - std::floor(r);
      expected(first_r, first_b) += power * (1.0 - next_b) * (1.0 - next_r);
      expected(first_r + 1, first_b) += power * (1.0 - next_b) * next_r;
      expected(first_r, first_b + 1) += power * next_b * (1.0 - next_r);
      expected(first_r + 1, first_b + 1) += power * next_b * next_r;
    }
  }
  EXPECT_GT(hidden, looked_at / 50);
  double total = 0.0, shown = 0.0, different = 0.0;
  for (std::size_t beam = 1; beam + 1 < grid.azimuths; ++beam) {
    for (std::size_t range = 1; range + 1 < grid.ranges; ++range) {
      const auto power = static_cast<double>(frame.powers_m2[(beam * grid.ranges + range) * 4]);
      total += expected(range, beam);
      shown += power;
      different += std::abs(power - expected(range, beam));
    }
  }
  const std::string name =
      fmt::format("live frame, {}, {}° ({:.1f} % of the scatterers are hidden)", place.name, elevation_deg,
                  100.0 * static_cast<double>(hidden) / static_cast<double>(looked_at));
  validation::expect_close({.group = "Terrain shadows",
                            .name = name + ", whole power",
                            .expected = 0.0,
                            .measured = db_from_linear(shown / total),
                            .tolerance = 0.1,
                            .unit = "dB",
                            .source = "occlusion by the path tracer's rays"});
  // A frame knows its horizon at the edges of beams and twice a bin of range: what lies within half of that of a
  // silhouette may be shown or hidden.
  validation::expect_close({.group = "Terrain shadows",
                            .name = name + ", power that lies in other bins",
                            .expected = 0.0,
                            .measured = 100.0 * different / total,
                            .tolerance = 4.0,
                            .unit = "%",
                            .source = "occlusion by the path tracer's rays"});
}

TEST(TerrainShadow, OfLiveFramesOverMadeUpHillsIsThatOfThePathTracer) {
  expect_frame_like_shadow_rays(hills, 6.0);
}

TEST(TerrainShadow, OfLiveFramesOverBilbaoIsThatOfThePathTracer) {
  expect_frame_like_shadow_rays(bilbao, 8.6);
}

TEST(TerrainShadow, OfLiveFramesOverSanFranciscoIsThatOfThePathTracer) {
  expect_frame_like_shadow_rays(san_francisco, 4.0);
}

TEST(TerrainShadow, ByRasterizationIsThatOfThePathTracer) {
  expect_like_shadow_rays(bilbao, 8.6, live::VisibilityMethod::Rasterization);
}

}  // namespace
}  // namespace sigmascape
