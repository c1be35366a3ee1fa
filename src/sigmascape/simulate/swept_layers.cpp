#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/look.h"
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
  double first_range_m = 0.0, range_step_m = 0.0;
  std::size_t ranges = 0;
};

std::array<Vec2d, 4> corners_of(const radar::Rectangle& r) {
  return {Vec2d{r.west_m, r.south_m}, {r.east_m, r.south_m}, {r.west_m, r.north_m}, {r.east_m, r.north_m}};
}

double nearest_m(const radar::Rectangle& r, Vec2d p) {
  return length(Vec2d{std::clamp(p.x, r.west_m, r.east_m), std::clamp(p.y, r.south_m, r.north_m)} - p);
}

double farthest_m(const radar::Rectangle& r, Vec2d p) {
  double farthest = 0.0;
  for (const Vec2d corner : corners_of(r)) farthest = std::max(farthest, length(corner - p));
  return farthest;
}

SweptSector sector_of(const CoarseGround& ground, const radar::Radar& radar, const radar::GroundGrid& grid) {
  const Vec2d here{radar.position.x, radar.position.y};
  const radar::Rectangle area = grid.extent(), all = ground.terrain->extent();
  const Vec2d middle = area.centre() - here;
  const double middle_rad = std::atan2(middle.x, middle.y);
  double half_rad = 0.0;
  for (const Vec2d corner : corners_of(area)) {
    const Vec2d away = corner - here;
    half_rad = std::max(half_rad, std::abs(std::remainder(std::atan2(away.x, away.y) - middle_rad, 2.0 * pi)));
  }
  if (area.contains(here)) half_rad = pi;
  SweptSector sector;
  const double far_m = farthest_m(area, here);
  sector.step_m = grid.cell_m / steps_per_cell;
  sector.azimuth_step_rad = sector.step_m / far_m;
  sector.azimuths = static_cast<std::size_t>(std::ceil(2.0 * half_rad / sector.azimuth_step_rad)) + 1;
  sector.first_azimuth_rad = middle_rad - half_rad;
  sector.near_m = nearest_m(all, here);
  const double below_m = radar.position.z - static_cast<double>(ground.terrain->highest_m());
  const double above_m = radar.position.z - static_cast<double>(ground.terrain->lowest_m());
  // Far off, a step over the ground is nearly one of slant range; right below the radar it is less, and bins are more.
  const double near_area_m = nearest_m(area, here);
  sector.first_range_m = std::hypot(near_area_m, below_m);
  sector.range_step_m = sector.step_m * std::max(0.05, near_area_m / std::hypot(near_area_m, above_m));
  sector.ranges =
      static_cast<std::size_t>(std::ceil((std::hypot(far_m, above_m) - sector.first_range_m) / sector.range_step_m)) +
      1;
  // Beyond the map things matter as far as they can lie over it: at the range of its far end or nearer.
  const double last_range_m = sector.first_range_m + static_cast<double>(sector.ranges) * sector.range_step_m;
  const double below_tops_m = std::max(0.0, below_m - ground.tallest_m);
  const double end_m = std::sqrt(last_range_m * last_range_m - below_tops_m * below_tops_m);
  sector.steps =
      static_cast<std::size_t>(std::ceil((std::min(farthest_m(all, here), end_m) - sector.near_m) / sector.step_m)) + 1;
  return sector;
}

/// What is hidden along each azimuth by distance, and what is lain over by range.
class SweptMasks {
 public:
  SweptMasks(const CoarseGround& ground, const radar::Radar& radar, const radar::GroundGrid& grid, unsigned threads)
      : ground_(ground),
        radar_(radar),
        sector_(sector_of(ground, radar, grid)),
        is_hidden_(sector_.steps, sector_.azimuths, 0),
        is_lain_over_(sector_.ranges, sector_.azimuths, 0) {
    parallel_for(sector_.azimuths, threads, [&](std::size_t index, unsigned) { sweep(index); });
  }

