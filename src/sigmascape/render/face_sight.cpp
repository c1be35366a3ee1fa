#include "sigmascape/render/face_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sigmascape/base/parallel.h"
#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::render {
namespace {

/// Squares along a side of a block that is passed over at once where a line of sight runs above it.
constexpr std::size_t block_squares = 8;

/// Lines of sight are marched along until they have risen by the tallest obstacle; what lies beyond is asked for once
/// for many of them.
constexpr double least_march_m = 50.0;

/// How far before a wall the march begins, in squares: beyond those of its own house, which are the ones whose middles
/// lie within and reach half a diagonal, 0.71, beyond it at most.
constexpr double before_wall_squares = 0.75;
/// A face whose normal leans more than so far from the vertical is a wall.
constexpr double wall_normal_z = 0.5;
/// Squares of a roof know its height no better.
constexpr double roof_tolerance_m = 0.3;

/// By how much squares over sloping ground, or of a roof that slopes, may be higher than what stands in them.
double rise_across(Vec3d normal) {
  return (std::abs(normal.x) + std::abs(normal.y)) / normal.z;
}

}  // namespace

struct FaceSight::Way {
  Way(Vec3d from, Vec3d radar, const radar::CurvedEarth& earth)
      : start(from), curvature_per_m(earth.curvature_per_m()) {
    const Vec3d away = radar - from;
    length_m = std::hypot(away.x, away.y);
    rise = length_m > 0.0 ? away.z / length_m : std::numeric_limits<double>::infinity();
    direction = length_m > 0.0 ? Vec2d{away.x / length_m, away.y / length_m} : Vec2d{};
  }
  /// The same line, moved aside, from where that place lies along it.
  void go_on_beside(Vec2d offset) {
    start = {start.x + offset.x, start.y + offset.y, height_at(dot(offset, direction))};
  }
  [[nodiscard]] Vec2d place_at(double d) const { return {start.x + direction.x * d, start.y + direction.y * d}; }
  /// Between two points of the sea a straight line runs below it.
  [[nodiscard]] double height_at(double d) const {
    return start.z + d * rise - 0.5 * curvature_per_m * d * (length_m - d);
  }
  /// Whether it is above that height from there on.
  [[nodiscard]] bool has_left(double height_m, double d) const {
    return height_at(d) > height_m && rise >= 0.5 * curvature_per_m * (length_m - 2.0 * d);
  }

  Vec3d start;
  double curvature_per_m, length_m, rise;
  Vec2d direction;
};

FaceSight::FaceSight(const radar::ObstacleMap& obstacles, const terrain::HeightField& terrain,
                     const radar::Rectangle& about, const radar::CurvedEarth& earth, unsigned threads)
    : obstacles_(obstacles), terrain_(terrain), earth_(earth) {
  const radar::GroundGrid& grid = obstacles.grid;
  const auto block_of = [](double squares, std::size_t most) {
    return static_cast<std::size_t>(std::clamp(squares, 0.0, static_cast<double>(most)) / block_squares);
  };
  first_column_ = block_of((about.west_m - grid.west_m) / grid.cell_m, grid.columns);
  first_row_ = block_of((grid.north_m - about.north_m) / grid.cell_m, grid.rows);
  const std::size_t end_column =
      block_of((about.east_m - grid.west_m) / grid.cell_m + block_squares, grid.columns + block_squares - 1);
  const std::size_t end_row =
      block_of((grid.north_m - about.south_m) / grid.cell_m + block_squares, grid.rows + block_squares - 1);
  block_top_m_ = Array2D<float>(end_column - std::min(first_column_, end_column),
                                end_row - std::min(first_row_, end_row), std::numeric_limits<float>::lowest());
  std::vector<float> tallest_m(block_top_m_.rows(), 0.0F);
  parallel_for(block_top_m_.rows(), thread_count(threads), [&](std::size_t block_row, unsigned) {
    const std::size_t first = (first_row_ + block_row) * block_squares;
    for (std::size_t row = first; row < std::min(first + block_squares, grid.rows); ++row) {
      for (std::size_t column = first_column_ * block_squares;
           column < std::min(end_column * block_squares, grid.columns); ++column) {
        const float top_m = obstacles.obstacles(column, row).top_m();
        tallest_m[block_row] = std::max(tallest_m[block_row], top_m);
        float& block_m = block_top_m_(column / block_squares - first_column_, block_row);
        block_m = std::max(block_m, static_cast<float>(terrain.height_at(grid.centre_of(column, row))) + top_m);
      }
    }
  });
  for (const float row_m : tallest_m) tallest_m_ = std::max(tallest_m_, static_cast<double>(row_m));
  float tallest_of_all_m = 0.0F;
  for (const radar::Obstacle& obstacle : obstacles.obstacles.values())
    tallest_of_all_m = std::max(tallest_of_all_m, obstacle.top_m());
  highest_m_ = static_cast<double>(terrain.highest_m() + tallest_of_all_m);
}

double FaceSight::march_m(double rise) const {
  return std::clamp(tallest_m_ / std::max(rise, 1e-3), least_march_m, longest_march_m);
}

