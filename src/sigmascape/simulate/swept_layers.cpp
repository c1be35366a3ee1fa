#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/target_shadows.h"
#include "sigmascape/simulate/layer_place.h"
#include "sigmascape/simulate/layers.h"
#include "sigmascape/terrain/ground_profile.h"
#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::simulate {
namespace {

/// Steps of the sweep a cell, along and across.
constexpr double steps_per_cell = 2.0;

/// The sector of azimuths and distances about a map, and beyond it whatever may hide it or lie over it.
struct SweptSector {
  double first_azimuth_rad = 0.0, azimuth_step_rad = 0.0;
  std::size_t azimuths = 0;
  double near_m = 0.0, step_m = 0.0;
  std::size_t steps = 0;
};

SweptSector sector_of(const CoarseGround& ground, const radar::Radar& radar, const radar::GroundGrid& grid) {
  const Vec2d here{radar.position.x, radar.position.y};
  const radar::Rectangle area = grid.extent(), all = ground.terrain->extent();
  const Vec2d middle = area.centre() - here;
  const double middle_rad = std::atan2(middle.x, middle.y);
  double half_rad = 0.0;
  for (const Vec2d corner : radar::corners_of(area)) {
    const Vec2d away = corner - here;
    half_rad = std::max(half_rad, std::abs(std::remainder(std::atan2(away.x, away.y) - middle_rad, 2.0 * pi)));
  }
  if (area.contains(here)) half_rad = pi;
  SweptSector sector;
  const double far_m = radar::farthest_m(area, here);
  sector.step_m = grid.cell_m / steps_per_cell;
  sector.azimuth_step_rad = sector.step_m / far_m;
  sector.azimuths = static_cast<std::size_t>(std::ceil(2.0 * half_rad / sector.azimuth_step_rad)) + 1;
  sector.first_azimuth_rad = middle_rad - half_rad;
  sector.near_m = radar::nearest_m(all, here);
  const double below_m = radar.position.z - static_cast<double>(ground.terrain->highest_m());
  const double above_m = radar.position.z - static_cast<double>(ground.terrain->lowest_m());
  // Beyond the map things matter as far as they can lie over it: at the range of its far end or nearer.
  const double last_range_m = std::hypot(far_m, above_m) + sector.step_m;
  const double below_tops_m = std::max(0.0, below_m - ground.tallest_m);
  const double end_m = std::sqrt(last_range_m * last_range_m - below_tops_m * below_tops_m);
  sector.steps = static_cast<std::size_t>(
                     std::ceil((std::min(radar::farthest_m(all, here), end_m) - sector.near_m) / sector.step_m)) +
                 1;
  return sector;
}

/// The places along one azimuth, outwards, and what the radar sees between which ranges: tells which of them something
/// else lies over. Of two places at one range, both below the radar, the farther one is the higher, so that each thing
/// lies over the places at its range that are nearer than itself.
class LayoverAlongAzimuth {
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

  /// For each place whether something that is seen lies over it.
  [[nodiscard]] std::vector<bool> lain_over() const {
    std::vector<std::size_t> by_range(ranges_m_.size());
    std::iota(by_range.begin(), by_range.end(), std::size_t{0});
    const auto range_of = [&](std::size_t place) { return ranges_m_[place]; };
    std::ranges::sort(by_range, {}, range_of);
    // What is seen comes from near to far, so that the last to be noted at a range is the farthest there.
    std::vector<std::size_t> farthest_there(by_range.size(), 0);
    for (const Seen& seen : seen_) {
      const auto first = std::ranges::lower_bound(by_range, seen.first_range_m, {}, range_of);
      const auto last = std::ranges::upper_bound(by_range, seen.last_range_m, {}, range_of);
      std::fill(farthest_there.begin() + (first - by_range.begin()), farthest_there.begin() + (last - by_range.begin()),
                seen.place);
    }
    std::vector<bool> is_lain_over(by_range.size());
    for (std::size_t i = 0; i < by_range.size(); ++i) is_lain_over[by_range[i]] = farthest_there[i] > by_range[i];
    return is_lain_over;
  }

 private:
  struct Seen {
    std::size_t place;  // lies over what is nearer than this
    double first_range_m, last_range_m;
  };
  std::vector<double> ranges_m_;
  std::vector<Seen> seen_;
};

/// What is hidden and what is lain over along each azimuth, by distance.
class SweptMasks {
 public:
  SweptMasks(const CoarseGround& ground, const radar::Radar& radar, const radar::GroundGrid& grid,
             const radar::TargetShadows& shadows, unsigned threads)
      : ground_(ground),
        radar_(radar),
        shadows_(shadows),
        sector_(sector_of(ground, radar, grid)),
        is_hidden_(sector_.steps, sector_.azimuths, 0),
        is_lain_over_(sector_.steps, sector_.azimuths, 0) {
    parallel_for(sector_.azimuths, threads, [&](std::size_t index, unsigned) { sweep(index); });
  }

  struct Masks {
    bool is_hidden = false, is_lain_over = false;
  };
  [[nodiscard]] Masks at(Vec2d point) const {
    const Vec2d away = point - Vec2d{radar_.position.x, radar_.position.y};
    const std::size_t row = row_of(away);
    const std::size_t step = drawn_to((length(away) - sector_.near_m) / sector_.step_m, sector_.steps);
    return {is_hidden_(step, row) != 0, is_lain_over_(step, row) != 0};
  }

