#include "sigmascape/trace/path_tracer.h"

#include <algorithm>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/sobol.h"
#include "sigmascape/trace/tile_tracer.h"

namespace sigmascape::trace {

std::vector<scatter::SurfaceModel> surface_models(const scene::Scene& scene, double frequency_hz) {
  std::vector<scatter::SurfaceModel> models;
  models.reserve(scene.materials.size());
  for (const auto& material : scene.materials) models.emplace_back(material, frequency_hz);
  return models;
}

SpectralSurfaces surface_models(const scene::Scene& scene, std::span<const double> frequencies_hz) {
  SpectralSurfaces surfaces;
  surfaces.reserve(frequencies_hz.size());
  for (const double frequency_hz : frequencies_hz) surfaces.push_back(surface_models(scene, frequency_hz));
  return surfaces;
}

PathTracer::PathTracer(const SceneGeometry& geometry, SpectralSurfaces surfaces, const Viewpoint& viewpoint,
                       const PathOptions& options, std::uint64_t seed)
    : geometry_(&geometry), surfaces_(std::move(surfaces)), viewpoint_(viewpoint), options_(options), seed_(seed) {}

PathTracer::PathTracer(const SceneGeometry& geometry, std::vector<scatter::SurfaceModel> surfaces,
                       const Viewpoint& viewpoint, const PathOptions& options, std::uint64_t seed)
    : PathTracer(geometry, SpectralSurfaces{std::move(surfaces)}, viewpoint, options, seed) {}

TraceCounts PathTracer::trace(const LaunchArea& area, SampleRange samples, unsigned threads,
                              const EchoSink& sink) const {
  return trace(area, samples, threads, [&](const TileEchoes& tile) { sink(tile.echoes, tile.worker); });
}

TraceCounts PathTracer::trace(const LaunchArea& area, SampleRange samples, unsigned threads,
                              const TileSink& sink) const {
  const unsigned workers = thread_count(threads);
  std::vector<std::vector<std::vector<radar::Echo>>> echoes(workers);
  for (auto& of_worker : echoes) of_worker.resize(surfaces_.size());
  std::vector<TraceCounts> counts(workers);
  const double sample_area_m2 = area.cell_m * area.cell_m / samples.of;

  parallel_for(area.tiles(), workers, [&](std::size_t tile, unsigned worker) {
    const FlushDenormals flush;
    for (auto& of_frequency : echoes[worker]) of_frequency.clear();
    TileTracer tracer(*geometry_, surfaces_, viewpoint_, options_, area, echoes[worker], counts[worker]);
    const std::size_t end = std::min(area.cells.size(), (tile + 1) * cells_per_tile);
    for (std::size_t index = tile * cells_per_tile; index < end; ++index) {
      const LaunchCell cell = area.cells[index];
      const std::uint64_t key = hashed(seed_, static_cast<std::uint32_t>(cell.i), static_cast<std::uint32_t>(cell.j));
      for (std::uint32_t sample = samples.first; sample < samples.first + samples.count; ++sample) {
        const SobolPoint point(key, sample);
        const Vec2f within = point.pair(0);
        tracer.trace_path({(cell.i + static_cast<double>(within.x)) * area.cell_m,
                           (cell.j + static_cast<double>(within.y)) * area.cell_m},
                          sample_area_m2, point);
      }
    }
    for (std::size_t f = 0; f < surfaces_.size(); ++f) {
      sink({.echoes = echoes[worker][f], .frequency = f, .worker = worker});
    }
  });

  TraceCounts total;
  for (const TraceCounts& part : counts) total += part;
  return total;
}

}  // namespace sigmascape::trace
