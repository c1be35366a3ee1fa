#include "sigmascape/render/ground_scatterers.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/render/line_of_sight.h"

namespace sigmascape::render {
namespace {

constexpr double most_cells = 0x1p27;

bool hidden_by_any(std::span<const radar::Target> targets, double time_s, Vec3d radar, Vec3d point) {
  return std::ranges::any_of(targets,
                             [&](const radar::Target& target) { return radar::hides(target, time_s, radar, point); });
}

double tallest_of(const radar::ObstacleMap& map) {
  double tallest_m = 0.0;
  for (const radar::Obstacle& obstacle : map.obstacles.values())
    tallest_m = std::max(tallest_m, static_cast<double>(obstacle.top_m()));
  return tallest_m;
}

/// The part of the bare ground at a point that obstacles let be seen, as though all stood at the point's own height.
double seen_ground(const radar::ObstacleMap& map, double tallest_m, Vec2d point, const radar::Aspect& aspect) {
  if (map.at(point).solid_top_m > 0.0F) return 0.0;
  const Vec2d towards = radar::horizontal_direction(aspect.azimuth_rad);
  const double rise = std::tan(aspect.elevation_rad), step_m = map.grid.cell_m;
  const double way_m = step_m / std::cos(aspect.elevation_rad);
  const radar::Rectangle extent = map.grid.extent();
  double depth = 0.0;
  for (double distance_m = step_m; distance_m * rise < tallest_m; distance_m += step_m) {
    const Vec2d before = point + towards * distance_m;
    if (!extent.contains(before)) break;
    const radar::Obstacle obstacle = map.at(before);
    const double height_m = distance_m * rise;
    if (height_m < static_cast<double>(obstacle.solid_top_m)) return 0.0;
    if (height_m >= static_cast<double>(obstacle.crown_base_m) && height_m < static_cast<double>(obstacle.crown_top_m))
      depth += static_cast<double>(obstacle.crown_extinction_per_m) * way_m;
  }
  return std::exp(-depth);
}

}  // namespace

Reflectivity reflectivity_of(const atlas::Atlas& atlas, double frequency_hz, double cell_m) {
  atlas.check_frequency(frequency_hz);
  const double level = atlas.level_for(cell_m);
  const atlas::GroundLayers* ground = atlas.ground_layers();
  if (ground == nullptr) {
    return [&atlas, frequency_hz, level](Vec2d point, const radar::Aspect& aspect) {
      return atlas.sigma0_at(point, aspect, frequency_hz, level);
    };
  }
  const double tallest_m = tallest_of(ground->obstacles);
  return [&atlas, ground, frequency_hz, level, tallest_m](Vec2d point, const radar::Aspect& aspect) {
    const double seen = seen_ground(ground->obstacles, tallest_m, point, aspect);
    radar::Channels sigma0 = atlas.sigma0_at(point, aspect, frequency_hz, level);
    if (seen > 0.0) sigma0 += ground->sigma0.sigma0_at(point, aspect, frequency_hz, level) * static_cast<float>(seen);
    return sigma0;
  };
}

std::vector<radar::Scatterer> ground_scatterers(const terrain::HeightField& terrain, const Reflectivity& sigma0,
                                                const radar::ScattererLattice& lattice, const ScattererRequest& request,
                                                std::span<const radar::Target> targets) {
  const double side_m = lattice.cell_m(request.level);
  const radar::Rectangle& area = request.area;
  if (!(area.width_m() > 0.0 && area.height_m() > 0.0) ||
      area.width_m() / side_m * (area.height_m() / side_m) > most_cells) {
    throw Error("ground scatterers",
                fmt::format("an area of {:.0f} m by {:.0f} m in cells of {} m is asked for", area.width_m(),
                            area.height_m(), side_m),
                fmt::format("give an area of at most {:.0f} cells", most_cells));
  }
  // Cells belong to the area whole or not at all, by their middle: neighbouring areas share none.
  const auto first_of = [side_m](double edge_m) { return static_cast<std::int32_t>(std::ceil(edge_m / side_m - 0.5)); };
  const std::int32_t west = first_of(area.west_m), east = first_of(area.east_m);
  const std::int32_t south = first_of(area.south_m), north = first_of(area.north_m);
  const double highest_m = terrain.highest_m();
  const auto cell_area = static_cast<float>(side_m * side_m);

  std::vector<std::vector<radar::Scatterer>> rows(static_cast<std::size_t>(std::max(0, north - south)));
  parallel_for(rows.size(), request.threads, [&](std::size_t index, unsigned) {
    const std::int32_t row = south + static_cast<std::int32_t>(index);
    for (std::int32_t column = west; column < east; ++column) {
      const Vec2d place = lattice.position_in({column, row}, request.level);
      if (!terrain.extent().contains(place)) continue;
      const Vec3d point{place.x, place.y, terrain.height_at(place)};
      if (!line_of_sight(terrain, highest_m, request.radar_position, point)) continue;
      if (hidden_by_any(targets, request.time_s, request.radar_position, point)) continue;
      const Vec3d away = request.radar_position - point;
      const radar::Aspect aspect{std::atan2(away.x, away.y), std::atan2(away.z, std::hypot(away.x, away.y))};
      const radar::Channels mean = sigma0(place, aspect) * cell_area;
      rows[index].push_back({point, polarized(lattice.drawn({column, row}, request.level), mean)});
    }
  });
  std::vector<radar::Scatterer> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace sigmascape::render
