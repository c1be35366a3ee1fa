#include "sigmascape/trace/launch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/ground_stretch.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/trace/height_bounds.h"

namespace sigmascape::trace {
namespace {

constexpr std::int32_t tile = tile_side_cells;

/// The horizontal part of a direction, of unit length; nothing straight up.
Vec2d level_part(Vec3d direction) {
  // Asked once a path: std::hypot would take several times as long to no gain, all being of order one.
  const double horizontal = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  return horizontal > 0.0 ? Vec2d{direction.x / horizontal, direction.y / horizontal} : Vec2d{};
}

/// The target and all places so far before and beside it where anything may begin.
LaunchRing ring_about(const Viewpoint& viewpoint, const radar::Rectangle& target, double plane_height_m,
                      const MultibounceReach& reach) {
  const auto towards_from = [&](Vec2d place) {
    return level_part(viewpoint.direction_from({place.x, place.y, plane_height_m}));
  };
  const Vec2d from_centre = towards_from(target.centre());
  LaunchRing ring(dot(from_centre, from_centre) > 0.0 ? from_centre : Vec2d{0.0, 1.0});
  for (const Vec2d corner : radar::corners_of(target)) {
    ring.take_in(corner);
    const Vec2d towards = towards_from(corner);
    const Vec2d before = towards * reach.before_m, beside = Vec2d{towards.y, -towards.x} * reach.beside_m;
    for (const Vec2d place : {corner + beside, corner - beside, corner + before + beside, corner + before - beside}) {
      ring.take_in({std::clamp(place.x, reach.within.west_m, reach.within.east_m),
                    std::clamp(place.y, reach.within.south_m, reach.within.north_m)});
    }
  }
  return ring;
}

/// From the nearest outwards, each half as far as the next.
std::vector<LaunchRing> rings_about(const Viewpoint& viewpoint, const radar::Rectangle& target, double plane_height_m,
                                    MultibounceReach reach) {
  /// Closer by, no rays are spared.
  constexpr double near_m = 32.0;
  std::vector<LaunchRing> rings{ring_about(viewpoint, target, plane_height_m, reach)};
  while (std::max(reach.before_m, reach.beside_m) > near_m) {
    reach.before_m *= 0.5;
    reach.beside_m *= 0.5;
    rings.push_back(ring_about(viewpoint, target, plane_height_m, reach));
  }
  std::ranges::reverse(rings);
  return rings;
}

/// A rectangle of the plane, and where lines of sight come down that pass over it below the top.
///
/// Seen from the radar the plane is stretched outwards, by ever less than in proportion with the distance, and what
/// lies nearer in azimuth to an axis goes farther along it: an edge goes farthest at a corner, or straight before the
/// radar.
radar::Rectangle with_what_is_behind(const Viewpoint& viewpoint, const radar::Rectangle& over, double plane_height_m,
                                     double top_height_m) {
  radar::Rectangle all = over;
  const Vec2d nearest = viewpoint.nearest_point(over);
  const auto take_in = [&](Vec2d place) {
    const Vec3d landing{place.x, place.y, plane_height_m};
    const Vec2d aim =
        place - level_part(viewpoint.direction_from(landing)) * viewpoint.aim_behind_landing_m(landing, top_height_m);
    all = {std::min(all.west_m, aim.x), std::min(all.south_m, aim.y), std::max(all.east_m, aim.x),
           std::max(all.north_m, aim.y)};
  };
  std::ranges::for_each(radar::corners_of(over), take_in);
  for (const double x : {over.west_m, over.east_m}) take_in({x, nearest.y});
  for (const double y : {over.south_m, over.north_m}) take_in({nearest.x, y});
  return all;
}

/// Tells from which ring paths can begin that a square's rays lead to.
class RingsInSight {
 public:
  RingsInSight(const LaunchArea& area, const scene::Scene& scene, Footing footing)
      : area_(area),
        reach_m_(std::numbers::sqrt2 / 2.0 * area.grain_m()),
        region_(region()),
        bounds_(scene, footing, region_, std::max(least_square_m, 2.0 * reach_m_)) {}

