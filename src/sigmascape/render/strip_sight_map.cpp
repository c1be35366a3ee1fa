#include "sigmascape/render/strip_sight_map.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/rectangle_distances.h"

namespace sigmascape::render {

StripSightMap::StripSightMap(const ReflectingGround& ground, const radar::Vantage& vantage,
                             const radar::Rectangle& terrain_extent, const radar::Rectangle& area, double step_m,
                             unsigned threads)
    : step_m_(step_m),
      sides_{side_of(ground, vantage.beams()->front(), terrain_extent, area, threads),
             side_of(ground, vantage.beams()->back(), terrain_extent, area, threads)} {}

StripSightMap::Side StripSightMap::side_of(const ReflectingGround& ground, const radar::PassingBeam& beam,
                                           const radar::Rectangle& terrain_extent, const radar::Rectangle& area,
                                           unsigned threads) const {
  Side side;
  side.beam = beam;
  const auto distance_of = [&](Vec2d point) { return beam.distance_m(point); };
  const std::array<double, 2> distances_m = radar::span_over(area, distance_of);
  if (distances_m[1] < 0.0) return side;
  const std::array<double, 2> lines_m = radar::span_over(area, [&](Vec2d point) { return beam.across_m(point); });
  const double far_m = distances_m[1] + step_m_;
  // Terrain nearer than the area may hide it; only what lies in the area is kept.
  const double start_m = std::max(0.0, radar::span_over(terrain_extent, distance_of)[0]);
  const auto before = static_cast<std::size_t>(std::max(0.0, (distances_m[0] - start_m) / step_m_ - 1.0));
  side.first_across_m = lines_m[0];
  side.near_m = start_m + static_cast<double>(before) * step_m_;
  side.sights = SightGrid(before, static_cast<std::size_t>(std::max(0.0, (far_m - side.near_m) / step_m_)) + 2,
                          static_cast<std::size_t>((lines_m[1] - lines_m[0]) / step_m_) + 1);
  const double azimuth_rad = std::atan2(beam.outwards.x, beam.outwards.y);
  parallel_for(side.sights.lines(), threads, [&](std::size_t row, unsigned) {
    const double across_m = side.first_across_m + (static_cast<double>(row) + 0.5) * step_m_;
    ground.seen_from(beam.platform_at(beam.time_s(across_m)))
        .walk(azimuth_rad, start_m, far_m + step_m_, step_m_,
              [&](std::size_t step, double, Vec3d, const terrain::Sight& sight) { side.sights.put(step, row, sight); });
  });
  return side;
}

terrain::Sight StripSightMap::at(Vec2d point) const {
  const Side& side = sides_[0].beam.looks_to(point) ? sides_[0] : sides_[1];
  if (side.sights.empty()) return {};
  return side.sights.at((side.beam.distance_m(point) - side.near_m) / step_m_,
                        (side.beam.across_m(point) - side.first_across_m) / step_m_);
}

}  // namespace sigmascape::render
