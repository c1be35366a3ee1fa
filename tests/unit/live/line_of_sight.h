#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sigmascape/live/horizon_map.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::live {

inline double azimuth_of(const HorizonGrid& grid, std::size_t azimuth) {
  return grid.first_azimuth_rad + static_cast<double>(azimuth) * grid.azimuth_step_rad;
}
inline double distance_of(const HorizonGrid& grid, std::size_t distance) {
  return grid.near_m + static_cast<double>(distance) * grid.step_m;
}

/// Whether ground of a height at a node is seen: slopes are good to what single precision leaves.
inline bool is_seen(const HorizonMap& horizon, Vec3d radar, double height_m, std::size_t azimuth, std::size_t k) {
  const HorizonGrid& grid = horizon.grid();
  const double distance_m = distance_of(grid, k);
  const double slope = (height_m - radar.z) / distance_m - grid.drop_per_square_m * distance_m;
  return slope >= static_cast<double>(horizon.slopes(azimuth)[k]) - 5e-8;
}

/// The long way to visible ground: every line of sight walked from end to end in fine steps, in double precision.
///
/// Returns for every node, [azimuth][distance], by how many metres it stands above (or, negative, below) the lowest
/// line of sight that clears everything nearer; −1e9 where there is no terrain. Done for every azimuth that is a
/// multiple of `every`.
template <typename HeightAt>
std::vector<double> walked_lines_of_sight(const terrain::HeightField& terrain, const HeightAt& height_at,
                                          const Vec3d& radar, const HorizonGrid& grid, std::size_t every,
                                          double steps_per_cell) {
  std::vector<double> clearance_m(grid.azimuths * grid.distances, -1e9);
  const auto fine = static_cast<std::size_t>(std::ceil(grid.step_m * steps_per_cell / terrain.spacing_m));
  const double step_m = grid.step_m / static_cast<double>(fine);
  const auto before = static_cast<std::size_t>(grid.near_m / step_m - 0.5);
  const double first_m = grid.near_m - static_cast<double>(before) * step_m;
  std::vector<double> slope(before + fine * grid.distances);
  for (std::size_t azimuth = 0; azimuth < grid.azimuths; azimuth += every) {
    const Vec2d direction = radar::horizontal_direction(azimuth_of(grid, azimuth));
    for (std::size_t i = 0; i < slope.size(); ++i) {
      const double distance_m = first_m + static_cast<double>(i) * step_m;
      const Vec2d point = Vec2d{radar.x, radar.y} + direction * distance_m;
      slope[i] = terrain.extent().contains(point)
                     ? (height_at(point) - radar.z) / distance_m - grid.drop_per_square_m * distance_m
                     : -1e30;
    }
    double steepest = -1e30;
    std::size_t next = 0;
    for (std::size_t k = 0; k < grid.distances; ++k) {
      const std::size_t here = before + k * fine;
      for (; next < here; ++next) steepest = std::max(steepest, slope[next]);
      if (slope[here] < -1e29) continue;
      clearance_m[azimuth * grid.distances + k] = (slope[here] - steepest) * distance_of(grid, k);
    }
  }
  return clearance_m;
}

/// The surface of two triangles a cell, parted from north-east to south-west, that rasterization draws.
inline double height_of_triangles(const terrain::HeightField& terrain, Vec2d point) {
  const double across = (point.x - terrain.west_m) / terrain.spacing_m;
  const double down = (terrain.north_m - point.y) / terrain.spacing_m;
  const auto column = std::min(static_cast<std::size_t>(across), terrain.height_m.columns() - 2);
  const auto row = std::min(static_cast<std::size_t>(down), terrain.height_m.rows() - 2);
  const double u = across - static_cast<double>(column), v = down - static_cast<double>(row);
  const auto height = [&](std::size_t i, std::size_t j) {
    return static_cast<double>(terrain.height_m(column + i, row + j));
  };
  if (u + v < 1.0) return height(0, 0) + u * (height(1, 0) - height(0, 0)) + v * (height(0, 1) - height(0, 0));
  return height(1, 1) + (1.0 - u) * (height(0, 1) - height(1, 1)) + (1.0 - v) * (height(1, 0) - height(1, 1));
}

/// How two answers differ.
struct Disagreement {
  std::size_t compared = 0, different = 0, away_from_silhouettes = 0, hidden = 0;

  [[nodiscard]] double share() const { return static_cast<double>(different) / static_cast<double>(compared); }
};

/// Compares a horizon with the long way, at every so many nodes. A silhouette is where ground comes within
/// `silhouette_m` of the lowest line of sight, or where the answer changes within `near` nodes.
inline Disagreement disagreement(const std::vector<double>& clearance_m, const terrain::HeightField& terrain,
                                 const HorizonMap& horizon, const Vec3d& radar, std::size_t every,
                                 std::size_t every_distance, double silhouette_m, std::size_t near) {
  Disagreement result;
  const HorizonGrid& grid = horizon.grid();
  for (std::size_t azimuth = 0; azimuth < grid.azimuths; azimuth += every) {
    const Vec2d outwards = radar::horizontal_direction(azimuth_of(grid, azimuth));
    const auto clearance_at = [&](std::size_t k) { return clearance_m[azimuth * grid.distances + k]; };
    for (std::size_t k = 0; k < grid.distances; k += every_distance) {
      if (clearance_at(k) < -1e8) continue;
      const bool seen = clearance_at(k) >= 0.0;
      ++result.compared;
      result.hidden += seen ? 0 : 1;
      const Vec2d point = Vec2d{radar.x, radar.y} + outwards * distance_of(grid, k);
      if (is_seen(horizon, radar, terrain.height_at(point), azimuth, k) == seen) continue;
      ++result.different;
      bool silhouette = std::abs(clearance_at(k)) < silhouette_m;
      for (std::size_t j = k > near ? k - near : 0; j <= std::min(k + near, grid.distances - 1); ++j) {
        silhouette = silhouette || (clearance_at(j) >= 0.0) != seen;
      }
      result.away_from_silhouettes += silhouette ? 0 : 1;
    }
  }
  return result;
}

}  // namespace sigmascape::live
