#include "sigmascape/simulate/map_tracer.h"

#include <algorithm>
#include <iterator>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/never_scanned.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/simulate/answering_ground.h"
#include "sigmascape/simulate/launch_for_map.h"
#include "sigmascape/simulate/part_seen.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/unhidden_echoes.h"
#include "sigmascape/trace/tile_progress.h"

namespace sigmascape::simulate {
namespace {

/// Bins after pulse and beam, and the median of their errors, ask for more paths of less each.
constexpr float survival_per_power = 1.0F;

/// Tells the lots of cells from other numbers that are made of seed and cell.
constexpr std::uint32_t lot_of_cell = 0x107;

void tell(const RayWatcher& watcher, const trace::TileEchoes& tile, UnhiddenEchoes& unhidden) {
  for (std::size_t start = 0; start < tile.starts.size(); ++start) {
    const auto echoes = unhidden.among(tile.paths->echoes(tile.frequency, start), tile.worker);
    watcher(tile.starts[start].cell, echoes, tile.worker);
  }
}

std::vector<radar::Echo> times(float factor, std::span<const radar::Echo> echoes) {
  std::vector<radar::Echo> multiplied(echoes.begin(), echoes.end());
  for (radar::Echo& echo : multiplied) echo.rcs_m2 = echo.rcs_m2 * factor;
  return multiplied;
}

/// The cells on which the lot falls.
std::vector<trace::LaunchCell> drawn_by_lot(const LaunchShare& share, std::uint64_t seed) {
  std::vector<trace::LaunchCell> drawn;
  std::ranges::copy_if(share.cells, std::back_inserter(drawn), [&](const trace::LaunchCell& cell) {
    return hashed(seed, lot_of_cell, static_cast<std::uint32_t>(cell.i), static_cast<std::uint32_t>(cell.j)) %
               share.one_in ==
           0;
  });
  return drawn;
}

}  // namespace

MapTracer::MapTracer(const scene::Scene& scene, const trace::SceneGeometry& geometry, const radar::Radar& radar,
                     const radar::Rectangle& area, const TraceSettings& settings, std::size_t orders)
    : scene_(scene),
      geometry_(geometry),
      radar_(radar),
      settings_(settings),
      launch_(launch_for_map(scene, geometry, radar,
                             answering_ground(radar, area, scene.extent, scene.terrain.lowest_m()), settings.cell_m)),
      bins_(bins_for(radar, area, scene.terrain)),
      surfaces_(trace::surface_models(scene, radar.frequency_hz)) {
  if (radar.mode == radar::Mode::RealBeam) radar::require_scanned(radar, area);
  for (std::size_t order = 0; order < orders; ++order)
    receivers_.push_back(std::make_unique<receiver::RangeAzimuthReceiver>(radar_, bins_));
}

MapTracer::~MapTracer() = default;

std::vector<radar::RangeAzimuthImage> MapTracer::map(std::span<const LaunchShare> shares, std::uint64_t seed,
                                                     trace::TraceCounts& counts, ProgressListener* progress,
                                                     const RayWatcher& watcher) {
  for (const auto& receiver : receivers_) receiver->clear();
  trace_shares(shares, seed, counts, progress, watcher);
  auto images = this->images();
  // Which come straight back.
  receiver::add_echoes(images.front(), radar_, echoes_of_targets());
  return images;
}

void MapTracer::trace_shares(std::span<const LaunchShare> shares, std::uint64_t seed, trace::TraceCounts& counts,
                             ProgressListener* progress, const RayWatcher& watcher) {
  const trace::PathTracer tracer(geometry_, surfaces_, launch_.viewpoint,
                                 {.max_bounces = settings_.max_bounces, .survival_per_power = survival_per_power},
                                 seed);
  std::vector<std::vector<trace::LaunchCell>> drawn(shares.size());
  std::vector<std::span<const trace::LaunchCell>> cells;  // [share]
  std::size_t tile_count = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (shares[i].one_in > 1) drawn[i] = drawn_by_lot(shares[i], seed);
    cells.emplace_back(shares[i].one_in > 1 ? drawn[i] : shares[i].cells);
    tile_count += trace::tiles_of(cells.back().size());
  }
  SilentProgress silent;
  trace::TileProgress tiles(progress != nullptr ? *progress : silent, "trace", "% of the map", 0.0, 100.0, 100.0,
                            tile_count);
  UnhiddenEchoes unhidden(scene_.extent, settings_.targets, radar_.position, thread_count(settings_.threads));
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const std::uint32_t samples = shares[i].samples_per_cell;
    const bool stands_for_itself = shares[i].one_in == 1;
    const auto factor = static_cast<float>(shares[i].one_in);
    const auto sink = [&](const trace::TileEchoes& tile) {
      if (watcher) tell(watcher, tile, unhidden);
      const auto multiplied = stands_for_itself ? std::vector<radar::Echo>() : times(factor, tile.echoes);
      add(unhidden.among(stands_for_itself ? tile.echoes : multiplied, tile.worker));
      if (tile.completes_tile) tiles.tile_done(tile.worker);
    };
    counts += tracer.trace(launch_, cells[i], {0, samples, samples}, settings_.threads, sink);
  }
  tiles.all_done();
}

void MapTracer::add(std::span<const radar::Echo> echoes) {
  if (receivers_.size() == 1) return receivers_.front()->add(echoes);
  for (const radar::Echo& echo : echoes) {
    const std::size_t order = std::min<std::size_t>(echo.bounces, receivers_.size());
    receivers_[order - 1]->add({&echo, 1});
  }
}

std::vector<radar::Echo> MapTracer::echoes_of_targets() const {
  std::vector<radar::Target> targets = targets_of(scene_);
  targets.insert(targets.end(), settings_.targets.begin(), settings_.targets.end());
  const auto seen = seen_targets(
      targets, 0.0, [&](Vec3d position) { return part_seen(geometry_, surfaces_, radar_.position, position); });
  return receiver::target_echoes(seen, radar_, {.dwell = settings_.dwell});
}

std::vector<radar::RangeAzimuthImage> MapTracer::images() const {
  std::vector<radar::RangeAzimuthImage> images;
  for (const auto& receiver : receivers_) images.push_back(receiver->image());
  return images;
}

}  // namespace sigmascape::simulate
