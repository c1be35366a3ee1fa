#pragma once

#include <array>
#include <optional>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/target.h"

namespace sigmascape::radar {

/// A beam that keeps its azimuth while the platform flies straight on: whatever lies on one line of that azimuth is
/// seen at one time and from one place.
struct PassingBeam {
  Vec3d position;      ///< of the platform at time zero
  Vec3d velocity_mps;  ///< not along `outwards`
  Vec2d outwards;      ///< unit vector over the ground
  CurvedEarth earth = CurvedEarth::flat();

  /// Where the line of a point lies among the others: how far from that of time zero, across them.
  [[nodiscard]] double across_m(Vec2d point) const { return cross(point - Vec2d{position.x, position.y}, outwards); }
  /// When the beam passes over a line.
  [[nodiscard]] double time_s(double across_m) const { return across_m / across_mps(); }
  /// How fast it goes from line to line.
  [[nodiscard]] double across_mps() const { return cross(Vec2d{velocity_mps.x, velocity_mps.y}, outwards); }
  /// Where the platform is then; what flies straight rises over a round Earth.
  [[nodiscard]] Vec3d platform_at(double time_s) const;
  /// How far a point lies from there over the ground, along its line.
  [[nodiscard]] double distance_m(Vec2d point) const;
  /// Whether a point lies on the side of the track to which the beam looks.
  [[nodiscard]] bool looks_to(Vec2d point) const;
};

/// From where a radar looks at a place: from its one place, or, where it maps a strip, from wherever it is as its beam
/// passes over that. Places are in the local frame.
class Vantage {
 public:
  explicit Vantage(Vec3d place) : place_(place) {}
  /// Of a strip. On the other side of the track, which a strip cannot tell from its own, a mirrored beam looks.
  explicit Vantage(const PassingBeam& beam);

  /// The beams to both sides of the track, the strip's own first; nothing for a radar in one place.
  [[nodiscard]] const std::optional<std::array<PassingBeam, 2>>& beams() const { return beams_; }
  [[nodiscard]] Vec3d place_for(Vec2d point) const;
  /// When a target is looked at: at time zero from one place, and so as well what no beam ever overtakes.
  [[nodiscard]] double time_s_for(const Target& target) const;

 private:
  [[nodiscard]] const PassingBeam& beam_over(Vec2d point) const;

  Vec3d place_;
  std::optional<std::array<PassingBeam, 2>> beams_;
};

/// From where a radar maps a strip about this middle, under the azimuth of its beam (radar/strip_beam.h). Towards the
/// course, where no strip is planned, that passes over nothing, and it looks from where it is at time zero.
[[nodiscard]] Vantage vantage_of_strip(const Radar& radar, Vec2d middle);

/// From where a radar maps ground about this middle in its mode: that of a strip, or its place at time zero.
[[nodiscard]] Vantage vantage_of(const Radar& radar, Vec2d middle);

}  // namespace sigmascape::radar
