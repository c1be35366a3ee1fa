#include "sigmascape/live/target_sight.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/live/horizon_steps.h"
#include "sigmascape/terrain/roof_doubt.h"

namespace sigmascape::live {
namespace {

double part_seen_at(const TargetSight& sight, const TargetSight::Level& level,
                    const receiver::TargetFrame::Seen& target) {
  // Straight below the radar nothing stands in between.
  if (!(target.distance_m > 0.0)) return 1.0;
  const HorizonGrid& grid = level.horizon->grid();
  const double radar_height_m = sight.radar.z;
  const auto slope_of = [&](double height_m) {
    return (height_m - radar_height_m) / target.distance_m - grid.drop_per_square_m * target.distance_m;
  };
  const auto last_left = static_cast<double>(grid.azimuths - 2);
  const double across = std::clamp(target.beam * static_cast<double>(sight.azimuths_a_beam), 0.0, last_left + 1.0);
  const double left = std::min(std::floor(across), last_left), part = across - left;
  // Ground under the target itself hides it no more than ground hides itself.
  const std::size_t node = grid.node_before(target.distance_m);
  const auto azimuth = static_cast<std::size_t>(left);
  const auto between = [part](double on_left, double on_right) { return (1.0 - part) * on_left + part * on_right; };
  const HorizonMap& horizon = *level.horizon;
  const auto occluders_at = [&](std::size_t at) -> const Occluders& {
    return level.occluders[sight.sectors.of_edge(at / sight.azimuths_a_beam)];
  };
  const double ridges = between(static_cast<double>(horizon.slopes(azimuth)[node]),
                                static_cast<double>(horizon.slopes(azimuth + 1)[node])) -
                        slope_doubt;
  const Vec2d place{target.position.x, target.position.y};
  const auto lies_behind_crest = [&](double slope) {
    return horizon.rises_between(across, target.distance_m, slope, sight.radar, occluders_at(azimuth));
  };
  double height_m = target.position.z, slope = slope_of(height_m);
  if (slope < ridges || lies_behind_crest(slope)) {
    // Hidden where it was put; but on the ground of this frame it may be seen.
    const Occluders& occluders = occluders_at(azimuth);
    const double on_ground_m = terrain::height_at(occluders.terrain, place) - static_cast<double>(occluders.lowered_m);
    if (!(on_ground_m > height_m)) return 0.0;
    height_m = on_ground_m;
    slope = slope_of(height_m);
    if (slope < ridges || lies_behind_crest(slope)) return 0.0;
  }
  if (horizon.solid_slopes(azimuth) == nullptr) return 1.0;
  const bool is_on_ground = slope <= ridges + 2.0 * slope_doubt;
  const auto is_hidden = [&](std::size_t at, double roof_doubt_m) {
    return horizon.is_behind_solid(at, target.distance_m, slope + slope_doubt, roof_doubt_m, sight.radar,
                                   occluders_at(at));
  };
  const auto roof_doubt_m = [&](std::size_t at) {
    const Occluders& occluders = occluders_at(at);
    const double above_m = height_m - terrain::height_at(occluders.terrain, place);
    const Vec2d rise = terrain::slope_at(occluders.terrain, place);
    const auto top_m = [&](Vec2d there) {
      return static_cast<double>(occluders.obstacles->at(there).unpacked().solid_top_m);
    };
    return terrain::doubt_about_roof_m(place, above_m, {-rise.x, -rise.y, 1.0}, occluders.obstacles->grid().cell_m,
                                       top_m, static_cast<double>(occluders.lowered_m));
  };
  const auto through = [&](std::size_t at) {
    if (is_hidden(at, 0.0)) {
      const double doubt_m = roof_doubt_m(at);
      if (!(doubt_m > 0.0) || is_hidden(at, doubt_m)) return 0.0;
    }
    const Occluders& occluders = occluders_at(at);
    const double to_node = is_on_ground ? static_cast<double>(horizon.through(at)[node])
                                        : horizon.through_from(at, node, slope, sight.radar, occluders);
    return to_node * horizon.through_beyond(at, node, target.distance_m, slope + slope_doubt, sight.radar, occluders);
  };
  return between(through(azimuth), through(azimuth + 1));
}

}  // namespace

float TargetSight::part_seen(const receiver::TargetFrame::Seen& target) const {
  double seen = 0.0;
  for (const Level& level : levels) {
    if (level.share > 0.0F && level.horizon != nullptr) {
      seen += static_cast<double>(level.share) * part_seen_at(*this, level, target);
    }
  }
  return static_cast<float>(seen);
}

}  // namespace sigmascape::live
