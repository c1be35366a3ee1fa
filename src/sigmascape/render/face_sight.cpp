#include "sigmascape/render/face_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::render {
namespace {

/// Squares along a side of a block that is passed over at once where a line of sight runs above it.
constexpr std::size_t block_squares = 8;

/// Lines of sight are marched along until they have risen by the tallest obstacle, or for so far; what lies beyond is
/// asked for once for many of them.
constexpr double longest_march_m = 500.0, least_march_m = 50.0;

/// How far before a wall the march begins, in squares: beyond those of its own house, which are the ones whose middles
/// lie within and reach half a diagonal, 0.71, beyond it at most.
constexpr double before_wall_squares = 0.75;
/// A face whose normal leans more than so far from the vertical is a wall.
constexpr double wall_normal_z = 0.5;
/// Squares of a roof know its height no better.
constexpr double roof_tolerance_m = 0.3;

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

  Vec3d start;
  double curvature_per_m, length_m, rise;
  Vec2d direction;
};

FaceSight::FaceSight(const radar::ObstacleMap& obstacles, const terrain::HeightField& terrain,
                     const radar::CurvedEarth& earth)
    : obstacles_(obstacles), terrain_(terrain), earth_(earth) {
  const radar::GroundGrid& grid = obstacles.grid;
  block_top_m_ = Array2D<float>((grid.columns + block_squares - 1) / block_squares,
                                (grid.rows + block_squares - 1) / block_squares, std::numeric_limits<float>::lowest());
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const float top_m = obstacles.obstacles(column, row).top_m();
      tallest_m_ = std::max(tallest_m_, static_cast<double>(top_m));
      float& block_m = block_top_m_(column / block_squares, row / block_squares);
      block_m = std::max(block_m, static_cast<float>(terrain.height_at(grid.centre_of(column, row))) + top_m);
    }
  }
  highest_m_ = static_cast<double>(terrain.highest_m()) + tallest_m_;
}

double FaceSight::march_m(double rise) const {
  return std::clamp(tallest_m_ / std::max(rise, 1e-3), least_march_m, longest_march_m);
}

bool FaceSight::is_free_of_block(Vec2d place, double height_m) const {
  const radar::GroundGrid& grid = obstacles_.grid;
  const double side_m = grid.cell_m * static_cast<double>(block_squares);
  const double column = (place.x - grid.west_m) / side_m, row = (grid.north_m - place.y) / side_m;
  if (column < 0.0 || row < 0.0 || column >= static_cast<double>(block_top_m_.columns()) ||
      row >= static_cast<double>(block_top_m_.rows()))
    return false;
  return height_m > static_cast<double>(block_top_m_(static_cast<std::size_t>(column), static_cast<std::size_t>(row)));
}

double FaceSight::clear_above_m(Vec2d place, Vec3d radar) const {
  const double ground_m = terrain_.height_at(place);
  const Way way({place.x, place.y, ground_m}, radar, earth_);
  const double stride_m = std::min(obstacles_.grid.cell_m, terrain_.spacing_m);
  double clear_m = std::numeric_limits<double>::lowest();
  for (double d = march_m(way.rise); d < way.length_m; d += stride_m) {
    const Vec2d under = way.place_at(d);
    // A line from the ground passes above all that lies ahead.
    if (earth_.curvature_per_m() == 0.0 && way.height_at(d) > highest_m_) break;
    if (!terrain_.extent().contains(under)) break;
    const double top_m = terrain_.height_at(under) + static_cast<double>(obstacles_.at(under).solid_top_m);
    // Raising the point by one metre raises its line by what is left of the way.
    const double left = 1.0 - d / way.length_m;
    clear_m = std::max(clear_m, ground_m + (top_m - way.height_at(d)) / left);
  }
  return clear_m;
}

double FaceSight::part_passed(Vec3d point, Vec3d normal, Vec3d radar, double clear_above_m) const {
  if (point.z <= clear_above_m) return 0.0;
  const double square_m = obstacles_.grid.cell_m;
  const double across = std::hypot(normal.x, normal.y);
  Way way(point, radar, earth_);
  double tolerance_m = 0.0;
  if (normal.z < wall_normal_z) {
    way.go_on_beside(Vec2d{normal.x, normal.y} * (before_wall_squares * square_m / across));
  } else {
    tolerance_m = roof_tolerance_m + 0.5 * square_m * across / normal.z;
  }
  const double end_m = std::min(march_m(way.rise), way.length_m), half_fall_m = 0.5 * square_m * std::abs(way.rise);
  double depth = 0.0;
  for (double d = 0.0; d < end_m; d += square_m) {
    const Vec2d under = way.place_at(d);
    const double height_m = way.height_at(d);
    if (earth_.curvature_per_m() == 0.0 && height_m > highest_m_) break;
    if (is_free_of_block(under, height_m - half_fall_m)) continue;
    const radar::Obstacle obstacle = obstacles_.at(under);
    const double above_m = height_m - terrain_.height_at(under);
    // Where it begins, what of a wall is below the ground or within another house is so too.
    if (above_m < static_cast<double>(obstacle.solid_top_m) - tolerance_m || above_m <= 0.0) return 0.0;
    if (obstacle.crown_top_m > 0.0F) {
      const double way_m = (d == 0.0 ? 0.5 : 1.0) * square_m * std::sqrt(1.0 + way.rise * way.rise);
      depth += static_cast<double>(obstacle.crown_extinction_per_m) * way_m *
               terrain::part_within(obstacle, above_m, half_fall_m);
    }
  }
  return std::exp(-depth);
}

}  // namespace sigmascape::render
