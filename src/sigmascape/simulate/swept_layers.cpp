#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/target_shadows.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/simulate/layer_place.h"
#include "sigmascape/simulate/layers.h"
#include "sigmascape/simulate/swept_lines.h"
#include "sigmascape/terrain/ground_profile.h"
#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::simulate {
namespace {

/// The places along one line, outwards, and what the radar sees between which ranges: tells which of them something
/// else lies over. Of two places at one range, both below the radar, the farther one is the higher, so that each thing
/// lies over the places at its range that are nearer than itself. What stands above the radar is higher than all of
/// them.
class LayoverAlongLine {
 public:
  /// The next place outwards, where the ground lies at that slant range.
  void add_place(double range_m) { ranges_m_.push_back(range_m); }

  /// The ground between the place before the last and the last is seen. It lies over places only where the range has
  /// gone back, on slopes steeper than the arc of equal range; never over the two that it joins.
  void add_seen_ground() {
    if (ranges_m_.size() < 2) return;
    const std::size_t last = ranges_m_.size() - 1;
    const auto [first_m, last_m] = std::minmax(ranges_m_[last - 1], ranges_m_[last]);
    seen_.push_back({last - 1, first_m, last_m});
  }

  /// Something on the last place is seen between two slant ranges.
  void add_seen_thing(double first_range_m, double last_range_m) {
    seen_.push_back({ranges_m_.size() - 1, first_range_m, last_range_m});
  }

  /// The same of something above the radar.
  void add_seen_overhead(double first_range_m, double last_range_m) {
    seen_.push_back({beyond_all, first_range_m, last_range_m});
  }

  /// For each place whether something that is seen lies over it.
  [[nodiscard]] std::vector<bool> lain_over() const {
    std::vector<std::size_t> by_range(ranges_m_.size());
    std::iota(by_range.begin(), by_range.end(), std::size_t{0});
    const auto range_of = [&](std::size_t place) { return ranges_m_[place]; };
    std::ranges::sort(by_range, {}, range_of);
    std::vector<std::size_t> farthest_there(by_range.size(), 0);
    for (const Seen& seen : seen_) {
      const auto first = std::ranges::lower_bound(by_range, seen.first_range_m, {}, range_of);
      const auto last = std::ranges::upper_bound(by_range, seen.last_range_m, {}, range_of);
      std::for_each(farthest_there.begin() + (first - by_range.begin()),
                    farthest_there.begin() + (last - by_range.begin()),
                    [&](std::size_t& place) { place = std::max(place, seen.place); });
    }
    std::vector<bool> is_lain_over(by_range.size());
    for (std::size_t i = 0; i < by_range.size(); ++i) is_lain_over[by_range[i]] = farthest_there[i] > by_range[i];
    return is_lain_over;
  }

 private:
  static constexpr std::size_t beyond_all = std::numeric_limits<std::size_t>::max();
  struct Seen {
    std::size_t place;  // lies over what is nearer than this
    double first_range_m, last_range_m;
  };
  std::vector<double> ranges_m_;
  std::vector<Seen> seen_;
};

/// What of a place the radar does not see, and what lies over it.
struct Masks {
  bool is_hidden = false, is_lain_over = false;
};

/// What is hidden and what is lain over along one line, outwards.
class LineSweep {
 public:
  LineSweep(const CoarseGround& ground, const radar::TargetShadows& shadows, double platform_m, double step_m)
      : ground_(ground), shadows_(shadows), platform_m_(platform_m), step_m_(step_m) {}

