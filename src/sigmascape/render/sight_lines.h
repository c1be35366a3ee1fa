#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/azimuth_span.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/vantage.h"

namespace sigmascape::render {

/// Lines from a radar outwards over an area, side by side, along which is walked what it sees: azimuths from its one
/// place or, of a strip, to one side of its track, parallel ones, each from where the platform is when its beam passes
/// over it.
class SightLines {
 public:
  /// All lines that an area takes, no farther apart than that: one fan of them, or for a strip those to the sides of
  /// its track on which the area lies.
  [[nodiscard]] static std::vector<SightLines> over(const radar::Rectangle& area, const radar::Vantage& vantage,
                                                    double apart_m);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] Vec3d radar_of(std::size_t line) const;
  /// The direction outwards, clockwise from north.
  [[nodiscard]] double azimuth_rad(std::size_t line) const;

  /// Whether a point lies on the side to which they go.
  [[nodiscard]] bool go_to(Vec2d point) const { return !beam_ || beam_->looks_to(point); }
  /// Where a point lies among them: line k from k to k + 1, its own place in the middle.
  [[nodiscard]] double line_of(Vec2d point) const;
  /// How far over the ground from where its line begins.
  [[nodiscard]] double distance_m(Vec2d point) const;

  /// Steps along all of them over terrain, of which those over the area are kept.
  struct Steps {
    double start_m = 0.0;    ///< where the first begins: nothing of the terrain is nearer
    double step_m = 1.0;     ///< and the length of each
    std::size_t before = 0;  ///< that lie before the area: what stands there may hide it
    std::size_t kept = 0;    ///< over the area, and one or two on either side
    double end_m = 0.0;      ///< as far as is walked

    [[nodiscard]] double kept_from_m() const { return start_m + static_cast<double>(before) * step_m; }
    /// Where a distance lies among those that are kept: step k from k to k + 1, walked in its middle.
    [[nodiscard]] double place_of(double distance_m) const { return (distance_m - kept_from_m()) / step_m; }
  };
  [[nodiscard]] Steps steps_over(const radar::Rectangle& terrain_extent, double step_m) const;

 private:
  [[nodiscard]] static SightLines azimuths(const radar::Rectangle& area, Vec3d radar, double apart_m);
  [[nodiscard]] static SightLines parallel(const radar::Rectangle& area, const radar::PassingBeam& beam,
                                           double apart_m);

  Vec3d radar_;
  std::optional<radar::PassingBeam> beam_;  // of parallel ones
  radar::AzimuthSpan span_;                 // of azimuths
  double first_ = 0.0;                      // edge of the first line: a turn from the middle of the span, or across
  double apart_ = 1.0;                      // likewise
  std::size_t count_ = 0;
  double near_m_ = 0.0, far_m_ = 0.0;  // of the area
};

}  // namespace sigmascape::render
