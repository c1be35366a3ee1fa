#include "sigmascape/render/skyline.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/sea_horizon.h"
#include "sigmascape/terrain/ground_profile.h"

namespace sigmascape::render {

double Skyline::slope_to(Vec3d point, Vec3d radar, const radar::CurvedEarth& earth) {
  const double distance_m = std::hypot(point.x - radar.x, point.y - radar.y);
  return (point.z - earth.drop_m(distance_m) - radar.z) / distance_m;
}

Skyline::Skyline(const radar::ObstacleMap& obstacles, const terrain::HeightField& terrain,
                 const radar::Vantage& vantage, const radar::Rectangle& area, const radar::CurvedEarth& earth,
                 unsigned threads) {
  const double step_m = std::min(obstacles.grid.cell_m, terrain.spacing_m);
  const auto lowest_ground_m = static_cast<double>(terrain.lowest_m());
  // Half a step apart, so that one passes a place at no more than a quarter.
  for (const SightLines& lines : SightLines::over(area, vantage, 0.5 * step_m)) {
    const SightLines::Steps steps = lines.steps_over(terrain.extent(), step_m);
    Side& side = sides_.emplace_back(Side{lines, steps, Array2D<Slopes>(steps.kept, lines.count())});
    parallel_for(lines.count(), thread_count(threads), [&](std::size_t line, unsigned) {
      const Vec3d radar = lines.radar_of(line);
      const radar::SeaHorizon sea(radar.z, lowest_ground_m, earth.curvature_per_m());
      Slopes steepest;
      std::size_t next = 0;  // of those that are kept
      const auto keep_up_to = [&](std::size_t end) {
        for (; next < std::min(end, steps.kept); ++next) {
          const double distance_m = steps.kept_from_m() + static_cast<double>(next) * step_m;
          side.slopes(next, line) = {std::max(steepest.solid, static_cast<float>(sea.slope_before(distance_m))),
                                     steepest.crowns};
        }
      };
      terrain::GroundProfile profile(terrain, &obstacles);
      profile.walk({.origin = {radar.x, radar.y},
                    .direction = radar::horizontal_direction(lines.azimuth_rad(line)),
                    .near_m = steps.start_m,
                    .step_m = step_m,
                    .count = steps.before + steps.kept},
                   [&](std::size_t step, double distance_m, Vec3d point, const radar::Obstacle& obstacle) {
                     if (step > steps.before) keep_up_to(step - steps.before);
                     const double ground_m = point.z - earth.drop_m(distance_m) - radar.z;
                     const auto slope_to_top = [&](float top_m) {
                       return static_cast<float>((ground_m + static_cast<double>(top_m)) / distance_m);
                     };
                     steepest.solid = std::max(steepest.solid, slope_to_top(obstacle.solid_top_m));
                     if (obstacle.crown_top_m > 0.0F)
                       steepest.crowns = std::max(steepest.crowns, slope_to_top(obstacle.crown_top_m));
                   });
      keep_up_to(steps.kept);
    });
  }
}

Skyline::Slopes Skyline::before(Vec2d place) const {
  for (const Side& side : sides_) {
    if (!side.lines.go_to(place)) continue;
    // The last that is walked before the place.
    const double steps = side.steps.place_of(side.lines.distance_m(place)) - 0.5;
    const double last_step = static_cast<double>(side.slopes.columns() - 1),
                 last_line = static_cast<double>(side.slopes.rows() - 1);
    return side.slopes(static_cast<std::size_t>(std::clamp(steps, 0.0, last_step)),
                       static_cast<std::size_t>(std::clamp(side.lines.line_of(place), 0.0, last_line)));
  }
  return {};
}

}  // namespace sigmascape::render
