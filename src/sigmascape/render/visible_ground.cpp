#include "sigmascape/render/visible_ground.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/render/sweep_kernel.h"

namespace sigmascape::render {
namespace {

/// The steps that all azimuths walk.
struct Walk {
  double first_m = 0.0, step_m = 1.0;
  std::size_t lead_steps = 0, steps_per_sample = 1, steps = 0;

  [[nodiscard]] double distance_m(std::size_t step) const { return first_m + static_cast<double>(step) * step_m; }
};

/// No ground nearer than this can hide a point of the sector at `distance_m`: up to there its line of sight runs above
/// everything.
double clear_until_m(double radar_height_m, const terrain::TerrainView& view, double curvature_per_m,
                     double distance_m) {
  const double lowest_m = static_cast<double>(view.lowest_m), highest_m = static_cast<double>(view.highest_m);
  const double sagitta_m = 0.125 * curvature_per_m * distance_m * distance_m;
  const double margin_m = radar_height_m - highest_m - sagitta_m;
  return margin_m <= 0.0 ? 0.0 : distance_m * margin_m / (radar_height_m - lowest_m);
}

double distance_to(const radar::Rectangle& rectangle, Vec2d point) {
  const Vec2d nearest{std::clamp(point.x, rectangle.west_m, rectangle.east_m),
                      std::clamp(point.y, rectangle.south_m, rectangle.north_m)};
  return length(nearest - point);
}

Walk walk_over(const Vec3d& radar, const GroundSector& sector, const terrain::TerrainView& view,
               const VisibleGroundSettings& settings) {
  Walk walk;
  const bool sweeps = settings.method == VisibilityMethod::HorizonSweep;
  const double longest_m = settings.longest_step_cells * view.spacing_m;
  if (sweeps) {
    walk.steps_per_sample =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(sector.distance_step_m / longest_m - 1e-9)));
  }
  walk.step_m = sector.distance_step_m / static_cast<double>(walk.steps_per_sample);
  const double curvature = settings.earth.curvature_per_m();
  const double clear_m = std::min(clear_until_m(radar.z, view, curvature, sector.first_distance_m),
                                  clear_until_m(radar.z, view, curvature, sector.distance_m(sector.distances)));
  const double begin_m = std::max({clear_m, distance_to(view.extent(), {radar.x, radar.y}) - walk.step_m, 0.0});
  const double before_m = static_cast<double>(walk.steps_per_sample - 1) * walk.step_m;
  const double lead_m = sector.first_distance_m - before_m - begin_m;
  walk.lead_steps = sweeps && lead_m > 0.0 ? static_cast<std::size_t>(lead_m / walk.step_m) : 0;
  walk.first_m = sector.first_distance_m - before_m - static_cast<double>(walk.lead_steps) * walk.step_m;
  walk.steps = walk.lead_steps + walk.steps_per_sample * sector.distances;
  return walk;
}

/// Steps within which a straight line of places lies between 0 and `most`, as a real interval.
struct Stretch {
  double begin, end;
};

Stretch within(double start, double pace, double most, Stretch stretch) {
  if (std::abs(pace) < 1e-12) return start >= 0.0 && start <= most ? stretch : Stretch{0.0, -1.0};
  const double a = -start / pace, b = (most - start) / pace;
  return {std::max(stretch.begin, std::min(a, b)), std::min(stretch.end, std::max(a, b))};
}

/// Places sixteen azimuths from `first` on upon the lattice.
SweptAzimuths placed(std::size_t first, const Vec3d& radar, const GroundSector& sector,
                     const terrain::TerrainView& view, const Walk& walk) {
  SweptAzimuths block;
  block.first = first;
  const double most_columns = static_cast<double>(view.columns - 1), most_rows = static_cast<double>(view.rows - 1);
  const double from_column = (radar.x - view.west_m) / view.spacing_m;
  const double from_row = (view.north_m - radar.y) / view.spacing_m;
  const double last_step = static_cast<double>(walk.steps);
  std::array<Vec2d, SweptAzimuths::count> starts, paces;
  Stretch any{last_step, 0.0}, all{0.0, last_step};
  for (std::size_t lane = 0; lane < SweptAzimuths::count; ++lane) {
    const Vec2d direction = radar::horizontal_direction(sector.azimuth_rad(first + lane));
    const Vec2d cells_per_m{direction.x / view.spacing_m, -direction.y / view.spacing_m};
    starts[lane] = Vec2d{from_column, from_row} + cells_per_m * walk.first_m;
    paces[lane] = cells_per_m * walk.step_m;
    Stretch here = within(starts[lane].x, paces[lane].x, most_columns, {0.0, last_step});
    here = within(starts[lane].y, paces[lane].y, most_rows, here);
    all = {std::max(all.begin, here.begin), std::min(all.end, here.end)};
    if (here.begin <= here.end) any = {std::min(any.begin, here.begin), std::max(any.end, here.end)};
    block.east[lane] = static_cast<float>(direction.x);
    block.north[lane] = static_cast<float>(direction.y);
    block.weight[lane] = first + lane < sector.azimuths ? 1.0F : 0.0F;
  }
  const auto step_of = [&](double step) { return static_cast<std::size_t>(std::clamp(step, 0.0, last_step)); };
  block.any_begin = any.begin <= any.end ? step_of(std::floor(any.begin) - 1.0) : walk.steps;
  block.any_end = any.begin <= any.end ? step_of(std::ceil(any.end) + 2.0) : walk.steps;
  // A step inwards, so that rounding leads none of them off the lattice.
  block.all_begin = all.begin <= all.end ? step_of(std::ceil(all.begin) + 1.0) : walk.steps;
  block.all_end = all.begin <= all.end ? step_of(std::floor(all.end)) : walk.steps;
  for (std::size_t lane = 0; lane < SweptAzimuths::count; ++lane) {
    const Vec2d start = starts[lane] + paces[lane] * static_cast<double>(block.any_begin);
    block.column[lane] = static_cast<float>(start.x);
    block.row[lane] = static_cast<float>(start.y);
    block.column_step[lane] = static_cast<float>(paces[lane].x);
    block.row_step[lane] = static_cast<float>(paces[lane].y);
  }
  return block;
}

}  // namespace