FaceSight::Block FaceSight::block_at(const Way& way, double d) const {
  const radar::GroundGrid& grid = obstacles_.grid;
  const double side_m = grid.cell_m * static_cast<double>(block_squares);
  const Vec2d place = way.place_at(d);
  const double across = (place.x - grid.west_m) / side_m, down = (grid.north_m - place.y) / side_m;
  const double column = std::floor(across) - static_cast<double>(first_column_),
               row = std::floor(down) - static_cast<double>(first_row_);
  if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(block_top_m_.columns()) &&
        row < static_cast<double>(block_top_m_.rows())))
    return {std::numeric_limits<double>::infinity(), d};
  const auto way_out_m = [side_m](double position, double direction) {
    const double part = position - std::floor(position);
    if (direction == 0.0) return std::numeric_limits<double>::infinity();
    return (direction > 0.0 ? 1.0 - part : part) * side_m / std::abs(direction);
  };
  const double out_m = std::min(way_out_m(across, way.direction.x), way_out_m(down, -way.direction.y));
  // Squares know the ground in their middles alone: a metre stands for what it rises between them.
  const double top_m =
      1.0 + static_cast<double>(block_top_m_(static_cast<std::size_t>(column), static_cast<std::size_t>(row)));
  return {top_m, d + out_m};
}

double FaceSight::clear_above_m(Vec2d place, Vec3d radar) const {
  const double ground_m = terrain_.height_at(place);
  const Way way({place.x, place.y, ground_m}, radar, earth_);
  const double stride_m = std::min(obstacles_.grid.cell_m, terrain_.spacing_m);
  double clear_m = std::numeric_limits<double>::lowest();
  // Raising the point by one metre raises its line by what is left of the way.
  const auto needed_m = [&](double top_m, double d) {
    return ground_m + (top_m - way.height_at(d)) / (1.0 - d / way.length_m);
  };
  double d = march_m(way.rise);
  while (d < way.length_m && !way.has_left(highest_m_, d) && terrain_.extent().contains(way.place_at(d))) {
    const Block block = block_at(way, d);
    const double end_m = std::min(block.end_m, 0.999 * way.length_m);
    if (end_m > d && std::max(needed_m(block.top_m, d), needed_m(block.top_m, end_m)) <= clear_m) {
      d = end_m + 1e-3 * stride_m;
      continue;
    }
    const Vec2d under = way.place_at(d);
    const double top_m = terrain_.height_at(under) + static_cast<double>(obstacles_.at(under).solid_top_m);
    clear_m = std::max(clear_m, needed_m(top_m, d));
    d += stride_m;
  }
  return clear_m;
}

double FaceSight::part_passed(Vec3d point, Vec3d normal, Vec3d radar, double clear_above_m) const {
  if (point.z <= clear_above_m) return 0.0;
  const double square_m = obstacles_.grid.cell_m;
  Way way(point, radar, earth_);
  double tolerance_m = 0.0, climb = 0.0;
  if (normal.z < wall_normal_z) {
    // Houses stand on the lowest of their ground: what of a wall is below the ground.
    if (point.z <= terrain_.height_at({point.x, point.y})) return 0.0;
    const double across = std::hypot(normal.x, normal.y);
    if (across > 0.0) way.go_on_beside(Vec2d{normal.x, normal.y} * (before_wall_squares * square_m / across));
  } else {
    const double of_ground = rise_across(terrain_.normal_at({point.x, point.y}));
    tolerance_m = roof_tolerance_m + square_m * (rise_across(normal) + of_ground);
    // Over the roof's own plane; what the line has climbed no doubt about the roof takes from it.
    climb = std::max(0.0, way.rise + dot(Vec2d{normal.x, normal.y}, way.direction) / normal.z);
  }
  const double end_m = std::min(march_m(way.rise), way.length_m), half_fall_m = 0.5 * square_m * std::abs(way.rise);
  double depth = 0.0;
  for (double d = 0.0; d < end_m && !way.has_left(highest_m_, d);) {
    const Block block = block_at(way, d);
    const double last_m = std::min(block.end_m, end_m);
    if (std::min(way.height_at(d), way.height_at(last_m)) - half_fall_m > block.top_m) {
      d += square_m * std::max(1.0, std::floor((last_m - d) / square_m));
      continue;
    }
    const Vec2d under = way.place_at(d);
    const radar::Obstacle obstacle = obstacles_.at(under);
    const double above_m = way.height_at(d) - terrain_.height_at(under);
    // Where it begins, what of a wall is within another house is so too.
    const double in_doubt_m = std::max(0.0, tolerance_m - d * climb);
    if (above_m < static_cast<double>(obstacle.solid_top_m) - in_doubt_m || above_m + in_doubt_m <= 0.0) return 0.0;
    if (obstacle.crown_top_m > 0.0F) {
      const double way_m = (d == 0.0 ? 0.5 : 1.0) * square_m * std::sqrt(1.0 + way.rise * way.rise);
      depth += static_cast<double>(obstacle.crown_extinction_per_m) * way_m *
               terrain::part_within(obstacle, above_m, half_fall_m);
    }
    d += square_m;
  }
  return std::exp(-depth);
}

}  // namespace sigmascape::render
