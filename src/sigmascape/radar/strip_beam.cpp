#include "sigmascape/radar/strip_beam.h"

#include <algorithm>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/radar_title.h"

namespace sigmascape::radar {
namespace {

double off_the_line_rad(const Radar& radar, Vec2d direction) {
  const double off_course = off_course_rad(radar.velocity_mps, {direction.x, direction.y, 0.0});
  return std::min(off_course, pi - off_course);
}

void check_side(const Radar& radar, Vec2d direction, Vec3d way) {
  const Vec2d course{radar.velocity_mps.x, radar.velocity_mps.y};
  if (cross(course, direction) * cross(course, {way.x, way.y}) >= 0.0) return;
  throw Error(
      title_of(radar),
      fmt::format("points the beam of its strip to the {} of its course, and what it maps lies to the {}",
                  look_side(radar.velocity_mps, {direction.x, direction.y, 0.0}), look_side(radar.velocity_mps, way)),
      "give scan.azimuth_deg on that side, or leave it out");
}

}  // namespace

std::optional<double> fixed_strip_azimuth_rad(const Radar& radar) {
  return radar.scan.kind == ScanKind::Fixed ? radar.scan.azimuth_rad : std::nullopt;
}

Vec2d strip_direction(const Radar& radar, Vec2d middle) {
  if (const auto azimuth_rad = fixed_strip_azimuth_rad(radar)) return horizontal_direction(*azimuth_rad);
  const Vec2d away = middle - Vec2d{radar.position.x, radar.position.y};
  const double distance_m = length(away);
  return distance_m > 0.0 ? away * (1.0 / distance_m) : Vec2d{};
}

bool straddles_course(const Radar& radar, Vec2d direction) {
  return off_the_line_rad(radar, direction) < radar.beam_width_rad / 2.0;
}

Vec3d way_as_passed(const Radar& radar, Vec3d middle) {
  const Vec3d way = middle - radar.position;
  if (!fixed_strip_azimuth_rad(radar)) return way;
  const Vec2d direction = strip_direction(radar, {middle.x, middle.y});
  if (straddles_course(radar, direction)) {
    throw Error(title_of(radar),
                fmt::format("points the beam of its strip along its course, {:.2g}° off, where it passes over nothing",
                            deg_from_radians(off_the_line_rad(radar, direction))),
                "give scan.azimuth_deg farther to the side, or leave it out");
  }
  check_side(radar, direction, way);
  const Vec2d course{radar.velocity_mps.x, radar.velocity_mps.y};
  return way - radar.velocity_mps * (cross({way.x, way.y}, direction) / cross(course, direction));
}

Radar as_it_passes(const Radar& radar, Vec3d middle) {
  Radar then = radar;
  if (radar.mode == Mode::Stripmap) then.position = middle - way_as_passed(radar, middle);
  return then;
}

}  // namespace sigmascape::radar