VisibleGroundCounts VisibleGround::find(const Vec3d& radar, const GroundSector& sector,
                                        const terrain::TerrainView& view, GroundSamples& found) {
  found.fit(sector);
  const Walk walk = walk_over(radar, sector, view, settings_);
  const radar::CurvedEarth& earth = settings_.earth;
  per_distance_.resize(std::max(per_distance_.size(), walk.steps));
  lowered_m_.resize(std::max(lowered_m_.size(), walk.steps));
  for (std::size_t step = 0; step < walk.steps; ++step) {
    const double distance_m = walk.distance_m(step);
    per_distance_[step] = static_cast<float>(1.0 / distance_m);
    lowered_m_[step] = static_cast<float>(radar.z + earth.drop_m(distance_m));
  }
  for (auto* table : {&height_term_m_, &sea_range_squared_m2_, &sea_range_m_}) {
    table->resize(std::max(table->size(), sector.distances));
  }
  for (std::size_t k = 0; k < sector.distances; ++k) {
    const double stretched_m2 = earth.stretched_chord_m2(radar.z, sector.distance_m(k));
    const double squared_m2 = radar.z * radar.z + stretched_m2;
    found.sea_range_m()[k] = std::sqrt(squared_m2);
    height_term_m_[k] = static_cast<float>(stretched_m2 * earth.curvature_per_m() - 2.0 * radar.z);
    sea_range_squared_m2_[k] = static_cast<float>(squared_m2);
    sea_range_m_[k] = static_cast<float>(found.sea_range_m()[k]);
  }

  const SweepPlan plan{.height_m = view.height_m.data(),
                       .slope = view.slope.empty() ? nullptr : view.slope.data(),
                       .columns = static_cast<std::int32_t>(view.columns),
                       .rows = static_cast<std::int32_t>(view.rows),
                       .cells_per_m = static_cast<float>(1.0 / view.spacing_m),
                       .lead_steps = walk.lead_steps,
                       .steps_per_sample = walk.steps_per_sample,
                       .samples = sector.distances,
                       .per_distance = per_distance_.data(),
                       .lowered_m = lowered_m_.data(),
                       .height_term_m = height_term_m_.data(),
                       .sea_range_squared_m2 = sea_range_squared_m2_.data(),
                       .sea_range_m = sea_range_m_.data(),
                       .stride = found.stride(),
                       .visible = found.visible().data(),
                       .height_out_m = found.height_m().data(),
                       .range_excess_m = found.range_excess_m().data(),
                       .sin_grazing = found.sin_grazing().data(),
                       .sin_local_grazing = settings_.local_slopes ? found.sin_local_grazing().data() : nullptr,
                       .slope_area = settings_.local_slopes ? found.slope_area().data() : nullptr};

  std::atomic<std::size_t> on_terrain{0}, visible{0};
  const std::size_t blocks = (sector.azimuths + SweptAzimuths::count - 1) / SweptAzimuths::count;
  const auto work = [&](std::size_t group) {
    std::array<SweptAzimuths, SweptAzimuths::together> placed_blocks;
    const std::size_t first = group * SweptAzimuths::together;
    const std::size_t count = std::min(blocks - first, SweptAzimuths::together);
    for (std::size_t i = 0; i < count; ++i) {
      placed_blocks[i] = placed((first + i) * SweptAzimuths::count, radar, sector, view, walk);
    }
    const SweepCounts counts = sweep(plan, std::span(placed_blocks).first(count));
    on_terrain += counts.on_terrain;
    visible += counts.visible;
  };
  const std::size_t groups = (blocks + SweptAzimuths::together - 1) / SweptAzimuths::together;
  if (settings_.threads == 1) {
    for (std::size_t group = 0; group < groups; ++group) work(group);
  } else {
    parallel_for(groups, settings_.threads, [&](std::size_t group, unsigned) { work(group); });
  }

  VisibleGroundCounts counts{
      .samples = sector.azimuths * sector.distances, .on_terrain = on_terrain, .visible = visible};
  if (settings_.method == VisibilityMethod::Rasterization) {
    counts.triangles_left_out = raster_.draw(radar, earth, sector, view, settings_.raster, settings_.threads);
    counts.visible = raster_.mark_visible(radar, earth, sector, view, settings_.threads, found);
  }
  return counts;
}

}  // namespace sigmascape::render
