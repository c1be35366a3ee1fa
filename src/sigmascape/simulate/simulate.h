#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/render/ground_renderer.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::simulate {

/// How finely LOD 0 samples the scene.
struct TraceSettings {
  double cell_m = 2.0;                  ///< side of the squares of ground that rays are aimed at
  std::uint32_t samples_per_cell = 64;  ///< rays a square
  int max_bounces = 8;                  ///< 1 to trace::most_bounces
  std::uint64_t seed = 1;
  unsigned threads = 0;
  /// Beside the scene's own: they answer where the scene lets them be seen, and their boxes hide what stands behind,
  /// at time zero.
  std::span<const radar::Target> targets = {};
  std::uint64_t dwell = 0;  ///< by which fluctuating targets are drawn
};

/// The receive bins for a radar that maps `area`; a real beam does so over a flat Earth.
[[nodiscard]] radar::RangeAzimuthGrid bins_for(const radar::Radar& radar, const radar::Rectangle& area,
                                               const terrain::HeightField& terrain,
                                               const radar::CurvedEarth& earth = radar::CurvedEarth::flat());

/// LOD 0: the whole scene on its terrain, path-traced, into the bins. Point targets answer where the scene lets them be
/// seen.
[[nodiscard]] radar::RangeAzimuthImage traced_image(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                                    const radar::Radar& radar, const radar::Rectangle& area,
                                                    const TraceSettings& settings, trace::TraceCounts& counts,
                                                    ProgressListener* progress = nullptr);

/// The same apart by number of bounces: image k holds what came back over k + 1 surfaces, the last of the `orders`
/// images also what came back over more. They add up to traced_image. Point targets are in the first.
[[nodiscard]] std::vector<radar::RangeAzimuthImage> traced_bounces(
    const scene::Scene& scene, const trace::SceneGeometry& geometry, const radar::Radar& radar,
    const radar::Rectangle& area, const TraceSettings& settings, std::size_t orders, trace::TraceCounts& counts,
    ProgressListener* progress = nullptr);

/// LOD ≥ 1: terrain and atlas, into the same bins. The targets of the settings answer where terrain and, of an atlas
/// that keeps the ground apart, houses and crowns let them be seen, and fluctuate by the dwell.
[[nodiscard]] radar::RangeAzimuthImage baked_image(const atlas::Atlas& atlas, const terrain::HeightField& terrain,
                                                   const radar::Radar& radar, const radar::Rectangle& area,
                                                   const render::RenderSettings& settings, render::RenderCounts& counts,
                                                   std::uint64_t dwell = 0);

}  // namespace sigmascape::simulate
