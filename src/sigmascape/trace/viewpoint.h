#pragma once

#include <cmath>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::trace {

/// Where the radar stands: at a place, or infinitely far away in one direction (as for baking).
///
/// All that the tracer needs of the radar is answered here; see radar::Echo for the meaning of range and cross.
class Viewpoint {
 public:
  [[nodiscard]] static Viewpoint distant(const radar::Aspect& aspect);
  [[nodiscard]] static Viewpoint located(Vec3d position);

  [[nodiscard]] Vec3d direction_from(Vec3d point) const {
    return is_distant_ ? to_radar_ : normalized(position_ - point);
  }
  [[nodiscard]] double range_of(Vec3d point) const {
    return is_distant_ ? -dot(point, to_radar_) : length(position_ - point);
  }
  [[nodiscard]] double cross_of(Vec3d point) const {
    return is_distant_ ? dot(point, right_) : azimuth_of(point - position_);
  }
  /// The middle of two cross positions; of azimuths, the middle of the smaller angle between them, be it across south.
  [[nodiscard]] double middle_cross(double first, double second) const;
  /// Sine of the angle below the radar's horizontal from which an echo between two surface points arrives; 0 when the
  /// radar is at infinity. See radar::Echo::sin_depression.
  [[nodiscard]] double sin_depression_of(Vec3d first, Vec3d last) const;
  /// Whether it is higher than that, as at infinity.
  [[nodiscard]] bool stands_above(double height_m) const { return is_distant_ || position_.z > height_m; }
  /// The point of a level rectangle that is nearest to the radar; its centre when the radar is at infinity.
  [[nodiscard]] Vec2d nearest_point(const radar::Rectangle& rectangle) const;
  /// The point of the plane at `height_m` behind `point`, on the line from the radar through it.
  [[nodiscard]] Vec2d shadow_on_plane(Vec3d point, double height_m) const;

  /// How far before its aim point, along the level towards the radar, the echo of a ray lands that hits something at
  /// `height_m`: at the level of the aim point, at the echo's range.
  [[nodiscard]] double landing_before_aim_m(Vec3d aim, double height_m) const;
  /// The same distance, but for the ray whose echo lands at `landing`: how far behind that place the ray is aimed.
  [[nodiscard]] double aim_behind_landing_m(Vec3d landing, double height_m) const;

  /// How far behind the place where its echo lands, along the level, a point at `height_m` stands.
  [[nodiscard]] double point_behind_landing_m(Vec3d landing, double height_m) const;

  /// How far before a point, along the level towards the radar, its echo lands on the plane at `height_m` below it.
  [[nodiscard]] double landing_before_m(Vec3d point, double height_m) const;

  /// How far before a place, along the level towards the radar, what is nearer by `late_m` of range lies: no farther
  /// than right below the radar.
  [[nodiscard]] double nearer_before_m(Vec3d place, double late_m) const;

  /// The beam that a ray stands for which is aimed at `aim` for `area_m2` of the launch plane: its solid angle, or its
  /// cross-section in m² when the radar is at infinity.
  [[nodiscard]] double beam_of(Vec3d aim, double area_m2) const {
    if (is_distant_) return area_m2 * to_radar_.z;
    const Vec3d away = position_ - aim;
    const double distance2 = dot(away, away);
    return area_m2 * away.z / (distance2 * std::sqrt(distance2));
  }
  /// Radar cross-section, referred to the echo's own range, that stands for unit intensity on the way out: w of
  /// docs/physics/estimator.md, Eqs. (2), (3). `echo_range_m` is half the path, `last_range_m` the distance of the last
  /// vertex.
  [[nodiscard]] double ray_weight_m2(double beam, double echo_range_m, double last_range_m) const {
    if (is_distant_) return beam;
    const double ratio = echo_range_m / last_range_m;
    return beam * echo_range_m * echo_range_m * ratio * ratio;
  }

 private:
  Viewpoint(bool is_distant, Vec3d to_radar, Vec3d position);

  bool is_distant_;
  Vec3d to_radar_;     // distant: the same for all points
  double horizontal_;  // distant: length of its level part
  Vec3d right_;        // distant: across the line of sight, to the right as seen from the radar
  Vec3d position_;     // located
};

}  // namespace sigmascape::trace
