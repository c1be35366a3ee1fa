#pragma once

#include <optional>

#include "sigmascape/radar/target.h"

namespace sigmascape::radar {

/// The box of a target with a size, at one moment: what keeps the radar from seeing the ground behind it. Made once and
/// asked for many places, wherever lines of sight are straight: over a flat Earth, or after `lowered` by the curvature
/// of a round one.
class ShadowBox {
 public:
  friend bool operator==(const ShadowBox&, const ShadowBox&) = default;

  /// Nothing for a target without a size.
  [[nodiscard]] static std::optional<ShadowBox> of(const Target& target, double time_s);

  [[nodiscard]] Vec3d centre() const { return centre_; }
  [[nodiscard]] Vec3d size_m() const { return size_m_; }
  /// Of its corners from its middle, over the ground.
  [[nodiscard]] double half_diagonal_m() const;

  /// The same box counted from another origin, which lies `from` it.
  [[nodiscard]] ShadowBox seen_from(Vec3d from) const;
  /// The same box so much lower.
  [[nodiscard]] ShadowBox lowered(double by_m) const { return seen_from({0.0, 0.0, by_m}); }

  /// Whether it stands between a place and the radar.
  [[nodiscard]] bool hides(Vec3d radar_position, Vec3d place) const;

 private:
  Vec3d centre_, size_m_;
  double sine_ = 0.0, cosine_ = 1.0;  // of its heading
};

}  // namespace sigmascape::radar
