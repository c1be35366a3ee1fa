#include "sigmascape/radar/vantage.h"

#include <cmath>

#include "sigmascape/radar/strip_beam.h"

namespace sigmascape::radar {
namespace {

/// The same beam on the other side of the track, as far ahead of broadside or behind it.
PassingBeam mirrored(const PassingBeam& beam) {
  const Vec2d course{beam.velocity_mps.x, beam.velocity_mps.y};
  PassingBeam other = beam;
  other.outwards = course * (2.0 * dot(beam.outwards, course) / dot(course, course)) - beam.outwards;
  return other;
}

}  // namespace

Vec3d PassingBeam::platform_at(double time_s) const {
  Vec3d place = position + velocity_mps * time_s;
  place.z += earth.drop_m(std::hypot(velocity_mps.x, velocity_mps.y) * time_s);
  return place;
}

double PassingBeam::distance_m(Vec2d point) const {
  const Vec3d platform = position + velocity_mps * time_s(across_m(point));
  return dot(point - Vec2d{platform.x, platform.y}, outwards);
}

bool PassingBeam::looks_to(Vec2d point) const {
  const Vec2d course{velocity_mps.x, velocity_mps.y};
  return (cross(course, point - Vec2d{position.x, position.y}) >= 0.0) == (across_mps() >= 0.0);
}

Vantage::Vantage(const PassingBeam& beam) : place_(beam.position), beams_({beam, mirrored(beam)}) {}

const PassingBeam& Vantage::beam_over(Vec2d point) const {
  const auto& [own, other] = *beams_;
  return own.looks_to(point) ? own : other;
}

Vec3d Vantage::place_for(Vec2d point) const {
  if (!beams_) return place_;
  const PassingBeam& beam = beam_over(point);
  return beam.platform_at(beam.time_s(beam.across_m(point)));
}

double Vantage::time_s_for(const Target& target) const {
  if (!beams_) return 0.0;
  double time_s = 0.0;
  // Exact on the leg of the track that it begins on, and on others after a few steps.
  for (int step = 0; step < 8; ++step) {
    const Vec3d position = target.track.position_at(time_s), velocity = target.track.velocity_at(time_s);
    const PassingBeam& beam = beam_over({position.x, position.y});
    const double gain = 1.0 - cross(Vec2d{velocity.x, velocity.y}, beam.outwards) / beam.across_mps();
    if (!(gain > 0.0)) return 0.0;
    time_s -= (time_s - beam.time_s(beam.across_m({position.x, position.y}))) / gain;
  }
  return time_s;
}

Vantage vantage_of_strip(const Radar& radar, Vec2d middle) {
  const Vec2d outwards = strip_direction(radar, middle);
  if (straddles_course(radar, outwards)) return Vantage(radar.position);
  return Vantage(PassingBeam{
      .position = radar.position, .velocity_mps = radar.velocity_mps, .outwards = outwards, .earth = earth_of(radar)});
}

Vantage vantage_of(const Radar& radar, Vec2d middle) {
  return radar.mode == Mode::Stripmap ? vantage_of_strip(radar, middle) : Vantage(radar.position);
}

}  // namespace sigmascape::radar
