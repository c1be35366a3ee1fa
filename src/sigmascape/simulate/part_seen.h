#pragma once

#include <span>
#include <vector>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/render/ground_scatterers.h"
#include "sigmascape/terrain/height_field.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::simulate {

/// No ground of this terrain and nothing that stands on it is higher. Takes a look at all of both.
[[nodiscard]] double highest_m_of(const terrain::HeightField& terrain, const radar::ObstacleMap* obstacles);

/// What may stand between targets and the radar where there are only terrain and an atlas. Made once for all of them.
struct Obstructions {
  const terrain::HeightField& terrain;
  /// What stands on the ground, of an atlas that keeps it apart; without it only the terrain hides.
  const radar::ObstacleMap* obstacles = nullptr;
  radar::CurvedEarth earth = radar::CurvedEarth::flat();
  double highest_m = highest_m_of(terrain, obstacles);
  double lowest_m = static_cast<double>(terrain.lowest_m());
};

/// The obstacles that an atlas keeps apart from its textures, or none.
[[nodiscard]] const radar::ObstacleMap* obstacles_of(const atlas::Atlas& atlas);
/// Those that a reflectivity knows of, or none.
[[nodiscard]] const radar::ObstacleMap* obstacles_of(const render::Reflectivity& sigma0);

/// The part of a point's power that the radar sees: none behind a hill or a house, e^−κs through crowns, once for both
/// ways, for they share their gaps (docs/physics/vegetation.md). A point under the ground is seen as one on it. By a
/// march along the straight line between them, in steps of the obstacles or the terrain; beside the terrain only what
/// the round Earth hides is hidden (radar/sea_horizon.h). What stands on a roof, to
/// within what squares of obstacles know of its height (terrain/roof_doubt.h), is not within the house.
[[nodiscard]] double part_seen(const Obstructions& obstructions, Vec3d radar_position, Vec3d point);
/// The same by a ray through the whole scene, on its terrain. `surfaces`: those of the scene at the radar's frequency.
[[nodiscard]] double part_seen(const trace::SceneGeometry& geometry, const std::vector<scatter::SurfaceModel>& surfaces,
                               Vec3d radar_position, Vec3d point);

/// A target when the radar looks at it.
struct TargetInSight {
  const radar::Target* target;
  double time_s;
  Vec3d position;    ///< of its phase centre then
  double part_seen;  ///< of its power
};

/// All of them, from where and when a radar looks at each. `part_seen_of(radar_position, point)`.
template <typename PartSeen>
[[nodiscard]] std::vector<TargetInSight> targets_in_sight(std::span<const radar::Target> targets,
                                                          const radar::Vantage& vantage, const PartSeen& part_seen_of) {
  std::vector<TargetInSight> sights;
  for (const radar::Target& target : targets) {
    const double time_s = vantage.time_s_for(target);
    const Vec3d position = target.track.position_at(time_s);
    sights.push_back({&target, time_s, position, part_seen_of(vantage.place_for({position.x, position.y}), position)});
  }
  return sights;
}

/// The targets of which something is seen, their cross-sections weakened by what stands in the way at that time.
template <typename PartSeen>
[[nodiscard]] std::vector<radar::Target> seen_targets(std::span<const radar::Target> targets, double time_s,
                                                      const PartSeen& part_seen_of) {
  std::vector<radar::Target> seen;
  for (const radar::Target& target : targets) {
    const double part = part_seen_of(target.track.position_at(time_s));
    if (part > 0.0) seen.push_back(radar::weakened(target, part));
  }
  return seen;
}

}  // namespace sigmascape::simulate