  /// Calls `put(step, masks)` for every place of the line that lies on the terrain.
  template <typename Put>
  void sweep(const terrain::GroundLine& line, const Put& put) const {
    terrain::ObstacleSweep sight(platform_m_);
    double horizon = -std::numeric_limits<double>::infinity();
    LayoverAlongLine layover;
    std::vector<std::size_t> steps;
    std::vector<bool> hidden;
    terrain::GroundProfile profile(*ground_.terrain, ground_.obstacles);
    profile.walk(line, [&](std::size_t step, double distance_m, Vec3d point, const radar::Obstacle& obstacle) {
      const bool is_behind_target = shadows_.hide(point);
      const bool is_hidden =
          sight.advance(distance_m, point.z, obstacle, step_m_).ground < crown_hides_below || is_behind_target;
      steps.push_back(step);
      hidden.push_back(is_hidden);
      layover.add_place(range_m(distance_m, point.z));
      if (!is_hidden) layover.add_seen_ground();
      const double slope = (point.z - platform_m_) / distance_m;
      const Column column{distance_m, point.z, std::max(horizon, slope)};
      if (!is_behind_target) lay_over(layover, column, obstacle);
      horizon = std::max(horizon, slope + static_cast<double>(obstacle.solid_top_m) / distance_m);
    });
    const std::vector<bool> is_lain_over = layover.lain_over();
    for (std::size_t i = 0; i < steps.size(); ++i) put(steps[i], Masks{hidden[i], is_lain_over[i]});
  }

 private:
  [[nodiscard]] double range_m(double distance_m, double height_m) const {
    return std::hypot(distance_m, platform_m_ - height_m);
  }

  /// What stands on one step.
  struct Column {
    double distance_m = 0.0, ground_m = 0.0;
    double horizon = 0.0;  ///< slope of the steepest line of sight to what is solid before it, and to its own ground
  };

  /// Notes what of an obstacle is seen, solid things and crowns.
  void lay_over(LayoverAlongLine& layover, const Column& column, const radar::Obstacle& obstacle) const {
    if (obstacle.solid_top_m > 0.0F) lay_over(layover, column, 0.0F, obstacle.solid_top_m);
    if (obstacle.crown_top_m > obstacle.solid_top_m)
      lay_over(layover, column, std::max(obstacle.crown_base_m, obstacle.solid_top_m), obstacle.crown_top_m);
  }

  /// Notes the ranges of the part of a thing that rises above the steepest line of sight before it: of its near side
  /// from there up, and of its top, all the step long. Of crowns, which let through, every step has a near side.
  void lay_over(LayoverAlongLine& layover, const Column& column, float base_m, float top_m) const {
    const double base = column.ground_m + static_cast<double>(base_m);
    const double top = column.ground_m + static_cast<double>(top_m);
    if (column.horizon * column.distance_m + platform_m_ >= top) return;
    const double near_m = std::max(0.0, column.distance_m - step_m_ / 2.0);
    const double far_m = column.distance_m + step_m_ / 2.0;
    const double lowest = std::min(top, std::max(base, column.horizon * near_m + platform_m_));
    if (top <= platform_m_) {
      layover.add_seen_thing(range_m(near_m, top), std::max(range_m(far_m, top), range_m(near_m, lowest)));
      return;
    }
    // Of its top nothing is seen, and what of it is nearest is as high as the radar.
    layover.add_seen_overhead(range_m(near_m, std::max(lowest, platform_m_)), range_m(near_m, top));
    if (lowest < platform_m_) layover.add_seen_thing(near_m, range_m(near_m, lowest));
  }

  const CoarseGround& ground_;
  const radar::TargetShadows& shadows_;
  double platform_m_, step_m_;
};

/// What is hidden and what is lain over along each of many lines.
class SweptMasks {
 public:
  SweptMasks(const CoarseGround& ground, const radar::TargetShadows& shadows, SweptLines lines, unsigned threads)
      : lines_(std::move(lines)), masks_(lines_.steps, lines_.lines) {
    parallel_for(lines_.lines, threads, [&](std::size_t index, unsigned) {
      const SweptLine line = lines_.line(index);
      const std::size_t strides = lines_.strides;
      const double stride_m = lines_.step_m / static_cast<double>(strides);
      LineSweep(ground, shadows, line.platform.z, stride_m)
          .sweep({.origin = {line.platform.x, line.platform.y},
                  .direction = line.direction,
                  .near_m = lines_.near_m,
                  .step_m = stride_m,
                  .count = lines_.steps * strides},
                 [&](std::size_t stride, const Masks& masks) {
                   if (stride % strides == strides / 2) masks_(stride / strides, index) = masks;
                 });
    });
  }

