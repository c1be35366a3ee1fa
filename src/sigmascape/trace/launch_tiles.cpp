#include "sigmascape/trace/launch_tiles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>

#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/trace/level_part.h"

namespace sigmascape::trace {
namespace {

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
    all = radar::with_point(all, aim);
  };
  std::ranges::for_each(radar::corners_of(over), take_in);
  for (const double x : {over.west_m, over.east_m}) take_in({x, nearest.y});
  for (const double y : {over.south_m, over.north_m}) take_in({nearest.x, y});
  return all;
}

/// How far beside the rings what counts may begin, and grains are listed.
double widest_rim_m(const LaunchArea& outline) {
  return std::max(outline.rim_m(), outline.counting_rim_m());
}

/// Looks into ever smaller squares: strips that run askew over the lattice fill little of the rectangle about them.
class TileSearch {
 public:
  explicit TileSearch(const LaunchArea& outline)
      : outline_(outline), tile_m_(outline.cell_m * tile_side_cells), rim_m_(widest_rim_m(outline)) {
    const radar::Rectangle aimed =
        radar::widened(with_what_is_behind(outline.viewpoint, radar::widened(outline.rings.back().upright(), rim_m_),
                                           outline.plane_height_m, outline.highest_m),
                       outline.grain_m());
    const auto tile_at = [this](double metres) { return static_cast<std::int32_t>(std::floor(metres / tile_m_)); };
    first_ = {tile_at(aimed.west_m), tile_at(aimed.south_m)};
    last_ = {tile_at(aimed.east_m), tile_at(aimed.north_m)};
  }

  std::vector<LaunchTile> found() && {
    std::int64_t side = 1;
    while (first_.i + side <= last_.i || first_.j + side <= last_.j) side *= 2;
    look_into(first_.i, first_.j, side);
    std::ranges::sort(found_, {}, [](const LaunchTile& tile) { return std::tuple(tile.j, tile.i); });
    return std::move(found_);
  }

 private:
  void look_into(std::int64_t i, std::int64_t j, std::int64_t side) {
    if (i > last_.i || j > last_.j || !leads_to_rings(i, j, side)) return;
    if (side == 1) return found_.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    const std::int64_t half = side / 2;
    for (const std::int64_t y : {j, j + half}) {
      for (const std::int64_t x : {i, i + half}) look_into(x, y, half);
    }
  }

  /// Whether rays aimed into a square can meet what counts.
  ///
  /// Where a ray aimed so far from the centre is at some distance from the radar, the one through the centre is within
  /// twice as much of it, or ends before; it lands no farther out than the other one where it is as much higher.
  [[nodiscard]] bool leads_to_rings(std::int64_t i, std::int64_t j, std::int64_t side) const {
    const double side_m = static_cast<double>(side) * tile_m_, about_m = std::numbers::sqrt2 / 2.0 * side_m;
    const Vec3d centre{static_cast<double>(i) * tile_m_ + 0.5 * side_m, static_cast<double>(j) * tile_m_ + 0.5 * side_m,
                       outline_.plane_height_m};
    const double height_m = outline_.highest_m + about_m;
    if (!outline_.viewpoint.stands_above(height_m)) return true;
    return outline_.rings.back().meets({centre.x, centre.y}, level_part(outline_.viewpoint.direction_from(centre)),
                                       outline_.viewpoint.landing_before_aim_m(centre, height_m),
                                       rim_m_ + 2.0 * about_m);
  }

  const LaunchArea& outline_;
  double tile_m_, rim_m_;
  LaunchTile first_, last_;
  std::vector<LaunchTile> found_;
};

}  // namespace

std::vector<LaunchTile> tiles_aimed_at(const LaunchArea& outline) {
  return TileSearch(outline).found();
}

}  // namespace sigmascape::trace
