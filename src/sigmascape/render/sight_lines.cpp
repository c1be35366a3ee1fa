#include "sigmascape/render/sight_lines.h"

#include <algorithm>
#include <array>

#include "sigmascape/radar/rectangle_distances.h"

namespace sigmascape::render {

std::vector<SightLines> SightLines::over(const radar::Rectangle& area, const radar::Vantage& vantage, double apart_m) {
  if (!vantage.beams()) return {azimuths(area, vantage.place_for(area.centre()), apart_m)};
  std::vector<SightLines> sides;
  for (const radar::PassingBeam& beam : *vantage.beams()) {
    if (SightLines lines = parallel(area, beam, apart_m); lines.far_m_ >= 0.0) sides.push_back(lines);
  }
  return sides;
}

SightLines SightLines::azimuths(const radar::Rectangle& area, Vec3d radar, double apart_m) {
  SightLines lines;
  const Vec2d foot{radar.x, radar.y};
  lines.radar_ = radar;
  lines.span_ = radar::azimuths_of(area, foot);
  lines.near_m_ = radar::nearest_m(area, foot);
  lines.far_m_ = radar::farthest_m(area, foot);
  lines.first_ = lines.span_.left_rad;
  lines.apart_ = apart_m / (lines.far_m_ + apart_m);
  lines.count_ = static_cast<std::size_t>((lines.span_.right_rad - lines.span_.left_rad) / lines.apart_) + 1;
  return lines;
}

SightLines SightLines::parallel(const radar::Rectangle& area, const radar::PassingBeam& beam, double apart_m) {
  SightLines lines;
  lines.beam_ = beam;
  const std::array<double, 2> distances_m = radar::span_over(area, [&](Vec2d at) { return beam.distance_m(at); });
  const std::array<double, 2> across_m = radar::span_over(area, [&](Vec2d at) { return beam.across_m(at); });
  lines.near_m_ = distances_m[0];
  lines.far_m_ = distances_m[1];
  lines.first_ = across_m[0];
  lines.apart_ = apart_m;
  lines.count_ = static_cast<std::size_t>((across_m[1] - across_m[0]) / apart_m) + 1;
  return lines;
}

Vec3d SightLines::radar_of(std::size_t line) const {
  if (!beam_) return radar_;
  return beam_->platform_at(beam_->time_s(first_ + (static_cast<double>(line) + 0.5) * apart_));
}

double SightLines::azimuth_rad(std::size_t line) const {
  if (beam_) return azimuth_of(beam_->outwards);
  return span_.middle_rad + first_ + (static_cast<double>(line) + 0.5) * apart_;
}

double SightLines::line_of(Vec2d point) const {
  const double at = beam_ ? beam_->across_m(point) : span_.turn_to(point - Vec2d{radar_.x, radar_.y});
  return (at - first_) / apart_;
}

double SightLines::distance_m(Vec2d point) const {
  return beam_ ? beam_->distance_m(point) : length(point - Vec2d{radar_.x, radar_.y});
}

SightLines::Steps SightLines::steps_over(const radar::Rectangle& terrain_extent, double step_m) const {
  const double start_m =
      beam_ ? std::max(0.0, radar::span_over(terrain_extent, [&](Vec2d at) { return beam_->distance_m(at); })[0])
            : radar::nearest_m(terrain_extent, {radar_.x, radar_.y});
  Steps steps{.start_m = start_m, .step_m = step_m, .end_m = far_m_ + 2.0 * step_m};
  steps.before = static_cast<std::size_t>(std::max(0.0, (near_m_ - start_m) / step_m - 1.0));
  steps.kept = static_cast<std::size_t>(std::max(0.0, (far_m_ + step_m - steps.kept_from_m()) / step_m)) + 2;
  return steps;
}

}  // namespace sigmascape::render
