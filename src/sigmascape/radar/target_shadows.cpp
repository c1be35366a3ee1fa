#include "sigmascape/radar/target_shadows.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::radar {

TargetShadows::TargetShadows(std::span<const Target> targets, double time_s, Vec3d radar_position)
    : radar_position_(radar_position) {
  for (const Target& target : targets) {
    const std::optional<ShadowBox> box = ShadowBox::of(target, time_s);
    if (!box) continue;
    const Vec2d away{box->centre().x - radar_position.x, box->centre().y - radar_position.y};
    const double distance_m = length(away), half_m = box->half_diagonal_m();
    const Vec2d towards = distance_m > 0.0 ? away * (1.0 / distance_m) : Vec2d{0.0, 1.0};
    casting_.push_back({*box, towards, distance_m - half_m, half_m});
  }
}

bool TargetShadows::hide(Vec3d place) const {
  const Vec2d away{place.x - radar_position_.x, place.y - radar_position_.y};
  return std::ranges::any_of(casting_, [&](const Casting& casting) {
    const double along_m = away.x * casting.towards.x + away.y * casting.towards.y;
    const double across_m = away.x * casting.towards.y - away.y * casting.towards.x;
    // A shadow widens with distance, like all that is seen under one angle.
    const bool may_hide = along_m >= casting.nearest_m &&
                          std::abs(across_m) * std::max(casting.nearest_m, 0.0) <= casting.half_width_m * along_m;
    return may_hide && casting.box.hides(radar_position_, place);
  });
}

}  // namespace sigmascape::radar
