#include "sigmascape/bake/patch_room.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/receiver/ground_accumulator.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/trace/launch.h"
#include "sigmascape/trace/multibounce_reach.h"
#include "sigmascape/trace/scene_heights.h"

namespace sigmascape::bake {
namespace {

/// As LookBaker::area_of takes the area before it spares rays, but with cells so large that some ten thousand fill it.
double cells_at(const scene::Scene& scene, const trace::SceneHeights& heights, double texel_m,
                const radar::Rectangle& target, const radar::Aspect& aspect) {
  constexpr double along_a_side = 256.0;
  const double lowest_m = heights.lowest_m, top_m = heights.highest_m + 1.0;
  const auto viewpoint = trace::Viewpoint::distant(aspect);
  const trace::MultibounceReach reach = trace::multibounce_reach(scene, viewpoint, target);
  const double slope = std::tan(aspect.elevation_rad);
  const double side_m = std::max(target.width_m(), target.height_m()) + (top_m - lowest_m) * (slope + 1.0 / slope) +
                        std::max(reach.before_m, reach.beside_m);
  const double coarse_m = std::max(texel_m, side_m / along_a_side), finer = coarse_m / texel_m;
  const auto area = trace::launch_area(viewpoint, target, coarse_m, lowest_m, top_m, reach);
  return static_cast<double>(area.cells.size()) * finer * finer;
}

}  // namespace

double cells_of_a_patch(const scene::Scene& scene, const BakeSettings& settings) {
  // All patches have the same side: the one about the scene's middle is cut off least by the edge.
  const radar::Rectangle patch = settings.patches.texels_of(settings.patches.patch_at(scene.extent.centre())).extent();
  const radar::Rectangle target = radar::common_part(patch, scene.extent);
  const auto [lowest_rad, highest_rad] = std::ranges::minmax(settings.aspects.elevations_rad);
  const double azimuth_rad = settings.aspects.azimuths_rad.front();
  const trace::SceneHeights heights = trace::heights_of(scene, footing_of(settings));
  const auto cells_seen_from = [&](double elevation_rad) {
    return cells_at(scene, heights, settings.patches.texel_m, target, {azimuth_rad, elevation_rad});
  };
  return std::max(cells_seen_from(lowest_rad), cells_seen_from(highest_rad));
}

double bytes_of_texels(const scene::Scene& scene, const BakeSettings& settings) {
  constexpr auto of_sums = static_cast<double>(receiver::GroundAccumulator::bytes_a_cell);
  const double texels = std::pow(static_cast<double>(settings.patches.texels_per_side), 2);
  // What came over several surfaces is summed up by itself as well where its noise is to be shared.
  const double sums = 1.0 + (settings.noise == Noise::Shared ? 1.0 : 0.0) +
                      (settings.buildings != Buildings::Baked ? 1.0 : 0.0);  // and so is what buildings return
  const bool has_relief =
      footing_of(settings) == trace::Footing::Terrain && scene.terrain.lowest_m() != scene.terrain.highest_m();
  const std::size_t side = settings.patches.texels_per_side;
  const double of_obstacles = scene::obstacle_raster_bytes({0.0, 0.0, settings.patches.texel_m, side, side});
  const double of_looks = texels * static_cast<double>(settings.aspects.frequencies_hz.size()) * sums * of_sums;
  // The parts of a texel that are of each material, and what they return together.
  const double of_mixture =
      texels * static_cast<double>(scene.ground.materials_laid().size() * sizeof(float) + sizeof(radar::Channels));
  const double of_ground = settings.shadows == Shadows::RunTime ? std::max(of_obstacles, of_mixture) : 0.0;
  return std::max(of_looks + (has_relief ? of_obstacles : 0.0), of_ground);
}

void check_room(const scene::Scene& scene, const BakeSettings& settings, double memory_bytes) {
  if (const double texels = bytes_of_texels(scene, settings); texels > memory_bytes) {
    throw Error("bake settings",
                fmt::format("a patch of {0} × {0} texels at {1} frequencies takes {2:.3g} GB of memory, and there are "
                            "{3:.3g}",
                            settings.patches.texels_per_side, settings.aspects.frequencies_hz.size(), texels / 1e9,
                            memory_bytes / 1e9),
                "use fewer texels a patch");
  }
  const double cells = cells_of_a_patch(scene, settings);
  const double bytes = cells * static_cast<double>(sizeof(trace::LaunchCell));
  if (bytes <= memory_bytes) return;
  throw Error("bake settings",
              fmt::format("with texels of {:g} m a patch sends rays to {:.2g} cells, of which the list alone takes "
                          "{:.3g} GB of memory, and there are {:.3g}",
                          settings.patches.texel_m, cells, bytes / 1e9, memory_bytes / 1e9),
              "use larger texels");
}

void check_room(const scene::Scene& scene, const BakeSettings& settings) {
  check_room(scene, settings, machine_memory_bytes());
}

}  // namespace sigmascape::bake
