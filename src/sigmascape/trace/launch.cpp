#include "sigmascape/trace/launch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/trace/launch_tiles.h"
#include "sigmascape/trace/level_part.h"
#include "sigmascape/trace/rings_in_sight.h"

namespace sigmascape::trace {
namespace {

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

void spare_rays(LaunchArea& area, const RingsInSight& sight) {
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

void spare_rays(LaunchArea& area, const scene::Scene& scene, Footing footing) {
  spare_rays(area, RingsInSight(area, scene, footing));
}

bool HeardSector::is_heard_from(Vec3d point, const MultibounceReach& reach, double spare_m) const {
  const Vec3d away = point - radar;
  const double range_m = length(away);
  if (range_m < near_range_m - reach.before_m - spare_m || range_m > far_range_m + spare_m) return false;
  const double over_ground_m = std::sqrt(away.x * away.x + away.y * away.y);
  const double beside_rad = std::abs(turned_by_least(azimuth_of(away) - middle_azimuth_rad)) - half_width_rad;
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

double aimed_area_m2(const LaunchArea& outline) {
  constexpr int steps = 1024;
  const LaunchRing& ring = outline.rings.back();
  const Vec2d middle = outline.target.centre();
  struct Side {
    Vec2d edge, aim;
  };
  const auto side_at = [&](int step) {
    const double angle = 2.0 * pi * step / steps;
    const Vec2d outwards{std::cos(angle), std::sin(angle)};
    const Vec2d edge = middle + outwards * ring.stretch(middle, outwards, 0.0).end_m;
    const Vec3d landing{edge.x, edge.y, outline.plane_height_m};
    return Side{edge, edge - level_part(outline.viewpoint.direction_from(landing)) *
                                 outline.viewpoint.aim_behind_landing_m(landing, outline.highest_m)};
  };
  const auto cross = [](Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; };
  double twice_m2 = 0.0;
  Side last = side_at(0);
  for (int step = 1; step <= steps; ++step) {
    const Side side = side_at(step % steps);
    twice_m2 += cross(last.edge - middle, side.edge - middle);
    // What looks away from the radar sweeps over what lies behind; what faces it sweeps over the ring itself,
    // clockwise.
    twice_m2 += std::max(0.0, cross(side.aim - last.edge, side.edge - last.aim));
    last = side;
  }
  return 0.5 * twice_m2;
}

LaunchArea launch_outline(const Viewpoint& viewpoint, const radar::Rectangle& target, double cell_m,
                          double plane_height_m, double top_height_m, const MultibounceReach& reach, int grain) {
  return {.cell_m = cell_m,
          .plane_height_m = plane_height_m,
          .top_height_m = top_height_m,
          .highest_m = top_height_m,
          .grain = grain,
          .cells = {},
          .viewpoint = viewpoint,
          .target = target,
          .reach = reach,
          .rings = rings_about(viewpoint, target, plane_height_m, reach),
          .shares = {}};
}

void list_cells(LaunchArea& outline) {
  const std::vector<LaunchTile> tiles = tiles_aimed_at(outline);
  const std::int32_t grain = outline.grain, squares = tile_side_cells / grain;
  outline.shares = LaunchShares(tiles, squares);
  outline.cells.clear();
  for (const auto& [ti, tj] : tiles) {
    for (std::int32_t j = tj * squares; j < (tj + 1) * squares; ++j) {
      for (std::int32_t i = ti * squares; i < (ti + 1) * squares; ++i) {
        // Cells of a square get the same answer.
        const auto ring = ring_below_sight(outline, Vec2d{i + 0.5, j + 0.5} * outline.grain_m());
        if (!ring) continue;
        outline.shares.set(i, j, share_in(*ring));
        for (std::int32_t y = j * grain; y < (j + 1) * grain; ++y) {
          for (std::int32_t x = i * grain; x < (i + 1) * grain; ++x) outline.cells.push_back({x, y, share_in(*ring)});
        }
      }
    }
  }
}

LaunchArea launch_area(const Viewpoint& viewpoint, const radar::Rectangle& target, double cell_m, double plane_height_m,
                       double top_height_m, const MultibounceReach& reach, int grain) {
  LaunchArea area = launch_outline(viewpoint, target, cell_m, plane_height_m, top_height_m, reach, grain);
  list_cells(area);
  return area;
}

}  // namespace sigmascape::trace
