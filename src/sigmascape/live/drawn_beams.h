#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sigmascape/base/vec.h"

namespace sigmascape::live {

/// When a beam of a frame was drawn last, and from where.
struct DrawnBeam {
  Vec3d radar = {};           ///< as Pose::position
  std::uint64_t drawing = 0;  ///< its number among all drawings of the process, from 1 on; 0: never, and it is dark
  Vec3d velocity_mps = {};    ///< as Pose::velocity_mps

  /// In place of the number while a beam is drawn, and ever after where that was broken off.
  static constexpr std::uint64_t unfinished = std::numeric_limits<std::uint64_t>::max();
};

/// The one of some beams, one at least, that was drawn after all others.
[[nodiscard]] inline const DrawnBeam& drawn_last(std::span<const DrawnBeam> beams) {
  return *std::ranges::max_element(beams, {}, &DrawnBeam::drawing);
}

/// All beams of a frame, for whoever draws it.
class DrawnBeams {
 public:
  explicit DrawnBeams(std::size_t beams) : beams_(beams) {}

  /// From here on the bins of beams first … first + count − 1 change. What a drawing leaves that breaks off is thus
  /// neither taken for what was there before nor for a whole one.
  void begin(std::size_t first, std::size_t count);
  /// They hold what a radar at that place, which flies so, sees of them. Returns the drawing's number.
  std::uint64_t end(Vec3d radar, Vec3d velocity_mps = {});
  /// They hold what another frame of as many beams does.
  void end_as_in(std::span<const DrawnBeam> other);

  [[nodiscard]] std::span<const DrawnBeam> all() const { return beams_; }

 private:
  std::vector<DrawnBeam> beams_;
  std::size_t first_ = 0, count_ = 0;  // of those that are drawn
};

}  // namespace sigmascape::live
