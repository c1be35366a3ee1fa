#pragma once

#include <cmath>
#include <limits>

#include "sigmascape/base/vec.h"

namespace sigmascape::radar {

/// The Earth as rays know it: where the refractive index of air falls evenly with height, rays are circles, and they
/// become straight lines over an Earth whose radius is multiplied by k. In the lower atmosphere k is about 4/3
/// (docs/physics/curved_earth.md, Eq. (1)).
///
/// Heights are above mean sea level, distances lie along it. Good while heights stay below some 10 km, where the index
/// still falls evenly.
struct CurvedEarth {
  double mean_radius_m = 6'371'008.8;
  double refraction = 4.0 / 3.0;  ///< k; 1 in a vacuum

  /// No curvature at all, as in a bake and in closed-form tests.
  [[nodiscard]] static constexpr CurvedEarth flat() {
    return {.mean_radius_m = 6'371'008.8, .refraction = std::numeric_limits<double>::infinity()};
  }

  /// 1 / (k·R): zero when flat.
  [[nodiscard]] constexpr double curvature_per_m() const { return 1.0 / (refraction * mean_radius_m); }

  /// How far the sea lies below the plane that touches it at the radar's foot: d² / (2·k·R)
  /// (docs/physics/curved_earth.md, Eq. (2)).
  [[nodiscard]] constexpr double drop_m(double distance_m) const {
    return 0.5 * curvature_per_m() * distance_m * distance_m;
  }

  /// Distance to the sea's horizon from a height: √(2·k·R·h) (docs/physics/curved_earth.md, Eq. (3)).
  [[nodiscard]] double horizon_m(double height_m) const { return std::sqrt(2.0 * height_m / curvature_per_m()); }

  /// s² of docs/physics/curved_earth.md, Eq. (6): what the slant range to a point at sea level owes to distance alone;
  /// d² when flat.
  [[nodiscard]] double stretched_chord_m2(double radar_height_m, double distance_m) const {
    const double half_angle = 0.5 * curvature_per_m() * distance_m;
    const double square = half_angle * half_angle;
    // sin x / x; the series is good to the last digit up to a tenth, 1700 km, and asks no function of the library.
    const double sinc = half_angle < 0.1 ? 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0))
                                         : std::sin(half_angle) / half_angle;
    const double chord_m = distance_m * sinc;
    return chord_m * chord_m * (1.0 + curvature_per_m() * radar_height_m);
  }

  /// Slant range to a point, from the two heights and the distance along sea level between their feet: the straight
  /// line over the enlarged Earth (docs/physics/curved_earth.md, Eq. (4)).
  [[nodiscard]] double slant_range_m(double radar_height_m, double point_height_m, double distance_m) const {
    const double climb_m = radar_height_m - point_height_m;
    return std::sqrt(climb_m * climb_m +
                     stretched_chord_m2(radar_height_m, distance_m) * (1.0 + curvature_per_m() * point_height_m));
  }

  /// Where a point stands in the straight space in which rays are straight lines: the local frame bent down about a
  /// foot, where it keeps its directions. `slant_range_m` is the distance from (foot, radar height) to it.
  [[nodiscard]] Vec3d bent(Vec3d point, Vec2d foot) const {
    const double c = curvature_per_m();
    if (c == 0.0) return point;
    const Vec2d away{point.x - foot.x, point.y - foot.y};
    const double distance_m = std::sqrt(away.x * away.x + away.y * away.y), half = 0.5 * c * distance_m;
    const double sine = std::sin(half), cosine = std::cos(half);
    const double half_sinc = half < 1e-9 ? 1.0 : sine / half;
    // d sin(cd)/(cd) · (1 + ch) over the plane, and h cos(cd) − 2/c sin²(cd/2) above it.
    const double stretch = half_sinc * cosine * (1.0 + c * point.z);
    return {foot.x + away.x * stretch, foot.y + away.y * stretch,
            point.z * (1.0 - 2.0 * sine * sine) - distance_m * sine * half_sinc};
  }

  /// What a velocity of the local frame at a point is there: the derivative of `bent` along it
  /// (docs/physics/curved_earth.md, Eq. (9)).
  [[nodiscard]] Vec3d turned(Vec3d velocity, Vec3d point, Vec2d foot) const {
    const double c = curvature_per_m();
    if (c == 0.0) return velocity;
    const Vec2d away{point.x - foot.x, point.y - foot.y};
    const double distance_m = std::sqrt(away.x * away.x + away.y * away.y), angle = c * distance_m;
    const Vec2d outwards = distance_m > 0.0 ? away * (1.0 / distance_m) : Vec2d{};
    const double sine = std::sin(angle), cosine = std::cos(angle), stretch = 1.0 + c * point.z;
    const double sideways = stretch * (angle < 1e-9 ? 1.0 : sine / angle);
    const double receding = velocity.x * outwards.x + velocity.y * outwards.y;
    const double along = receding * (stretch * cosine - sideways) + velocity.z * sine;
    return {velocity.x * sideways + outwards.x * along, velocity.y * sideways + outwards.y * along,
            velocity.z * cosine - receding * stretch * sine};
  }

  /// Sine of the grazing angle: of the ray's angle above the horizontal at the point, not of the depression angle at
  /// the radar (docs/physics/curved_earth.md, Eq. (5)). Negative beyond the horizon.
  [[nodiscard]] double sin_grazing(double radar_height_m, double point_height_m, double distance_m) const {
    const double sagitta_m = 0.5 * curvature_per_m() * stretched_chord_m2(radar_height_m, distance_m);
    return (radar_height_m - point_height_m - sagitta_m) / slant_range_m(radar_height_m, point_height_m, distance_m);
  }
};

}  // namespace sigmascape::radar
