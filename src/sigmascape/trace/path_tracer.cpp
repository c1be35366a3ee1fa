#include "sigmascape/trace/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/trace/tile_tracer.h"

namespace sigmascape::trace {
namespace {

/// What the paths of a tile bring back at one frequency.
struct EchoList {
  std::vector<radar::Echo> echoes;
  std::vector<radar::ComplexChannels> amplitudes_m;

  /// Takes the place of what was there; so many starts stand for a whole cell of the target.
  void take(const TilePaths& tile, std::size_t frequency, std::span<const PathStart> starts, std::uint32_t a_cell) {
    echoes.clear();
    amplitudes_m.clear();
    for (std::size_t start = 0; start < starts.size(); ++start) {
      const float power_share = 1.0F / (static_cast<float>(a_cell) * starts[start].cell.share);
      const float root_share = std::sqrt(power_share);
      for (radar::Echo echo : tile.echoes(frequency, start)) {
        echo.rcs_m2 = echo.rcs_m2 * power_share;
        echoes.push_back(echo);
      }
      for (const radar::ComplexChannels& amplitude : tile.amplitudes_m(frequency, start))
        amplitudes_m.push_back(amplitude * root_share);
    }
  }
};

}  // namespace

std::vector<scatter::SurfaceModel> surface_models(const scene::Scene& scene, double frequency_hz) {
  std::vector<scatter::SurfaceModel> models;
  models.reserve(scene.materials.size());
  std::vector<bool> used;
  for (const auto& material : scene.materials) {
    const auto known = scatter::known_frequencies(material);
    const bool is_known = std::ranges::any_of(known, [&](const auto& range) { return range.holds(frequency_hz); });
    if (!is_known && used.empty()) used = scene::used_materials(scene);
    // Of what lies nowhere, as the material of classes that a raster lacks, no ray asks anything.
    const bool stands_in = !is_known && !known.empty() && !used[models.size()];
    models.emplace_back(material, stands_in ? known.front().lowest_hz : frequency_hz);
  }
  return models;
}

SpectralSurfaces surface_models(const scene::Scene& scene, std::span<const double> frequencies_hz) {
  SpectralSurfaces surfaces;
  surfaces.reserve(frequencies_hz.size());
  for (const double frequency_hz : frequencies_hz) surfaces.push_back(surface_models(scene, frequency_hz));
  return surfaces;
}

namespace {

/// Paths of a tile that are followed together: enough for wide packets, few enough that however many samples a cell has
/// take no more memory.
constexpr std::size_t most_starts = 16384;

}  // namespace

void check_bounces(int max_bounces, const std::string& where) {
  if (max_bounces < 1 || max_bounces > most_bounces)
    throw Error(where, fmt::format("{} bounces", max_bounces), fmt::format("use 1 to {}", most_bounces));
}

SampleRange samples_for(const LaunchCell& cell, const SampleRange& samples, std::uint64_t seed) {
  const double share = static_cast<double>(cell.share);
  const double lot = static_cast<double>(
      unit_float(hashed(seed, static_cast<std::uint32_t>(cell.i), static_cast<std::uint32_t>(cell.j))));
  const auto number = [&](std::uint32_t sample) { return static_cast<std::uint32_t>(sample * share + lot); };
  const std::uint32_t first = number(samples.first);
  return {.first = first, .count = number(samples.first + samples.count) - first, .of = samples.of};
}

PathTracer::PathTracer(const SceneGeometry& geometry, SpectralSurfaces surfaces, const Viewpoint& viewpoint,
                       const PathOptions& options, std::uint64_t seed)
    : geometry_(&geometry), surfaces_(std::move(surfaces)), viewpoint_(viewpoint), options_(options), seed_(seed) {
  check_bounces(options.max_bounces, "path tracer");
}

PathTracer::PathTracer(const SceneGeometry& geometry, std::vector<scatter::SurfaceModel> surfaces,
                       const Viewpoint& viewpoint, const PathOptions& options, std::uint64_t seed)
    : PathTracer(geometry, SpectralSurfaces{std::move(surfaces)}, viewpoint, options, seed) {}

TraceCounts PathTracer::trace(const LaunchArea& area, SampleRange samples, unsigned threads,
                              const EchoSink& sink) const {
  return trace(area, samples, threads, [&](const TileEchoes& tile) { sink(tile.echoes, tile.worker); });
}

TraceCounts PathTracer::trace(const LaunchArea& area, SampleRange samples, unsigned threads,
                              const TileSink& sink) const {
  return trace(area, area.cells, samples, threads, sink);
}

TraceCounts PathTracer::trace(const LaunchArea& area, std::span<const LaunchCell> cells, SampleRange samples,
                              unsigned threads, const TileSink& sink) const {
  std::vector<std::vector<EchoList>> lists(thread_count(threads), std::vector<EchoList>(surfaces_.size()));
  return trace_tiles(area, cells, threads, [&](TilePaths& tile, unsigned worker) {
    std::vector<PathStart> starts;
    const auto follow = [&](bool completes_tile) {
      tile.follow(starts);
      for (std::size_t f = 0; f < surfaces_.size(); ++f) {
        EchoList& list = lists[worker][f];
        list.take(tile, f, starts, samples.of);
        sink({.echoes = list.echoes,
              .amplitudes_m = list.amplitudes_m,
              .frequency = f,
              .worker = worker,
              .starts = starts,
              .paths = &tile,
              .completes_tile = completes_tile});
      }
      starts.clear();
    };
    for (const LaunchCell& cell : tile.cells()) {
      const SampleRange of_cell = samples_for(cell, samples, seed_);
      for (std::uint32_t sample = 0; sample < of_cell.count; ++sample) {
        if (starts.size() == most_starts) follow(false);
        starts.push_back({.cell = cell, .sequence = 0, .sample = of_cell.first + sample});
      }
    }
    follow(true);
  });
}

TraceCounts PathTracer::trace_tiles(const LaunchArea& area, unsigned threads, const TileBody& body) const {
  return trace_tiles(area, area.cells, threads, body);
}

TraceCounts PathTracer::trace_tiles(const LaunchArea& area, std::span<const LaunchCell> cells, unsigned threads,
                                    const TileBody& body) const {
  // One tracer a thread, made by the thread itself: what it needs for a tile it has ready for the next.
  std::vector<std::unique_ptr<TileTracer>> tracers(thread_count(threads));
  parallel_for(tiles_of(cells.size()), static_cast<unsigned>(tracers.size()), [&](std::size_t tile, unsigned worker) {
    const FlushDenormals flush;
    auto& tracer = tracers[worker];
    if (!tracer) tracer = std::make_unique<TileTracer>(*geometry_, surfaces_, viewpoint_, options_, area, seed_);
    const std::size_t first = tile * cells_per_tile;
    tracer->begin(cells.subspan(first, std::min(cells_per_tile, cells.size() - first)));
    body(*tracer, worker);
  });

  TraceCounts total;
  for (const auto& tracer : tracers) {
    if (tracer) total += tracer->counts();
  }
  return total;
}

}  // namespace sigmascape::trace
