#include "sigmascape/simulate/simulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <utility>
#include <vector>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/simulate/coherent.h"
#include "sigmascape/simulate/launch_for_map.h"
#include "sigmascape/simulate/target_sight.h"
#include "sigmascape/simulate/unhidden_echoes.h"
#include "sigmascape/trace/tile_progress.h"

namespace sigmascape::simulate {
namespace {

/// Tells the lots of cells from other numbers that are made of seed and cell.
constexpr std::uint32_t lot_of_cell = 0x107;

/// Rays start this far above the highest point, and the radar must stand above their start.
constexpr double clearance_m = 1.0;

void check_above(const radar::Radar& radar, double highest_m) {
  if (radar.position.z <= highest_m + clearance_m) {
    throw Error("radar " + radar.name,
                fmt::format("stands at {:.0f} m, below the highest point of the scene at {:.0f} m", radar.position.z,
                            highest_m),
                "place the radar above the scene");
  }
}

/// Adds the echoes of the scene's point targets that the radar can see.
void add_point_targets(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                       const trace::Viewpoint& viewpoint, receiver::RangeAzimuthReceiver& receiver) {
  for (const scene::PointTarget& target : scene.point_targets) {
    const Vec3d position{target.position.x, target.position.y,
                         scene.terrain.height_at(target.position) + target.height_m};
    const Vec3f to_radar = viewpoint.direction_from(position).to<float>();
    if (geometry.occluded((position - geometry.origin()).to<float>(), to_radar)) continue;
    const radar::Echo echo{.range_m = viewpoint.range_of(position),
                           .cross = viewpoint.cross_of(position),
                           .rcs_m2 = target.rcs_m2,
                           .bounces = 1,
                           .sin_depression = to_radar.z};
    receiver.add({&echo, 1});
  }
}

/// A receiver for each number of bounces, the last for more of them as well.
class BounceReceivers {
 public:
  BounceReceivers(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid, std::size_t orders) : radar_(radar) {
    for (std::size_t order = 0; order < orders; ++order)
      receivers_.push_back(std::make_unique<receiver::RangeAzimuthReceiver>(radar, grid));
  }

  /// May be called from several threads at once.
  void add(std::span<const radar::Echo> echoes) {
    if (receivers_.size() == 1) return first().add(echoes);
    for (const radar::Echo& echo : echoes) {
      const std::size_t order = std::min<std::size_t>(echo.bounces, receivers_.size());
      receivers_[order - 1]->add({&echo, 1});
    }
  }

  [[nodiscard]] receiver::RangeAzimuthReceiver& first() { return *receivers_.front(); }

  [[nodiscard]] std::vector<radar::RangeAzimuthImage> images() const {
    std::vector<radar::RangeAzimuthImage> images;
    for (const auto& receiver : receivers_) {
      if (receiver->bins().overflows() > 0) {
        throw Error("map of radar " + radar_.name, "a bin is brighter than the sums can hold",
                    "use finer resolution or rougher materials");
      }
      images.push_back(receiver->image());
    }
    return images;
  }

