#include "sigmascape/render/sight_map.h"

#include "sigmascape/base/parallel.h"

namespace sigmascape::render {

SightMap::SightMap(const ReflectingGround& ground, const radar::Vantage& vantage,
                   const radar::Rectangle& terrain_extent, const radar::Rectangle& area, double step_m,
                   unsigned threads) {
  for (const SightLines& lines : SightLines::over(area, vantage, step_m)) {
    const SightLines::Steps steps = lines.steps_over(terrain_extent, step_m);
    Side& side = sides_.emplace_back(Side{lines, steps, SightGrid(steps.before, steps.kept, lines.count())});
    // At the terrain's edges the step that is nearest to a place may lie beyond them.
    const double beyond_m = step_m;
    parallel_for(lines.count(), threads, [&](std::size_t line, unsigned) {
      ground.seen_from(lines.radar_of(line))
          .walk(
              lines.azimuth_rad(line), steps.start_m, steps.end_m, step_m,
              [&](std::size_t step, double, Vec3d, const terrain::Sight& sight) { side.sights.put(step, line, sight); },
              beyond_m);
    });
  }
}

terrain::Sight SightMap::at(Vec2d point) const {
  for (const Side& side : sides_) {
    if (!side.lines.go_to(point)) continue;
    return side.sights.at(side.steps.place_of(side.lines.distance_m(point)), side.lines.line_of(point));
  }
  return {};
}

}  // namespace sigmascape::render