  /// The innermost; none when the rays come to no place where paths begin that count.
  [[nodiscard]] std::optional<std::size_t> innermost(Vec2d centre) const {
    const Vec3d to_radar = area_.viewpoint.direction_from({centre.x, centre.y, area_.plane_height_m});
    const double horizontal = std::sqrt(to_radar.x * to_radar.x + to_radar.y * to_radar.y);
    const double slope = to_radar.z / horizontal;
    if (!(slope < steepest)) return 0;
    // Squares reach as far as `reach_m_` about their centres, and a step stands for half its length before and after:
    // both together are less than a square of the bounds, as far as one speaks for. Rays of a square rise nearly alike.
    const double step_m = 0.5 * bounds_.square_m(), slack_m = (0.5 * step_m + 3.0 * reach_m_) * slope + 1.0;
    const Vec2d towards{to_radar.x / horizontal, to_radar.y / horizontal};
    const double until_m = (static_cast<double>(bounds_.highest_m()) + slack_m - area_.plane_height_m) / slope;
    const radar::GroundStretch stretch = radar::stretch_within(region_, centre, towards);
    const double end_m = std::min(stretch.end_m, until_m);
    std::optional<std::size_t> innermost;
    for (double way = stretch.begin_m; way < end_m + step_m; way += step_m) {
      const Vec2d place = centre + towards * way;
      const HeightBounds::Interval* heights = bounds_.around(place);
      if (heights == nullptr) continue;
      const double height = area_.plane_height_m + way * slope;
      if (height - slack_m > static_cast<double>(heights->highest_m) ||
          height + slack_m < static_cast<double>(heights->lowest_m)) {
        continue;
      }
      const double layover_m =
          area_.viewpoint.landing_before_m({place.x, place.y, height + slack_m}, area_.plane_height_m);
      const std::size_t ring = ring_of(place, towards, layover_m, 0.5 * step_m + reach_m_);
      innermost = std::min(innermost.value_or(ring), ring);
      if (innermost == 0) break;
    }
    return innermost;
  }

 private:
  static constexpr double least_square_m = 16.0;
  /// Rays from nearly straight above meet what is below them.
  static constexpr double steepest = 20.0;

  /// In which what stands there lands at the innermost; the outermost where in none, for its rim is part of it.
  [[nodiscard]] std::size_t ring_of(Vec2d place, Vec2d towards, double layover_m, double about_m) const {
    std::size_t ring = 0;
    while (ring + 1 < area_.rings.size() && !area_.rings[ring].meets(place, towards, layover_m, about_m)) {
      ++ring;
    }
    return ring;
  }

  /// Where vertices stand whose echoes can land where paths begin, and a little more.
  [[nodiscard]] radar::Rectangle region() const {
    const radar::Rectangle reached = widened(area_.rings.back().upright(), area_.counting_rim_m());
    const Vec2d nearest = area_.viewpoint.nearest_point(reached);
    const double behind_m =
        area_.viewpoint.point_behind_landing_m({nearest.x, nearest.y, area_.plane_height_m}, area_.top_height_m);
    return radar::widened(reached, behind_m + least_square_m + 2.0 * reach_m_);
  }

