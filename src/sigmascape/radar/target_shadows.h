#pragma once

#include <span>
#include <vector>

#include "sigmascape/radar/shadow_box.h"
#include "sigmascape/radar/vantage.h"

namespace sigmascape::radar {

/// The shadows that targets with a size cast on what stands behind them, at one moment and as seen from one place, or
/// as the beam of a strip passes them: `hides` for many places and many targets. Where no shadow can lie is told from
/// azimuth and distance alone.
class TargetShadows {
 public:
  TargetShadows(std::span<const Target> targets, double time_s, Vec3d radar_position);
  /// Each at the time at which it is looked at, over this Earth.
  TargetShadows(std::span<const Target> targets, const Vantage& vantage,
                const CurvedEarth& earth = CurvedEarth::flat());

  [[nodiscard]] bool empty() const { return casting_.empty(); }
  /// Whether a target stands between a place and the radar.
  [[nodiscard]] bool hide(Vec3d place) const;

 private:
  struct Casting {
    ShadowBox box;              ///< so much lower as the Earth has fallen away there
    Vec2d towards;              ///< unit vector over the ground from the radar to the target
    double nearest_m = 0.0;     ///< over the ground
    double half_width_m = 0.0;  ///< across that direction, at the target
  };
  void add(const Target& target, double time_s);
  [[nodiscard]] bool may_hide(const Casting& casting, Vec2d place, Vec2d away) const;

  Vantage vantage_;
  CurvedEarth earth_ = CurvedEarth::flat();
  std::vector<Casting> casting_;
};

}  // namespace sigmascape::radar