  [[nodiscard]] bool tells_of(Vec2d point) const { return !masks_.empty() && lines_.sees(point); }
  /// That of the nearest place that was swept.
  [[nodiscard]] Masks at(Vec2d point) const {
    const Vec2d place = lines_.place_of(point);
    return masks_(drawn_to(place.x, lines_.steps), drawn_to(place.y + 0.5, lines_.lines));
  }

 private:
  static std::size_t drawn_to(double position, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(count - 1)));
  }

  SweptLines lines_;
  Array2D<Masks> masks_;  // [step, line]
};

std::vector<SweptMasks> swept_masks(const CoarseGround& ground, const radar::Vantage& vantage,
                                    const radar::TargetShadows& shadows, const radar::GroundGrid& grid,
                                    unsigned threads) {
  std::vector<SweptMasks> masks;
  for (SweptLines& lines : swept_lines(ground, vantage, grid))
    masks.emplace_back(ground, shadows, std::move(lines), threads);
  return masks;
}

/// Where nothing was swept nothing hides or lies over.
Masks masks_at(const std::vector<SweptMasks>& swept, Vec2d point) {
  const auto found = std::ranges::find_if(swept, [&](const SweptMasks& masks) { return masks.tells_of(point); });
  return found == swept.end() ? Masks{} : found->at(point);
}

float class_at(const CoarseGround& ground, Vec2d point, const radar::Obstacle& obstacle, std::size_t materials) {
  if (obstacle.solid_top_m > 0.0F && obstacle.solid_top_m >= obstacle.crown_top_m) return static_cast<float>(materials);
  if (obstacle.crown_top_m > 0.0F) return static_cast<float>(materials + 1);
  return ground.materials->at(point);
}

}  // namespace

radar::LayerStack swept_layers(const CoarseGround& ground, const radar::Radar& radar, const radar::GroundGrid& grid,
                               std::span<const LayerKind> kinds, unsigned threads,
                               std::span<const radar::Target> targets) {
  radar::LayerStack stack = empty_layers(grid, kinds);
  const bool wants_masks = std::ranges::any_of(
      kinds, [](LayerKind kind) { return kind == LayerKind::Shadow || kind == LayerKind::Layover; });
  const radar::Vantage vantage = radar::vantage_of(radar, grid.extent().centre());
  const radar::TargetShadows shadows(targets, vantage);
  std::vector<SweptMasks> masks;
  if (wants_masks) masks = swept_masks(ground, vantage, shadows, grid, threads);
  parallel_for(grid.rows, threads, [&](std::size_t row, unsigned) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Vec2d point = grid.centre_of(column, row);
      const LayerPlace place(*ground.terrain, vantage.place_for(point), point);
      const radar::Obstacle obstacle = ground.obstacles != nullptr ? ground.obstacles->at(point) : radar::Obstacle{};
      const Masks masked = masks_at(masks, point);
      const auto value = [&](LayerKind kind) -> float {
        switch (kind) {
          case LayerKind::Shadow:
            return masked.is_hidden ? 1.0F : 0.0F;
          case LayerKind::Layover:
            return masked.is_lain_over ? 1.0F : 0.0F;
          case LayerKind::Incidence:
            return place.incidence_rad(*ground.terrain);
          case LayerKind::Range:
            return static_cast<float>(place.range_m);
          case LayerKind::Class:
            return class_at(ground, point, obstacle, ground.material_count);
          case LayerKind::Height:
            return static_cast<float>(place.ground.z) + obstacle.top_m();
        }
        return 0.0F;
      };
      for (std::size_t k = 0; k < kinds.size(); ++k) stack.layers[k].values(column, row) = value(kinds[k]);
    }
  });
  return stack;
}

}  // namespace sigmascape::simulate
