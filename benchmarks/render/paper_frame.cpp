#include "paper_frame.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "../bake/equal_noise.h"
#include "../bake/paper_look.h"
#include "frame_cost.h"
#include "made_ground.h"
#include "touched.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/base/units.h"
#include "sigmascape/render/ground_renderer.h"
#include "sigmascape/scene/mesh_counts.h"
#include "sigmascape/simulate/traced_to_error.h"

namespace sigmascape::bench {
namespace {

const radar::Aspect paper_view{radians_from_deg(130.0), radians_from_deg(8.6)};
constexpr double slant_range_m = 20e3;

/// The four looks about the view. How many rays a texel gets changes nothing in the time of a frame.
bake::BakeSettings settings_about_the_view(bool quick) {
  bake::BakeSettings settings;
  settings.aspects.azimuths_rad = {radians_from_deg(90.0), radians_from_deg(135.0)};
  settings.aspects.elevations_rad = {radians_from_deg(5.0), radians_from_deg(13.0)};
  settings.sampling.samples_per_texel = quick ? 2 : 8;
  return settings;
}

/// Bins over the whole scene, two texels a side.
struct WholeScene {
  live::LiveSettings settings;
  live::Pose pose;
  radar::RangeAzimuthGrid grid;

  WholeScene(const scene::Scene& scene, double texel_m) {
    const double turn = paper_view.azimuth_rad;
    const double side_m = scene.extent.width_m() * (std::abs(std::cos(turn)) + std::abs(std::sin(turn)));
    const double bin_m = 2.0 * texel_m, cosine = std::cos(paper_view.elevation_rad);
    const auto bins = static_cast<std::size_t>(std::ceil(side_m / bin_m));
    settings.beams = settings.ranges = bins;
    settings.range_step_m = bin_m * cosine;
    settings.beam_step_rad = bin_m / (slant_range_m * cosine);
    settings.cells_per_bin = 1.8;
    settings.refraction = 1e9;  // as level of detail 0 has it
    const auto centre = scene.extent.centre();
    pose.position = radar::position_seeing({centre.x, centre.y, scene.terrain.height_at(centre)},
                                           paper_view.azimuth_rad, paper_view.elevation_rad, slant_range_m);
    const double half = static_cast<double>(bins) / 2.0;
    pose.first_azimuth_rad = paper_view.azimuth_rad + pi - half * settings.beam_step_rad;
    pose.first_range_m = slant_range_m - half * settings.range_step_m;
    grid = {pose.first_range_m, settings.range_step_m, bins, pose.first_azimuth_rad, settings.beam_step_rad, bins};
  }
};

/// The frame's whole power is that of the map that is made of the same atlas without haste.
void prove_power(const std::shared_ptr<live::LiveGround>& ground, const atlas::Store& store, const scene::Scene& scene,
                 WholeScene view) {
  radar::Radar radar;
  radar.position = view.pose.position;
  radar.range_resolution_m = 2.0 * view.settings.range_step_m;
  radar.beam_width_rad = 2.0 * view.settings.beam_step_rad;
  const atlas::Atlas atlas = atlas::load_atlas(store);
  render::RenderCounts counts;
  const auto map = render::GroundRenderer(atlas, scene.terrain).render(radar, scene.extent, view.grid, {}, counts);
  double expected = 0.0, shown = 0.0;
  for (const radar::Channels& bin : map.rcs_m2.values()) expected += static_cast<double>(bin.vv);
  view.settings.content = live::FrameContent::Powers;
  live::LiveRenderer renderer(ground, view.settings);
  const live::Frame& frame = settled(renderer, *ground, view.pose);
  for (std::size_t bin = 0; bin < frame.powers_m2.size(); bin += 4) {
    shown += static_cast<double>(frame.powers_m2[bin]);
  }
  const double error_db = db_from_linear(shown / expected);
  prove(std::abs(error_db) < 0.3,
        fmt::format("a frame of the paper's scene has the power of its map ({:.2f} dB off)", error_db));
}

/// A square of that many metres with as much of town and forest as there is: the most pairs of a house and a tree.
radar::Rectangle town_and_forest(const scene::Scene& scene, double side_m) {
  radar::Rectangle best = scene.extent;
  double most = -1.0;
  for (double south = scene.extent.south_m; south + side_m <= scene.extent.north_m; south += side_m / 4.0) {
    for (double west = scene.extent.west_m; west + side_m <= scene.extent.east_m; west += side_m / 4.0) {
      const radar::Rectangle square{west, south, west + side_m, south + side_m};
      const auto holds = [&square](double x, double y) {
        return x >= square.west_m && x < square.east_m && y >= square.south_m && y < square.north_m;
      };
      const auto trees = std::ranges::count_if(scene.instances, [&](const scene::Instance& instance) {
        return holds(static_cast<double>(instance.x_m), static_cast<double>(instance.y_m));
      });
      const auto houses = std::ranges::count_if(scene.buildings.items, [&](const scene::Building& house) {
        const Vec3f& corner = scene.buildings.mesh.vertices[house.first_vertex];
        return holds(static_cast<double>(corner.x), static_cast<double>(corner.y));
      });
      const double pairs = static_cast<double>(trees) * static_cast<double>(houses);
      if (pairs > most) {
        most = pairs;
        best = square;
      }
    }
  }
  return best;
}

}  // namespace

void measure_paper_frame(const scene::Scene& scene, bool quick, Figures& figures) {
  const ScratchStore scratch;
  const bake::BakeSettings baking = settings_about_the_view(quick);
  SilentProgress silent;
  (void)bake::bake(scene, baking, scratch.folder() / "paper", silent);
  const atlas::Store store = atlas::Store::open(scratch.folder() / "paper");
  const auto ground = live::LiveGround::open(scratch.folder() / "paper", frequency_hz);
  const WholeScene view(scene, baking.patches.texel_m);
  prove_power(ground, store, scene, view);

  live::LiveRenderer renderer(ground, view.settings);
  const FrameCost cost = frame_cost(renderer, *ground, view.pose, quick ? 5 : 20);
  figures.add("render.paper_frame_ms", 1e3 * cost.wall, "ms",
              fmt::format("{} lattice cells, of which {} lie within the paper's scene", cost.report.cells,
                          cost.report.cells - cost.report.dark));
  figures.add("render.paper_frame_processor_ms", 1e3 * cost.processor, "ms", "all threads together");

  const Touched touched = touched_by(renderer.render(view.pose), view.settings, view.pose, *ground);
  const auto vertices = static_cast<double>(scene::mesh_counts(scene).instanced_vertices);
  figures.add("render.vertex_fraction", static_cast<double>(touched.terrain_nodes) / vertices, "1",
              fmt::format("{} nodes of terrain over {:.0f} vertices; besides {} squares of the map of obstacles",
                          touched.terrain_nodes, vertices, touched.obstacle_cells));
  figures.add("render.touched_mib", touched.bytes / 1048576.0, "MiB", "that a frame reads and writes");

  PaperLooks looks(scene, 10, 2);
  std::vector<bake::Sampling> samplings;
  for (const std::uint32_t samples : {32U, 64U, 128U, 256U}) samplings.push_back({.samples_per_texel = samples});
  const EqualNoise traced = equal_noise(looks, paper_view, 100, samplings);
  const double whole = 1.0 / looks.part_of(paper_view);
  figures.add("render.vs_full", traced.plain_seconds * whole / cost.processor, "1",
              fmt::format("plain paths, 100 rays and 8 bounces for each of 1024² cells: {:.0f} s; processor times",
                          traced.plain_seconds * whole));
  const double ours = std::max(traced.median_seconds, traced.l1_seconds);
  figures.add("render.vs_lod0", ours * whole / cost.processor, "1",
              fmt::format("our own paths to the noise of those: {:.0f} s", ours * whole));
}

void measure_traced_map(const scene::Scene& scene, Figures& figures) {
  constexpr double side_m = 512.0, cell_m = 2.0;
  const radar::Rectangle area = town_and_forest(scene, side_m);
  const Vec2d centre = area.centre();
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  radar::Radar radar;
  radar.position = radar::position_seeing({centre.x, centre.y, scene.terrain.height_at(centre)}, paper_view.azimuth_rad,
                                          paper_view.elevation_rad, slant_range_m);
  radar.range_resolution_m = cell_m * std::cos(paper_view.elevation_rad);
  radar.beam_width_rad = std::sqrt(2.0) * cell_m / slant_range_m;  // 2 m across, two-way
  trace::TraceCounts counts;
  const double wall = wall_seconds(), processor = processor_seconds();
  const auto traced = simulate::traced_to_error(scene, geometry, radar, area, {.cell_m = cell_m}, {}, counts);
  const double wall_taken = wall_seconds() - wall, processor_taken = processor_seconds() - processor;
  prove(traced.median_error_db <= 1.5, "a traced map reaches the error it is asked for");
  figures.add("render.lod0_seconds", 0.5 * processor_taken, "s",
              fmt::format("processor time over two cores (wall {:.1f} s) for 512 m × 512 m around ({:.0f}, {:.0f}), "
                          "up to {} rays a cell, median error {:.2f} dB",
                          wall_taken, centre.x, centre.y, traced.samples_per_cell, traced.median_error_db));
}

}  // namespace sigmascape::bench