  struct Masks {
    bool is_hidden = false, is_lain_over = false;
  };
  [[nodiscard]] Masks at(const LayerPlace& place) const {
    const Vec2d away{place.ground.x - radar_.position.x, place.ground.y - radar_.position.y};
    const std::size_t row = row_of(away);
    const double step = (length(away) - sector_.near_m) / sector_.step_m;
    const double bin = (place.range_m - sector_.first_range_m) / sector_.range_step_m;
    return {is_hidden_(drawn_to(step, sector_.steps), row) != 0,
            is_lain_over_(drawn_to(bin, sector_.ranges), row) != 0};
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
    terrain::GroundProfile profile(*ground_.terrain, ground_.obstacles);
    profile.walk({.origin = {radar_.position.x, radar_.position.y},
                  .direction = radar::horizontal_direction(azimuth),
                  .near_m = sector_.near_m,
                  .step_m = sector_.step_m,
                  .count = sector_.steps},
                 [&](std::size_t step, double distance_m, Vec3d point, const radar::Obstacle& obstacle) {
                   is_hidden_(step, index) =
                       sight.advance(distance_m, point.z, obstacle, sector_.step_m).ground < crown_hides_below ? 1 : 0;
                   const double slope = (point.z - radar_.position.z) / distance_m;
                   if (obstacle.top_m() > 0.0F)
                     lay_over(index, distance_m, point.z, obstacle.top_m(), std::max(horizon, slope));
                   horizon = std::max(horizon, slope + static_cast<double>(obstacle.solid_top_m) / distance_m);
                 });
  }

  /// Marks the ranges of the part of a thing that rises above the steepest line of sight before it.
  void lay_over(std::size_t index, double distance_m, double height_m, float top_m, double horizon) {
    const double top = height_m + static_cast<double>(top_m);
    const double lowest = horizon * distance_m + radar_.position.z;
    if (lowest >= top) return;
    const auto bin_of = [&](double height) {
      const double below_m = radar_.position.z - height;
      return (std::sqrt(distance_m * distance_m + below_m * below_m) - sector_.first_range_m) / sector_.range_step_m;
    };
    const double first = std::max(0.0, bin_of(top)),
                 last = std::min(static_cast<double>(sector_.ranges) - 1.0, bin_of(lowest));
    if (last < 0.0) return;
    for (auto bin = static_cast<std::size_t>(first); static_cast<double>(bin) <= last; ++bin)
      is_lain_over_(bin, index) = 1;
  }

  const CoarseGround& ground_;
  const radar::Radar& radar_;
  SweptSector sector_;
  Array2D<std::uint8_t> is_hidden_;     // [step, azimuth]
  Array2D<std::uint8_t> is_lain_over_;  // [range, azimuth]
};

float class_at(const CoarseGround& ground, Vec2d point, const radar::Obstacle& obstacle, std::size_t materials) {
  if (obstacle.solid_top_m > 0.0F && obstacle.solid_top_m >= obstacle.crown_top_m) return static_cast<float>(materials);
  if (obstacle.crown_top_m > 0.0F) return static_cast<float>(materials + 1);
  return ground.materials->at(point);
}

}  // namespace

radar::LayerStack swept_layers(const CoarseGround& ground, const radar::Radar& radar, const radar::GroundGrid& grid,
                               std::span<const LayerKind> kinds, unsigned threads) {
  radar::LayerStack stack = empty_layers(grid, kinds);
  const bool wants_masks = std::ranges::any_of(
      kinds, [](LayerKind kind) { return kind == LayerKind::Shadow || kind == LayerKind::Layover; });
  std::optional<SweptMasks> masks;
  if (wants_masks) masks.emplace(ground, radar, grid, threads);
  parallel_for(grid.rows, threads, [&](std::size_t row, unsigned) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Vec2d point = grid.centre_of(column, row);
      const LayerPlace place(*ground.terrain, radar, point);
      const radar::Obstacle obstacle = ground.obstacles != nullptr ? ground.obstacles->at(point) : radar::Obstacle{};
      const auto masked = masks ? masks->at(place) : SweptMasks::Masks{};
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
