#include "sigmascape/simulate/part_seen.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/radar/sea_horizon.h"
#include "sigmascape/radar/straight_sight.h"
#include "sigmascape/simulate/ground_met.h"
#include "sigmascape/terrain/obstacle_sweep.h"
#include "sigmascape/terrain/roof_doubt.h"
#include "sigmascape/trace/crown_crossings.h"

namespace sigmascape::simulate {
double highest_m_of(const terrain::HeightField& terrain, const radar::ObstacleMap* obstacles) {
  float tallest_m = 0.0F;
  if (obstacles != nullptr) {
    for (const radar::Obstacle& obstacle : obstacles->obstacles.values())
      tallest_m = std::max(tallest_m, obstacle.top_m());
  }
  return static_cast<double>(terrain.highest_m()) + static_cast<double>(tallest_m);
}

const radar::ObstacleMap* obstacles_of(const atlas::Atlas& atlas) {
  const auto* const apart = atlas.ground_layers();
  return apart != nullptr ? &apart->obstacles : nullptr;
}

const radar::ObstacleMap* obstacles_of(const render::Reflectivity& sigma0) {
  const auto* const textures = std::get_if<render::AtlasReflectivity>(&sigma0);
  return textures != nullptr ? obstacles_of(*textures->atlas) : nullptr;
}

double part_seen(const Obstructions& obstructions, Vec3d radar_position, Vec3d point) {
  const auto& [terrain, obstacles, earth, highest_m, lowest_m] = obstructions;
  const Vec2d place{point.x, point.y};
  if (terrain.extent().contains(place)) point.z = std::max(point.z, terrain.height_at(place));
  const radar::StraightSight sight(point, radar_position, earth);
  if (sight.length_m == 0.0) return 1.0;
  const radar::SeaHorizon sea(radar_position.z, lowest_m, earth.curvature_per_m());
  if (sight.slope_from_radar() < sea.slope_before(sight.length_m)) return 0.0;
  const double rise = sight.rise;
  const double step_m = obstacles != nullptr ? std::min(obstacles->grid.cell_m, terrain.spacing_m) : terrain.spacing_m;
  const auto depth_within = [rise](const radar::Obstacle& obstacle, double above_m, double length_m) {
    if (!(obstacle.crown_top_m > 0.0F)) return 0.0;
    return terrain::part_within(obstacle, above_m, 0.5 * length_m * std::abs(rise)) *
           static_cast<double>(obstacle.crown_extinction_per_m) * length_m * std::hypot(1.0, rise);
  };
  double depth = 0.0, doubt_m = 0.0;
  if (obstacles != nullptr && terrain.extent().contains(place)) {
    // Of its own square what lies between the point and the first step.
    const radar::Obstacle own = obstacles->at(place);
    const double above_m = point.z - terrain.height_at(place);
    doubt_m = terrain::doubt_about_roof_m(
        place, above_m, terrain.normal_at(place), obstacles->grid.cell_m,
        [obstacles = obstacles](Vec2d there) { return static_cast<double>(obstacles->at(there).solid_top_m); });
    if (above_m < static_cast<double>(own.solid_top_m) - doubt_m) return 0.0;
    depth += depth_within(own, above_m + 0.25 * step_m * rise, 0.5 * step_m);
  }
  for (double d = step_m; d < sight.length_m; d += step_m) {
    const double height_m = sight.height_at(d);
    if (rise >= 0.0 && height_m > highest_m && earth.curvature_per_m() == 0.0) break;
    const Vec2d under = sight.place_at(d);
    if (!terrain.extent().contains(under)) {
      if (terrain.extent().contains(place)) break;
      continue;
    }
    const double above_m = height_m - terrain.height_at(under);
    if (above_m < 0.0) return 0.0;
    if (obstacles == nullptr) continue;
    const radar::Obstacle obstacle = obstacles->at(under);
    const double left_m = terrain::doubt_left_m(doubt_m, d, rise, obstacles->grid.cell_m);
    if (above_m < static_cast<double>(obstacle.solid_top_m) - left_m) return 0.0;
    depth += depth_within(obstacle, above_m, step_m);
  }
  return std::exp(-depth);
}

double part_seen(const trace::SceneGeometry& geometry, const std::vector<scatter::SurfaceModel>& surfaces,
                 Vec3d radar_position, Vec3d point) {
  // A point on the ground, or a little under it where a square of the terrain is twisted, would be within what it
  // stands on.
  const Vec3d start{point.x, point.y, std::max(point.z, ground_met_at(geometry, point).z + ray_lift_m)};
  const Vec3d way = radar_position - start;
  const auto distance_m = static_cast<float>(length(way));
  trace::CrownCrossings crowns;
  crowns.begin(surfaces);
  const Vec3f from = (start - geometry.origin()).to<float>();
  if (geometry.occluded(from, normalized(way).to<float>(), crowns, distance_m)) return 0.0;
  return std::exp(-static_cast<double>(crowns.optical_depth(distance_m) + crowns.return_depth(distance_m)));
}

}  // namespace sigmascape::simulate
