#include "sigmascape/dataset/target_box.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/radar/antenna_pattern.h"

namespace sigmascape::dataset {
namespace {

/// The ground away from the radar in a target's azimuth, by the horizontal distance from the radar.
class GroundLine {
 public:
  GroundLine(Vec3d target, Vec3d radar, const terrain::HeightField& terrain)
      : terrain_(terrain), radar_(radar), range_m_(length(target - radar)) {
    const Vec2d away{target.x - radar.x, target.y - radar.y};
    target_m_ = length(away);
    outwards_ = target_m_ > 0.0 ? away * (1.0 / target_m_) : Vec2d{0.0, 1.0};
  }

  [[nodiscard]] double target_m() const { return target_m_; }
  [[nodiscard]] Vec2d outwards() const { return outwards_; }
  [[nodiscard]] Vec2d place(double distance_m) const { return Vec2d{radar_.x, radar_.y} + outwards_ * distance_m; }
  /// No ground that is further away is as near as the target.
  [[nodiscard]] double furthest_m() const { return range_m_; }
  /// By how much the ground is further from the radar than the target, on the slant.
  [[nodiscard]] double excess_m(double distance_m) const {
    return std::hypot(distance_m, radar_.z - terrain_.height_at(place(distance_m))) - range_m_;
  }

 private:
  const terrain::HeightField& terrain_;
  Vec3d radar_;
  double range_m_, target_m_ = 0.0;
  Vec2d outwards_;
};

/// Where between two distances, of which it holds at one alone, something begins to hold: bisected.
template <typename Condition>
double change_between(double first_m, double second_m, const Condition& holds) {
  const bool at_first = holds(first_m);
  constexpr int halvings = 40;
  for (int k = 0; k < halvings; ++k) {
    const double middle_m = 0.5 * (first_m + second_m);
    (holds(middle_m) == at_first ? first_m : second_m) = middle_m;
  }
  return 0.5 * (first_m + second_m);
}

/// The first ground from the target on, in steps (negative: towards the radar) and up to a distance, whose range is the
/// target's to within `half_m`.
std::optional<double> first_shown(const GroundLine& line, double half_m, double step_m, double last_m) {
  double before_m = line.target_m();
  if (std::abs(line.excess_m(before_m)) <= half_m) return before_m;
  const auto is_further = [&](double distance_m) { return line.excess_m(distance_m) > 0.0; };
  const double sign = step_m < 0.0 ? -1.0 : 1.0;
  while (sign * (last_m - before_m) > 0.0) {
    const double here_m = sign * std::min(sign * (before_m + step_m), sign * last_m);
    if (std::abs(line.excess_m(here_m)) <= half_m) return here_m;
    // The response of a fine radar may lie between two steps.
    if (is_further(here_m) != is_further(before_m)) return change_between(before_m, here_m, is_further);
    before_m = here_m;
  }
  return std::nullopt;
}

/// How far the range stays that of the target to within `half_m`, in steps from a distance where it is.
double end_of_stretch(const GroundLine& line, double half_m, double step_m, double begin_m) {
  const auto is_shown = [&](double distance_m) { return std::abs(line.excess_m(distance_m)) <= half_m; };
  for (double here_m = begin_m;; here_m += step_m) {
    const double next_m = std::max(0.0, here_m + step_m);
    if (!is_shown(next_m)) return change_between(here_m, next_m, is_shown);
    if (next_m == 0.0) return next_m;
  }
}

/// Whether something of a length about a middle reaches into the map, which is so many cells long; all in cells.
bool reaches_in(double middle, double length, double cells) {
  return middle + length / 2.0 > 0.0 && middle - length / 2.0 < cells;
}

/// By an azimuth, clockwise.
Vec2d turned(Vec2d v, double azimuth_rad) {
  const double sine = std::sin(azimuth_rad), cosine = std::cos(azimuth_rad);
  return {v.x * cosine + v.y * sine, v.y * cosine - v.x * sine};
}

}  // namespace

std::optional<ShownStretch> shown_stretch(Vec3d target, const radar::Radar& radar, const terrain::HeightField& terrain,
                                          double cell_m) {
  const GroundLine line(target, radar.position, terrain);
  const double half_m = radar.range_resolution_m / 2.0, step_m = std::min(cell_m, terrain.spacing_m) / 4.0;
  const double there_m = line.target_m();
  const auto inwards = first_shown(line, half_m, -step_m, 0.0);
  // Outwards no further than would be nearer.
  const double last_m = inwards ? std::min(line.furthest_m(), 2.0 * there_m - *inwards) : line.furthest_m();
  const auto outwards = first_shown(line, half_m, step_m, last_m);
  const auto shown = outwards ? outwards : inwards;
  if (!shown) return std::nullopt;
  return ShownStretch{end_of_stretch(line, half_m, -step_m, *shown), end_of_stretch(line, half_m, step_m, *shown)};
}

product::TargetBox target_box(Vec3d target, double size_m, const radar::Radar& radar,
                              const terrain::HeightField& terrain, const radar::GroundGrid& grid) {
  const auto stretch = shown_stretch(target, radar, terrain, grid.cell_m);
  if (!stretch) return {};
  const GroundLine line(target, radar.position, terrain);
  const double middle_m = 0.5 * (stretch->near_m + stretch->far_m), along_m = stretch->far_m - stretch->near_m;
  // Sent and received over the same beam: its two-way half-power width.
  const auto [before_rad, behind_rad] = radar::antenna_pattern(radar).azimuth().two_way_half_power_rad();
  const double across_m = (behind_rad - before_rad) * middle_m;
  const double sine = std::abs(line.outwards().x), cosine = std::abs(line.outwards().y);
  const double wide = (along_m * sine + across_m * cosine) / grid.cell_m;
  const double tall = (along_m * cosine + across_m * sine) / grid.cell_m;
  // A beam that peaks to one side of its axis shows the target when the axis is on the other.
  const Vec2d foot{radar.position.x, radar.position.y};
  const Vec2d cell = grid.cells_from(foot + turned(line.place(middle_m) - foot, -0.5 * (before_rad + behind_rad)));
  const auto columns = static_cast<double>(grid.columns), rows = static_cast<double>(grid.rows);
  // Of a response beyond the map's edge the room about it alone would leave a sliver of a box, with no echo in it.
  if (!reaches_in(cell.x, wide, columns) || !reaches_in(cell.y, tall, rows)) return {};
  const double width = wide + size_m / grid.cell_m + 1.0, height = tall + size_m / grid.cell_m + 1.0;
  const double left = std::clamp(cell.x - width / 2.0, 0.0, columns),
               right = std::clamp(cell.x + width / 2.0, 0.0, columns);
  const double top = std::clamp(cell.y - height / 2.0, 0.0, rows),
               bottom = std::clamp(cell.y + height / 2.0, 0.0, rows);
  return {.x = left, .y = top, .width = right - left, .height = bottom - top};
}

}  // namespace sigmascape::dataset