  const LaunchArea& area_;
  double reach_m_;
  radar::Rectangle region_;
  HeightBounds bounds_;
};

float share_in(std::size_t ring) {
  return std::ldexp(1.0F, -static_cast<int>(ring));
}

/// The ring, or one within, over which a line of sight passes below the top; none when over none.
std::optional<std::size_t> ring_below_sight(const LaunchArea& area, Vec2d centre) {
  const Vec3d aim{centre.x, centre.y, area.plane_height_m};
  const Vec2d towards = level_part(area.viewpoint.direction_from(aim));
  const double before_m = area.viewpoint.landing_before_aim_m(aim, area.top_height_m);
  for (std::size_t ring = 0; ring < area.rings.size(); ++ring) {
    if (area.rings[ring].meets(centre, towards, before_m, area.rim_m())) return ring;
  }
  return std::nullopt;
}

}  // namespace

void spare_rays(LaunchArea& area, const scene::Scene& scene, Footing footing) {
  const RingsInSight sight(area, scene, footing);
  std::vector<LaunchCell> kept;
  // Cells of a square follow one another.
  const auto side = static_cast<std::size_t>(area.grain), square = side * side;
  for (std::size_t first = 0; first < area.cells.size(); first += square) {
    const auto cells = std::span(area.cells).subspan(first, square);
    const Vec2d centre =
        Vec2d{static_cast<double>(cells.front().i), static_cast<double>(cells.front().j)} * area.cell_m +
        Vec2d{0.5, 0.5} * area.grain_m();
    const std::optional<std::size_t> ring = sight.innermost(centre);
    const float share = ring ? share_in(*ring) : 0.0F;
    area.shares.set(cells.front().i / area.grain, cells.front().j / area.grain, share);
    if (!ring) continue;
    for (LaunchCell cell : cells) {
      cell.share = share;
      kept.push_back(cell);
    }
  }
  area.cells = std::move(kept);
}

bool HeardSector::is_heard_from(Vec3d point, const MultibounceReach& reach, double spare_m) const {
  const Vec3d away = point - radar;
  const double range_m = length(away);
  if (range_m < near_range_m - reach.before_m - spare_m || range_m > far_range_m + spare_m) return false;
  const double over_ground_m = std::sqrt(away.x * away.x + away.y * away.y);
  const double beside_rad = std::abs(turned_by_least(std::atan2(away.x, away.y) - middle_azimuth_rad)) - half_width_rad;
  return beside_rad * over_ground_m <= reach.beside_m + spare_m;
}

void narrow_to(LaunchArea& area, const HeardSector& heard) {
  area.heard = heard;
  const double spare_m = 2.0 * area.cell_m;
  const double nearest_m = heard.near_range_m - area.reach.before_m - spare_m;
  const double farthest_m = heard.far_range_m + spare_m;
  std::erase_if(area.cells, [&](const LaunchCell& cell) {
    const Vec3d aim{(cell.i + 0.5) * area.cell_m, (cell.j + 0.5) * area.cell_m, area.plane_height_m};
    // Along a ray the azimuth stays the same; what it meets lies between its aim and where it starts.
    const Vec3d away = aim - heard.radar;
    const double begun = (heard.radar.z - area.top_height_m) / (heard.radar.z - area.plane_height_m);
    const double aim_range_m = length(away), first_range_m = begun * aim_range_m;
    if (aim_range_m < nearest_m || first_range_m > farthest_m) return true;
    // The nearest that is heard of it lies least beside the sector.
    const double heard_m = std::min(std::max(first_range_m, heard.near_range_m - area.reach.before_m), aim_range_m);
    return !heard.is_heard_from(heard.radar + away * (heard_m / aim_range_m), area.reach, spare_m);
  });
}

bool LaunchArea::counts_from(Vec3d first_vertex) const {
  if (heard && !heard->is_heard_from(first_vertex, reach, cell_m)) return false;
  const Vec2d foot{first_vertex.x, first_vertex.y};
  if (rings.back().contains(foot, counting_rim_m())) return true;
  // On ground of unknown height it lands somewhere between its foot and where it would on the lowest.
  return rings.back().meets(foot, level_part(viewpoint.direction_from(first_vertex)),
                            viewpoint.landing_before_m(first_vertex, plane_height_m), counting_rim_m());
}

bool LaunchArea::counts_always(std::span<const LaunchCell> aimed_at) const {
  if (heard || aimed_at.empty()) return false;
  const auto [west, east] = std::ranges::minmax(aimed_at, {}, &LaunchCell::i);
  const auto [south, north] = std::ranges::minmax(aimed_at, {}, &LaunchCell::j);
  const radar::Rectangle aims{west.i * cell_m, south.j * cell_m, (east.i + 1) * cell_m, (north.j + 1) * cell_m};
  // Rays that begin at a corner and end at one enclose all others, and what they enclose is convex as a ring is. Single
  // precision moves vertices by less than this.
  constexpr double rounding_m = 0.1;
  return std::ranges::all_of(radar::corners_of(aims), [&](Vec2d corner) {
    const Vec3d aim{corner.x, corner.y, plane_height_m}, to_radar = viewpoint.direction_from(aim);
    const Vec3d start = aim + to_radar * ((top_height_m - plane_height_m) / to_radar.z);
    return rings.back().contains(corner, counting_rim_m() - rounding_m) &&
           rings.back().contains({start.x, start.y}, counting_rim_m() - rounding_m);
  });
}

float LaunchArea::share_at(Vec2d point) const {
  return shares.at(static_cast<std::int32_t>(std::floor(point.x / grain_m())),
                   static_cast<std::int32_t>(std::floor(point.y / grain_m())));
}

double LaunchArea::whole_cells() const {
  double sum = 0.0;
  for (const LaunchCell& cell : cells) sum += static_cast<double>(cell.share);
  return sum;
}

radar::Rectangle aimed_extent(const Viewpoint& viewpoint, const radar::Rectangle& target, double plane_height_m,
                              double top_height_m, const MultibounceReach& reach) {
  return with_what_is_behind(viewpoint, ring_about(viewpoint, target, plane_height_m, reach).upright(), plane_height_m,
                             top_height_m);
}

LaunchArea launch_area(const Viewpoint& viewpoint, const radar::Rectangle& target, double cell_m, double plane_height_m,
                       double top_height_m, const MultibounceReach& reach, int grain) {
  LaunchArea area{.cell_m = cell_m,
                  .plane_height_m = plane_height_m,
                  .top_height_m = top_height_m,
                  .grain = grain,
                  .cells = {},
                  .viewpoint = viewpoint,
                  .target = target,
                  .reach = reach,
                  .rings = rings_about(viewpoint, target, plane_height_m, reach),
                  .shares = {}};
  const radar::Rectangle aimed =
      radar::widened(with_what_is_behind(viewpoint, radar::widened(area.rings.back().upright(), area.rim_m()),
                                         plane_height_m, top_height_m),
                     cell_m * grain);
  // Tiles of the lattice, and squares of a tile.
  const double tile_m = cell_m * tile;
  const auto tile_at = [tile_m](double metres) { return static_cast<std::int32_t>(std::floor(metres / tile_m)); };
  const std::int32_t west = tile_at(aimed.west_m), east = tile_at(aimed.east_m);
  const std::int32_t south = tile_at(aimed.south_m), north = tile_at(aimed.north_m);
  const std::int32_t squares = tile / grain;
  area.shares = LaunchShares(west * squares, south * squares, static_cast<std::size_t>((east - west + 1) * squares),
                             static_cast<std::size_t>((north - south + 1) * squares));
  for (std::int32_t tj = south; tj <= north; ++tj) {
    for (std::int32_t ti = west; ti <= east; ++ti) {
      for (std::int32_t j = tj * squares; j < (tj + 1) * squares; ++j) {
        for (std::int32_t i = ti * squares; i < (ti + 1) * squares; ++i) {
          // Cells of a square get the same answer.
          const auto ring = ring_below_sight(area, Vec2d{i + 0.5, j + 0.5} * area.grain_m());
          if (!ring) continue;
          area.shares.set(i, j, share_in(*ring));
          for (std::int32_t y = j * grain; y < (j + 1) * grain; ++y) {
            for (std::int32_t x = i * grain; x < (i + 1) * grain; ++x) area.cells.push_back({x, y, share_in(*ring)});
          }
        }
      }
    }
  }
  return area;
}

}  // namespace sigmascape::trace