 private:
  static std::size_t drawn_to(double position, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(count - 1)));
  }

  [[nodiscard]] std::size_t row_of(Vec2d away) const {
    const double middle =
        sector_.first_azimuth_rad + 0.5 * static_cast<double>(sector_.azimuths - 1) * sector_.azimuth_step_rad;
    const double azimuth = middle + turned_by_least(std::atan2(away.x, away.y) - middle);
    return drawn_to((azimuth - sector_.first_azimuth_rad) / sector_.azimuth_step_rad + 0.5, sector_.azimuths);
  }

  void sweep(std::size_t index) {
    const double azimuth = sector_.first_azimuth_rad + static_cast<double>(index) * sector_.azimuth_step_rad;
    terrain::ObstacleSweep sight(radar_.position.z);
    double horizon = -std::numeric_limits<double>::infinity();
    LayoverAlongAzimuth layover;
    std::vector<std::size_t> steps;
    terrain::GroundProfile profile(*ground_.terrain, ground_.obstacles);
    profile.walk({.origin = {radar_.position.x, radar_.position.y},
                  .direction = radar::horizontal_direction(azimuth),
                  .near_m = sector_.near_m,
                  .step_m = sector_.step_m,
                  .count = sector_.steps},
                 [&](std::size_t step, double distance_m, Vec3d point, const radar::Obstacle& obstacle) {
                   const bool is_behind_target = shadows_.hide(point);
                   const bool is_hidden =
                       sight.advance(distance_m, point.z, obstacle, sector_.step_m).ground < crown_hides_below ||
                       is_behind_target;
                   is_hidden_(step, index) = is_hidden ? 1 : 0;
                   steps.push_back(step);
                   layover.add_place(range_m(distance_m, point.z));
                   if (!is_hidden) layover.add_seen_ground();
                   const double slope = (point.z - radar_.position.z) / distance_m;
                   const Column column{distance_m, point.z, std::max(horizon, slope)};
                   if (!is_behind_target) lay_over(layover, column, obstacle);
                   horizon = std::max(horizon, slope + static_cast<double>(obstacle.solid_top_m) / distance_m);
                 });
    const std::vector<bool> is_lain_over = layover.lain_over();
    for (std::size_t i = 0; i < steps.size(); ++i) is_lain_over_(steps[i], index) = is_lain_over[i] ? 1 : 0;
  }

  [[nodiscard]] double range_m(double distance_m, double height_m) const {
    return std::hypot(distance_m, radar_.position.z - height_m);
  }

  /// What stands on one step of an azimuth.
  struct Column {
    double distance_m = 0.0, ground_m = 0.0;
    double horizon = 0.0;  ///< slope of the steepest line of sight to what is solid before it, and to its own ground
  };

  /// Notes what of an obstacle is seen, solid things and crowns.
  void lay_over(LayoverAlongAzimuth& layover, const Column& column, const radar::Obstacle& obstacle) const {
    if (obstacle.solid_top_m > 0.0F) lay_over(layover, column, 0.0F, obstacle.solid_top_m);
    if (obstacle.crown_top_m > obstacle.solid_top_m)
      lay_over(layover, column, std::max(obstacle.crown_base_m, obstacle.solid_top_m), obstacle.crown_top_m);
  }

  /// Notes the ranges of the part of a thing that rises above the steepest line of sight before it: of its near side
  /// from there up, and of its top, all the step long. Of crowns, which let through, every step has a near side.
  void lay_over(LayoverAlongAzimuth& layover, const Column& column, float base_m, float top_m) const {
    const double base = column.ground_m + static_cast<double>(base_m);
    const double top = column.ground_m + static_cast<double>(top_m);
    if (column.horizon * column.distance_m + radar_.position.z >= top) return;
    const double near_m = std::max(0.0, column.distance_m - sector_.step_m / 2.0);
    const double far_m = column.distance_m + sector_.step_m / 2.0;
    const double lowest = std::min(top, std::max(base, column.horizon * near_m + radar_.position.z));
    layover.add_seen_thing(range_m(near_m, top), std::max(range_m(far_m, top), range_m(near_m, lowest)));
  }

  const CoarseGround& ground_;
  const radar::Radar& radar_;
  const radar::TargetShadows& shadows_;
  SweptSector sector_;
  Array2D<std::uint8_t> is_hidden_, is_lain_over_;  // [step, azimuth]
};

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
  std::optional<SweptMasks> masks;
  const radar::TargetShadows shadows(targets, 0.0, radar.position);
  if (wants_masks) masks.emplace(ground, radar, grid, shadows, threads);
  parallel_for(grid.rows, threads, [&](std::size_t row, unsigned) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Vec2d point = grid.centre_of(column, row);
      const LayerPlace place(*ground.terrain, radar, point);
      const radar::Obstacle obstacle = ground.obstacles != nullptr ? ground.obstacles->at(point) : radar::Obstacle{};
      const auto masked = masks ? masks->at(point) : SweptMasks::Masks{};
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
