#include "sigmascape/trace/path_tracer.h"

#include <algorithm>

#include "sigmascape/base/parallel.h"
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
  std::vector<std::vector<std::vector<radar::Echo>>> echoes(thread_count(threads));
  for (auto& of_worker : echoes) of_worker.resize(surfaces_.size());
  const auto share = static_cast<float>(1.0 / samples.of);

  return trace_tiles(area, threads, [&](TilePaths& tile, unsigned worker) {
    for (auto& of_frequency : echoes[worker]) of_frequency.clear();
    for (const LaunchCell& cell : tile.cells()) {
      for (std::uint32_t sample = samples.first; sample < samples.first + samples.count; ++sample) {
        tile.follow(cell, 0, sample);
        for (std::size_t f = 0; f < surfaces_.size(); ++f) {
          for (radar::Echo echo : tile.echoes(f)) {
            echo.rcs_m2 = echo.rcs_m2 * share;
            echoes[worker][f].push_back(echo);
          }
        }
      }
    }
    for (std::size_t f = 0; f < surfaces_.size(); ++f) {
      sink({.echoes = echoes[worker][f], .frequency = f, .worker = worker});
    }
  });
}

TraceCounts PathTracer::trace_tiles(const LaunchArea& area, unsigned threads, const TileBody& body) const {
  const unsigned workers = thread_count(threads);
  std::vector<TraceCounts> counts(workers);
  parallel_for(area.tiles(), workers, [&](std::size_t tile, unsigned worker) {
    const FlushDenormals flush;
    const std::size_t first = tile * cells_per_tile;
    const auto cells = std::span(area.cells).subspan(first, std::min(cells_per_tile, area.cells.size() - first));
    TileTracer tracer(*geometry_, surfaces_, viewpoint_, options_, area, cells, seed_);
    body(tracer, worker);
    counts[worker] += tracer.counts();
  });

  TraceCounts total;
  for (const TraceCounts& part : counts) total += part;
  return total;
}

}  // namespace sigmascape::trace
