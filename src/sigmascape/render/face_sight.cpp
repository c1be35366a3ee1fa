#include "sigmascape/render/face_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/terrain/obstacle_sweep.h"
#include "sigmascape/terrain/roof_doubt.h"

namespace sigmascape::render {
namespace {

/// Squares along a side of a block that is passed over at once where a line of sight runs above its crowns.
constexpr std::size_t block_squares = 8;

/// Crowns weaken what lies no farther behind them.
constexpr double farthest_crowns_m = 2000.0;

/// How far before a wall its line of sight begins, in squares: beyond those of its own house, which are the ones whose
/// middles lie within and reach half a diagonal, 0.71, beyond it at most.
constexpr double before_wall_squares = 0.75;
/// A face whose normal leans more than so far from the vertical is a wall.
constexpr double wall_normal_z = 0.5;

/// An area, and what lies before it as seen from a radar as far as crowns weaken what lies behind them.
radar::Rectangle with_what_lies_before(const radar::Rectangle& area, Vec3d radar) {
  const Vec2d away = Vec2d{radar.x, radar.y} - area.centre();
  const double distance_m = length(away);
  if (distance_m == 0.0) return area;
  return radar::joined(area, radar::moved(area, away * (std::min(distance_m, farthest_crowns_m) / distance_m)));
}

}  // namespace

FaceSight::FaceSight(const radar::ObstacleMap& obstacles, const terrain::HeightField& terrain,
                     const radar::Vantage& vantage, const radar::Rectangle& area, const radar::CurvedEarth& earth,
                     unsigned threads)
    : obstacles_(obstacles),
      terrain_(terrain),
      earth_(earth),
      // Lines of sight begin a little before their faces.
      skyline_(obstacles, terrain, vantage,
               radar::widened(area, (terrain::most_doubtful_squares + 1.0) * obstacles.grid.cell_m), earth, threads) {
  find_crowns(with_what_lies_before(area, vantage.place_for(area.centre())), threads);
}

void FaceSight::find_crowns(const radar::Rectangle& about, unsigned threads) {
  constexpr float none = std::numeric_limits<float>::lowest();
  const radar::GroundGrid& grid = obstacles_.grid;
  const auto block_of = [](double squares, std::size_t most) {
    return static_cast<std::size_t>(std::clamp(squares, 0.0, static_cast<double>(most)) / block_squares);
  };
  first_column_ = block_of((about.west_m - grid.west_m) / grid.cell_m, grid.columns);
  first_row_ = block_of((grid.north_m - about.north_m) / grid.cell_m, grid.rows);
  const std::size_t end_column =
      block_of((about.east_m - grid.west_m) / grid.cell_m + block_squares, grid.columns + block_squares - 1);
  const std::size_t end_row =
      block_of((grid.north_m - about.south_m) / grid.cell_m + block_squares, grid.rows + block_squares - 1);
  crown_top_m_ =
      Array2D<float>(end_column - std::min(first_column_, end_column), end_row - std::min(first_row_, end_row), none);
  parallel_for(crown_top_m_.rows(), thread_count(threads), [&](std::size_t block_row, unsigned) {
    const std::size_t first = (first_row_ + block_row) * block_squares;
    for (std::size_t row = first; row < std::min(first + block_squares, grid.rows); ++row) {
      for (std::size_t column = first_column_ * block_squares;
           column < std::min(end_column * block_squares, grid.columns); ++column) {
        const float crown_top_m = obstacles_.obstacles(column, row).crown_top_m;
        if (!(crown_top_m > 0.0F)) continue;
        float& block_m = crown_top_m_(column / block_squares - first_column_, block_row);
        const auto ground_m = static_cast<float>(terrain_.height_at(grid.centre_of(column, row)));
        // Squares know the ground in their middles alone: a metre stands for what it rises between them.
        block_m = std::max(block_m, ground_m + crown_top_m + 1.0F);
      }
    }
  });
  highest_crown_m_ = static_cast<double>(none);
  for (const float block_m : crown_top_m_.values())
    highest_crown_m_ = std::max(highest_crown_m_, static_cast<double>(block_m));
}

FaceSight::Block FaceSight::block_at(const radar::StraightSight& way, double d) const {
  const radar::GroundGrid& grid = obstacles_.grid;
  const double side_m = grid.cell_m * static_cast<double>(block_squares);
  const Vec2d place = way.place_at(d);
  const double across = (place.x - grid.west_m) / side_m, down = (grid.north_m - place.y) / side_m;
  const auto way_out_m = [side_m](double position, double direction) {
    const double part = position - std::floor(position);
    if (direction == 0.0) return std::numeric_limits<double>::infinity();
    return (direction > 0.0 ? 1.0 - part : part) * side_m / std::abs(direction);
  };
  Block block{std::numeric_limits<double>::lowest(),
              d + std::min(way_out_m(across, way.direction.x), way_out_m(down, -way.direction.y))};
  const double column = std::floor(across) - static_cast<double>(first_column_),
               row = std::floor(down) - static_cast<double>(first_row_);
  if (column >= 0.0 && row >= 0.0 && column < static_cast<double>(crown_top_m_.columns()) &&
      row < static_cast<double>(crown_top_m_.rows())) {
    block.top_m = static_cast<double>(crown_top_m_(static_cast<std::size_t>(column), static_cast<std::size_t>(row)));
  }
  return block;
}

bool FaceSight::is_hidden_at(const radar::StraightSight& way, double d, double doubt_m) const {
  const Vec2d under = way.place_at(d);
  const double above_m = way.height_at(d) - terrain_.height_at(under);
  return above_m < static_cast<double>(obstacles_.at(under).solid_top_m) - doubt_m || above_m + doubt_m <= 0.0;
}

double FaceSight::part_passed(Vec3d point, Vec3d normal, Vec3d radar) const {
  const double square_m = obstacles_.grid.cell_m;
  radar::StraightSight way(point, radar, earth_);
  double looked_at_m = 0.0;  // from the start of the way, without the skyline
  if (normal.z < wall_normal_z) {
    // Houses stand on the lowest of their ground: what of a wall is below the ground.
    if (point.z <= terrain_.height_at({point.x, point.y})) return 0.0;
    const double across = std::hypot(normal.x, normal.y);
    if (across > 0.0) way.go_on_beside(Vec2d{normal.x, normal.y} * (before_wall_squares * square_m / across));
    if (is_hidden_at(way, 0.0, 0.0)) return 0.0;
  } else {
    const double of_ground = terrain::rise_across(terrain_.normal_at({point.x, point.y}));
    const double tolerance_m = terrain::roof_tolerance_m + square_m * (terrain::rise_across(normal) + of_ground);
    // Over the roof's own plane; what the line has climbed no doubt about the roof takes from it.
    const double climb = std::max(0.0, way.rise + dot(Vec2d{normal.x, normal.y}, way.direction) / normal.z);
    const double end_m = std::min(way.length_m, terrain::most_doubtful_squares * square_m);
    for (; looked_at_m < end_m && looked_at_m * climb < tolerance_m; looked_at_m += square_m)
      if (is_hidden_at(way, looked_at_m, tolerance_m - looked_at_m * climb)) return 0.0;
  }
  if (looked_at_m >= way.length_m) return 1.0;
  const double slope = Skyline::slope_to(point, radar, earth_);
  const Skyline::Slopes skyline = skyline_.before(way.place_at(looked_at_m));
  if (slope < static_cast<double>(skyline.solid)) return 0.0;
  const Vec2d start = way.place_at(0.0);
  const float crowns = looked_at_m > 0.0 ? skyline_.before(start).crowns : skyline.crowns;
  const bool is_over_crowns = slope > static_cast<double>(crowns) && !(obstacles_.at(start).crown_top_m > 0.0F);
  return is_over_crowns ? 1.0 : part_through_crowns(way);
}

double FaceSight::part_through_crowns(const radar::StraightSight& way) const {
  const double square_m = obstacles_.grid.cell_m, half_fall_m = 0.5 * square_m * std::abs(way.rise);
  const double way_a_square_m = square_m * std::sqrt(1.0 + way.rise * way.rise);
  const double end_m = std::min(farthest_crowns_m, way.length_m);
  double depth = 0.0;
  for (double d = 0.0; d < end_m && !way.has_left(highest_crown_m_, d);) {
    const Block block = block_at(way, d);
    const double last_m = std::min(block.end_m, end_m);
    if (std::min(way.height_at(d), way.height_at(last_m)) - half_fall_m > block.top_m) {
      d += square_m * std::max(1.0, std::floor((last_m - d) / square_m));
      continue;
    }
    const Vec2d under = way.place_at(d);
    const radar::Obstacle obstacle = obstacles_.at(under);
    if (obstacle.crown_top_m > 0.0F) {
      const double above_m = way.height_at(d) - terrain_.height_at(under);
      // Of the first square what lies before its middle.
      depth += static_cast<double>(obstacle.crown_extinction_per_m) * (d == 0.0 ? 0.5 : 1.0) * way_a_square_m *
               terrain::part_within(obstacle, above_m, half_fall_m);
    }
    d += square_m;
  }
  return std::exp(-depth);
}

}  // namespace sigmascape::render
