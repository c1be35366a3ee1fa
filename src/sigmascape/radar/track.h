#pragma once

#include <string_view>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"

namespace sigmascape::radar {

/// A place and when it is passed.
struct WayPoint {
  double time_s = 0.0;
  Vec3d position;  ///< local frame, height above mean sea level
};

/// How something moves: along straight legs between way-points, each at an even speed. It stands at the first until
/// its time has come and at the last afterwards; a track that was made `straight` goes on for ever both ways.
class Track {
 public:
  /// At rest at the origin.
  Track() = default;
  /// At `position` at time zero.
  [[nodiscard]] static Track straight(Vec3d position, Vec3d velocity_mps = {});
  /// Throws Error, naming `where`, when there is no way-point or times do not increase.
  [[nodiscard]] static Track through(std::vector<WayPoint> way_points, std::string_view where = "track");

  /// The same way in the straight space under a foot, turned like the ground that it has below it at that time: place
  /// and velocity of that time are right, and as nearly those of other times as the Earth is flat over the way between.
  [[nodiscard]] Track bent(const CurvedEarth& earth, Vec2d foot, double time_s) const;
  /// The same motion, with that moment as time zero.
  [[nodiscard]] Track counted_from(double time_s) const;

  [[nodiscard]] Vec3d position_at(double time_s) const;
  [[nodiscard]] Vec3d velocity_at(double time_s) const;

 private:
  std::vector<WayPoint> way_points_{{}};
  Vec3d velocity_mps_ = {};  // of a straight track
};

}  // namespace sigmascape::radar
