#include "sigmascape/radar/target.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/shadow_box.h"

namespace sigmascape::radar {
namespace {

/// Of a place above the target's own horizontal.
double elevation_of(Vec3d seen_from, const Target& target, Vec3d position, const CurvedEarth& earth) {
  const Vec3d away = seen_from - position;
  const double distance_m = std::hypot(away.x, away.y);
  if (earth.curvature_per_m() > 0.0 && distance_m > 0.0)
    return std::asin(std::clamp(earth.sin_grazing(seen_from.z, position.z, distance_m), -1.0, 1.0));
  const double above_m = dot(away, target.up);
  return std::atan2(above_m, length(away - target.up * above_m));
}

}  // namespace

double heading_of(const Target& target, double time_s) {
  const Vec3d velocity = target.track.velocity_at(time_s);
  // Along its own horizontal; what is left of a climb straight up is rounding.
  const Vec3d level = velocity - target.up * dot(velocity, target.up);
  const bool moves = std::hypot(level.x, level.y) > 1e-9 * length(velocity);
  return moves ? azimuth_of(level) : target.heading_rad;
}

Motion motion_of(const Target& target, double time_s) {
  return {target.track.position_at(time_s), target.track.velocity_at(time_s)};
}

Target bent(Target target, const CurvedEarth& earth, Vec2d foot, double time_s) {
  const Vec3d position = target.track.position_at(time_s);
  target.up = earth.turned({0.0, 0.0, 1.0}, position, foot);
  target.track = target.track.bent(earth, foot, time_s);
  return target;
}

Channels mean_rcs_of(const Target& target, Vec3d seen_from, double frequency_hz, double time_s,
                     const CurvedEarth& earth) {
  if (const auto* const constant = std::get_if<Channels>(&target.rcs_m2)) return *constant;
  const Vec3d position = target.track.position_at(time_s), away = seen_from - position;
  const double azimuth = azimuth_of(away) - heading_of(target, time_s);
  const double elevation = elevation_of(seen_from, target, position, earth);
  return std::get<RcsTable>(target.rcs_m2).at({{azimuth, elevation}, frequency_hz});
}

Channels rcs_of(const Target& target, Vec3d seen_from, double frequency_hz, const Moment& moment,
                const CurvedEarth& earth) {
  const auto factor = static_cast<float>(fluctuation(target.fluctuation, target.seed, moment.dwell, moment.pulse));
  return mean_rcs_of(target, seen_from, frequency_hz, moment.time_s, earth) * factor;
}

Target weakened(Target target, double part) {
  if (part == 1.0) return target;
  if (auto* const constant = std::get_if<Channels>(&target.rcs_m2)) {
    *constant = *constant * static_cast<float>(part);
  } else {
    for (Channels& rcs : std::get<RcsTable>(target.rcs_m2).rcs_m2) rcs = rcs * static_cast<float>(part);
  }
  return target;
}

bool hides(const Target& target, double time_s, Vec3d radar_position, Vec3d place) {
  const std::optional<ShadowBox> box = ShadowBox::of(target, time_s);
  return box && box->hides(radar_position, place);
}

ComplexChannels steady_amplitude(const Channels& rcs_m2) {
  const float vv = std::sqrt(rcs_m2.vv), hh = std::sqrt(rcs_m2.hh);
  const float correlation = vv * hh > 0.0F ? std::clamp(rcs_m2.re_vvhh / (vv * hh), -1.0F, 1.0F) : 1.0F;
  const float rest = std::sqrt(1.0F - correlation * correlation);
  return {{vv, 0.0F}, {hh * correlation, hh * rest}, {std::sqrt(rcs_m2.hv), 0.0F}};
}

}  // namespace sigmascape::radar
