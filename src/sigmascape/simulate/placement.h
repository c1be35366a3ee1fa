#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sigmascape/geo/local_frame.h"
#include "sigmascape/live/live_terrain.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/radar/target_file.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// The radar of a file, put where it stands over this terrain, or where it has flown to by `time_s`. One on the globe
/// lies where the frame has its place, if that is within the extent, else at its distance and azimuth from the middle
/// of the extent, and its course, heading and scan, stated from true north where it is, become azimuths of the frame
/// (Radar::north_rad). All others state these in the frame.
/// `extent` is what the scene covers. Throws Error when it would stand more than 1000 km from there.
[[nodiscard]] radar::Radar placed_radar(const radar::RadarFile& file, const geo::LocalFrame& frame,
                                        const terrain::HeightField& terrain, const radar::Rectangle& extent,
                                        double time_s = 0.0);

/// The cells of the map that the file asks for, whole cells within the extent. Throws Error when the area and the
/// extent have nothing in common.
[[nodiscard]] radar::GroundGrid map_grid(const radar::MapRequest& request, const radar::Rectangle& extent);

/// The ground that targets are put onto: terrain in memory, or that of live frames, of which tiles are read where
/// targets stand. The terrain must outlive it.
struct TargetGround {
  TargetGround(const terrain::HeightField& terrain);  // NOLINT(google-explicit-constructor): said by its terrain
  TargetGround(const live::LiveTerrain& terrain);     // NOLINT(google-explicit-constructor)

  radar::Rectangle extent;
  std::function<double(Vec2d)> height_at;  ///< above mean sea level, within the extent
};

/// The targets of a file on this ground, their moment `time_s` taken for time zero. What moves at an even velocity
/// keeps the altitude that it has at time zero; between way-points it climbs evenly. One without a seed of its own (0)
/// fluctuates by `seed` and its place in the list. Throws Error for a place above ground that lies outside the terrain.
[[nodiscard]] std::vector<radar::Target> placed_targets(std::span<const radar::TargetSource> sources,
                                                        const geo::LocalFrame& frame, const TargetGround& ground,
                                                        std::uint64_t seed, double time_s = 0.0);

/// The point targets of a scene, as targets at rest.
[[nodiscard]] std::vector<radar::Target> targets_of(const scene::Scene& scene);

/// Those of the scene, where there is one, and then the given ones, placed as above.
[[nodiscard]] std::vector<radar::Target> all_targets(const scene::Scene* scene,
                                                     std::span<const radar::TargetSource> given,
                                                     const geo::LocalFrame& frame, const TargetGround& ground,
                                                     std::uint64_t seed, double time_s = 0.0);

}  // namespace sigmascape::simulate
