#include "sigmascape/simulate/simulate.h"

#include <array>
#include <utility>
#include <vector>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/radar/never_scanned.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/simulate/answering_ground.h"
#include "sigmascape/simulate/coherent.h"
#include "sigmascape/simulate/launch_for_map.h"
#include "sigmascape/simulate/map_tracer.h"
#include "sigmascape/simulate/part_seen.h"

namespace sigmascape::simulate {

radar::RangeAzimuthGrid bins_for(const radar::Radar& radar, const radar::Rectangle& area,
                                 const terrain::HeightField& terrain, const radar::CurvedEarth& earth) {
  const Vec2d foot{radar.position.x, radar.position.y};
  // Of a straight edge that faces the radar the middle is nearer than its ends.
  const Vec2d nearest = radar::nearest_point(area, foot);
  std::array<Vec3d, 10> points;
  std::size_t count = 0;
  for (const double height : {static_cast<double>(terrain.lowest_m()), static_cast<double>(terrain.highest_m())}) {
    for (const double x : {area.west_m, area.east_m}) {
      for (const double y : {area.south_m, area.north_m}) points[count++] = earth.bent({x, y, height}, foot);
    }
    points[count++] = earth.bent({nearest.x, nearest.y, height}, foot);
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
  MapTracer tracer(scene, geometry, radar, area, settings, orders);
  const LaunchShare all{tracer.launch().cells, settings.samples_per_cell};
  return tracer.map({&all, 1}, settings.seed, counts, progress);
}

radar::RangeAzimuthImage baked_image(const atlas::Atlas& atlas, const terrain::HeightField& terrain,
                                     const radar::Radar& radar, const radar::Rectangle& area,
                                     const render::RenderSettings& settings, render::RenderCounts& counts,
                                     std::uint64_t dwell) {
  check_above(radar, terrain.highest_m());
  radar::require_scanned(radar, area);
  const radar::Rectangle answering = answering_ground(radar, area, terrain.extent(), terrain.lowest_m());
  auto image =
      render::GroundRenderer(atlas, terrain).render(radar, answering, bins_for(radar, area, terrain), settings, counts);
  if (settings.targets.empty()) return image;
  add_targets(image, radar, {terrain, obstacles_of(atlas)}, settings.targets, {.dwell = dwell});
  return image;
}

}  // namespace sigmascape::simulate