 private:
  const radar::Radar& radar_;
  std::vector<std::unique_ptr<receiver::RangeAzimuthReceiver>> receivers_;
};

void tell(const RayWatcher& watcher, const trace::TileEchoes& tile) {
  for (std::size_t start = 0; start < tile.starts.size(); ++start)
    watcher(tile.starts[start].cell, tile.paths->echoes(tile.frequency, start), tile.worker);
}

std::vector<radar::Echo> times(float factor, std::span<const radar::Echo> echoes) {
  std::vector<radar::Echo> multiplied(echoes.begin(), echoes.end());
  for (radar::Echo& echo : multiplied) echo.rcs_m2 = echo.rcs_m2 * factor;
  return multiplied;
}

/// Leaves the cells on which the lot falls.
void draw_lots(LaunchShare& share, std::uint64_t seed) {
  std::erase_if(share.launch.cells, [&](const trace::LaunchCell& cell) {
    return hashed(seed, lot_of_cell, static_cast<std::uint32_t>(cell.i), static_cast<std::uint32_t>(cell.j)) %
               share.one_in !=
           0;
  });
}

}  // namespace

radar::RangeAzimuthGrid bins_for(const radar::Radar& radar, const radar::Rectangle& area,
                                 const terrain::HeightField& terrain) {
  // Of a straight edge that faces the radar the middle is nearer than its ends.
  const Vec2d nearest{std::clamp(radar.position.x, area.west_m, area.east_m),
                      std::clamp(radar.position.y, area.south_m, area.north_m)};
  std::array<Vec3d, 10> points;
  std::size_t count = 0;
  for (const double height : {static_cast<double>(terrain.lowest_m()), static_cast<double>(terrain.highest_m())}) {
    for (const double x : {area.west_m, area.east_m}) {
      for (const double y : {area.south_m, area.north_m}) points[count++] = {x, y, height};
    }
    points[count++] = {nearest.x, nearest.y, height};
  }
  return receiver::grid_covering(radar, points);
}

radar::RangeAzimuthImage traced_image(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                      const radar::Radar& radar, const radar::Rectangle& area,
                                      const TraceSettings& settings, trace::TraceCounts& counts,
                                      ProgressListener* progress) {
  return std::move(traced_bounces(scene, geometry, radar, area, settings, 1, counts, progress).front());
}

std::vector<radar::RangeAzimuthImage> traced_bounces(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                                     const radar::Radar& radar, const radar::Rectangle& area,
                                                     const TraceSettings& settings, std::size_t orders,
                                                     trace::TraceCounts& counts, ProgressListener* progress) {
  const LaunchShare all{launch_for_map(scene, geometry, radar, area, settings.cell_m), settings.samples_per_cell};
  return traced_bounces(scene, geometry, radar, {&all, 1}, settings, orders, counts, progress);
}

trace::LaunchArea launch_for_map(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                 const radar::Radar& radar, const radar::Rectangle& area, double cell_m) {
  check_above(radar, geometry.highest_m());
  const auto viewpoint = trace::Viewpoint::located(radar.position);
  auto launch = trace::launch_area(viewpoint, area, cell_m, geometry.lowest_m(), geometry.highest_m() + clearance_m,
                                   trace::multibounce_reach(scene, viewpoint, area));
  trace::spare_rays(launch, scene, geometry.footing());
  return launch;
}

std::vector<radar::RangeAzimuthImage> traced_bounces(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                                     const radar::Radar& radar, std::span<const LaunchShare> shares,
                                                     const TraceSettings& settings, std::size_t orders,
                                                     trace::TraceCounts& counts, ProgressListener* progress,
                                                     const RayWatcher& watcher) {
  const trace::LaunchArea& launch = shares.front().launch;
  const auto& viewpoint = launch.viewpoint;
  const auto surfaces = trace::surface_models(scene, radar.frequency_hz);
  const trace::PathTracer tracer(geometry, surfaces, viewpoint, {.max_bounces = settings.max_bounces}, settings.seed);
  BounceReceivers receivers(radar, bins_for(radar, launch.target, scene.terrain), orders);
  std::vector<LaunchShare> drawn(shares.begin(), shares.end());
  std::size_t tile_count = 0;
  for (LaunchShare& share : drawn) {
    if (share.one_in > 1) draw_lots(share, settings.seed);
    tile_count += share.launch.tiles();
  }
  SilentProgress silent;
  trace::TileProgress tiles(progress != nullptr ? *progress : silent, "trace", "% of the map", 0.0, 100.0, 100.0,
                            tile_count);
  UnhiddenEchoes unhidden(settings.targets, radar.position, thread_count(settings.threads));
  for (const LaunchShare& share : drawn) {
    const std::uint32_t samples = share.samples_per_cell;
    counts += tracer.trace(share.launch, {0, samples, samples}, settings.threads, [&](const trace::TileEchoes& tile) {
      if (watcher) tell(watcher, tile);
      const bool stands_for_itself = share.one_in == 1;
      const auto multiplied =
          stands_for_itself ? std::vector<radar::Echo>() : times(static_cast<float>(share.one_in), tile.echoes);
      receivers.add(unhidden.among(stands_for_itself ? tile.echoes : multiplied, tile.worker));
      tiles.tile_done(tile.worker);
    });
  }
  tiles.all_done();
  add_point_targets(scene, geometry, viewpoint, receivers.first());
  const auto seen = seen_targets(
      settings.targets, 0.0, [&](Vec3d position) { return part_seen(geometry, surfaces, radar.position, position); });
  receivers.first().add(receiver::target_echoes(seen, radar, {}));
  return receivers.images();
}

radar::RangeAzimuthImage baked_image(const atlas::Atlas& atlas, const terrain::HeightField& terrain,
                                     const radar::Radar& radar, const radar::Rectangle& area,
                                     const render::RenderSettings& settings, render::RenderCounts& counts) {
  check_above(radar, terrain.highest_m());
  auto image =
      render::GroundRenderer(atlas, terrain).render(radar, area, bins_for(radar, area, terrain), settings, counts);
  const auto* const apart = atlas.ground_layers();
  add_targets(image, radar, {terrain, apart != nullptr ? &apart->obstacles : nullptr}, settings.targets, {});
  return image;
}

}  // namespace sigmascape::simulate
