#include "sigmascape/radar/target_shadows.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::radar {

TargetShadows::TargetShadows(std::span<const Target> targets, double time_s, Vec3d radar_position)
    : vantage_(radar_position) {
  for (const Target& target : targets) add(target, time_s);
}

TargetShadows::TargetShadows(std::span<const Target> targets, const Vantage& vantage, const CurvedEarth& earth)
    : vantage_(vantage), earth_(earth) {
  for (const Target& target : targets) add(target, vantage.time_s_for(target));
}

void TargetShadows::add(const Target& target, double time_s) {
  const std::optional<ShadowBox> box = ShadowBox::of(target, time_s);
  if (!box) return;
  const Vec2d middle{box->centre().x, box->centre().y};
  const Vec3d radar = vantage_.place_for(middle);
  const Vec2d away = middle - Vec2d{radar.x, radar.y};
  const double distance_m = length(away), half_m = box->half_diagonal_m();
  const Vec2d towards = distance_m > 0.0 ? away * (1.0 / distance_m) : Vec2d{0.0, 1.0};
  casting_.push_back({box->lowered(earth_.drop_m(distance_m)), towards, distance_m - half_m, half_m});
}

bool TargetShadows::may_hide(const Casting& casting, Vec2d place, Vec2d away) const {
  if (vantage_.beams()) {
    // Seen along parallel lines, a shadow is as wide as the target.
    const Vec2d beyond = place - Vec2d{casting.box.centre().x, casting.box.centre().y};
    return std::abs(cross(beyond, casting.towards)) <= casting.half_width_m &&
           dot(beyond, casting.towards) >= -casting.half_width_m;
  }
  if (casting.nearest_m <= 0.0) return true;  // from above it or beside it, all around
  const double along_m = dot(away, casting.towards), across_m = cross(away, casting.towards);
  // A shadow widens with distance, like all that is seen under one angle.
  return along_m >= casting.nearest_m && std::abs(across_m) * casting.nearest_m <= casting.half_width_m * along_m;
}

bool TargetShadows::hide(Vec3d place) const {
  if (casting_.empty()) return false;
  const Vec2d foot{place.x, place.y};
  const Vec3d radar = vantage_.place_for(foot);
  const Vec2d away = foot - Vec2d{radar.x, radar.y};
  place.z -= earth_.drop_m(length(away));
  return std::ranges::any_of(casting_, [&](const Casting& casting) {
    return may_hide(casting, foot, away) && casting.box.hides(radar, place);
  });
}

}  // namespace sigmascape::radar
