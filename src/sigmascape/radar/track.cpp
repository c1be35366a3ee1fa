#include "sigmascape/radar/track.h"

#include <algorithm>
#include <fmt/format.h>

#include "sigmascape/base/error.h"

namespace sigmascape::radar {

Track Track::straight(Vec3d position, Vec3d velocity_mps) {
  Track track;
  track.way_points_ = {{0.0, position}};
  track.velocity_mps_ = velocity_mps;
  return track;
}

Track Track::through(std::vector<WayPoint> way_points, std::string_view where) {
  if (way_points.empty()) throw Error(std::string(where), "has no way-points", "give at least one");
  for (std::size_t i = 1; i < way_points.size(); ++i) {
    if (!(way_points[i].time_s > way_points[i - 1].time_s)) {
      throw Error(std::string(where),
                  fmt::format("way-point {} at {} s is not later than the one before it at {} s", i + 1,
                              way_points[i].time_s, way_points[i - 1].time_s),
                  "give way-points in the order in which they are passed");
    }
  }
  Track track;
  track.way_points_ = std::move(way_points);
  return track;
}

Track Track::bent(const CurvedEarth& earth, Vec2d foot, double time_s) const {
  const Vec3d here = position_at(time_s), there = earth.bent(here, foot);
  Track track = *this;
  for (WayPoint& point : track.way_points_) point.position = there + earth.turned(point.position - here, here, foot);
  track.velocity_mps_ = earth.turned(velocity_mps_, here, foot);
  return track;
}

Track Track::counted_from(double time_s) const {
  Track track = *this;
  for (WayPoint& point : track.way_points_) point.time_s -= time_s;
  return track;
}

Vec3d Track::position_at(double time_s) const {
  if (way_points_.size() == 1) {
    return way_points_[0].position + velocity_mps_ * (time_s - way_points_[0].time_s);
  }
  const auto next = std::upper_bound(way_points_.begin(), way_points_.end(), time_s,
                                     [](double time, const WayPoint& point) { return time < point.time_s; });
  if (next == way_points_.begin()) return next->position;
  if (next == way_points_.end()) return way_points_.back().position;
  return (next - 1)->position + velocity_at(time_s) * (time_s - (next - 1)->time_s);
}

Vec3d Track::velocity_at(double time_s) const {
  if (way_points_.size() == 1) return velocity_mps_;
  const auto next = std::upper_bound(way_points_.begin(), way_points_.end(), time_s,
                                     [](double time, const WayPoint& point) { return time < point.time_s; });
  if (next == way_points_.begin() || next == way_points_.end()) return {};
  const WayPoint& last = *(next - 1);
  return (next->position - last.position) * (1.0 / (next->time_s - last.time_s));
}

}  // namespace sigmascape::radar
