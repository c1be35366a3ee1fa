#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/render/ground_samples.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// The long way to visible ground: every line of sight walked from end to end in fine steps, in double precision.
///
/// Returns for every sample, [distance][azimuth], by how many metres it stands above (or, negative, below) the lowest
/// line of sight that clears everything nearer; −1e9 where there is no terrain. Done for every azimuth that is a
/// multiple of `every`.
template <typename HeightAt>
std::vector<double> walked_lines_of_sight(const terrain::HeightField& terrain, const HeightAt& height_at,
                                          const Vec3d& radar, const GroundSector& sector,
                                          const radar::CurvedEarth& earth, std::size_t every, double steps_per_cell) {
  std::vector<double> clearance_m(sector.azimuths * sector.distances, -1e9);
  const auto fine = static_cast<std::size_t>(std::ceil(sector.distance_step_m * steps_per_cell / terrain.spacing_m));
  const double step_m = sector.distance_step_m / static_cast<double>(fine);
  const auto before = static_cast<std::size_t>(sector.first_distance_m / step_m - 0.5);
  const double first_m = sector.first_distance_m - static_cast<double>(before) * step_m;
  std::vector<double> slope(before + fine * sector.distances);
  for (std::size_t azimuth = 0; azimuth < sector.azimuths; azimuth += every) {
    const Vec2d direction = radar::horizontal_direction(sector.azimuth_rad(azimuth));
    for (std::size_t i = 0; i < slope.size(); ++i) {
      const double distance_m = first_m + static_cast<double>(i) * step_m;
      const Vec2d point = Vec2d{radar.x, radar.y} + direction * distance_m;
      slope[i] = terrain.extent().contains(point) ? (height_at(point) - earth.drop_m(distance_m) - radar.z) / distance_m
                                                  : -1e30;
    }
    for (std::size_t k = 0; k < sector.distances; ++k) {
      const std::size_t here = before + k * fine;
      if (slope[here] < -1e29) continue;
      const double steepest = *std::max_element(slope.begin(), slope.begin() + static_cast<std::ptrdiff_t>(here));
      clearance_m[k * sector.azimuths + azimuth] = (slope[here] - steepest) * sector.distance_m(k);
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

/// Compares samples with the long way. A silhouette is where ground comes within `silhouette_m` of the lowest line of
/// sight, or where the answer changes within two samples.
inline Disagreement disagreement(const std::vector<double>& clearance_m, const GroundSector& sector,
                                 const GroundSamples& samples, std::size_t every, double silhouette_m) {
  Disagreement result;
  for (std::size_t azimuth = 0; azimuth < sector.azimuths; azimuth += every) {
    const auto clearance_at = [&](std::size_t k) { return clearance_m[k * sector.azimuths + azimuth]; };
    for (std::size_t k = 0; k < sector.distances; ++k) {
      const bool seen = clearance_at(k) >= 0.0;
      ++result.compared;
      result.hidden += seen ? 0 : 1;
      if ((samples.visible()[samples.index(azimuth, k)] == 1) == seen) continue;
      ++result.different;
      bool silhouette = std::abs(clearance_at(k)) < silhouette_m;
      for (std::size_t j = k > 2 ? k - 2 : 0; j <= std::min(k + 2, sector.distances - 1); ++j) {
        silhouette = silhouette || (clearance_at(j) >= 0.0) != seen;
      }
      result.away_from_silhouettes += silhouette ? 0 : 1;
    }
  }
  return result;
}

}  // namespace sigmascape::render
