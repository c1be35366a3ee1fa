#include "sigmascape/terrain/extent_about.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::terrain {
namespace {

constexpr double seen_from_the_air_m = 300e3;
/// Where lengths in the frame are too long by a third already.
constexpr double farthest_m = 5000e3;

geo::Extent extent_within(const radar::Rectangle& wanted, double by_m) {
  const radar::Rectangle wide = radar::widened(wanted, by_m);
  return {wide.west_m, wide.south_m, wide.east_m, wide.north_m};
}

geo::Extent common(const geo::Extent& a, const geo::Extent& b) {
  return {std::max(a.west_m, b.west_m), std::max(a.south_m, b.south_m), std::min(a.east_m, b.east_m),
          std::min(a.north_m, b.north_m)};
}

geo::Extent around_both(const geo::Extent& a, const geo::Extent& b) {
  return {std::min(a.west_m, b.west_m), std::min(a.south_m, b.south_m), std::max(a.east_m, b.east_m),
          std::max(a.north_m, b.north_m)};
}

double area_m2(const geo::Extent& extent) {
  return extent.empty() ? 0.0 : (extent.east_m - extent.west_m) * (extent.north_m - extent.south_m);
}

/// The middle of a piece of what is wanted, of 32 × 32, all of whose corners lie in the raster: of that nearest to the
/// middle of all. No edge of the raster runs along its sides.
std::optional<geo::Extent> covered_piece(const geo::Raster& raster, const geo::LocalFrame& frame,
                                         const radar::Rectangle& wanted) {
  constexpr std::size_t pieces = 32;
  const Vec2d side{wanted.width_m() / pieces, wanted.height_m() / pieces};
  const auto corner = [&](std::size_t i, std::size_t j) {
    return Vec2d{wanted.west_m + side.x * static_cast<double>(i), wanted.south_m + side.y * static_cast<double>(j)};
  };
  Array2D<std::uint8_t> covered(pieces + 1, pieces + 1);
  for (std::size_t j = 0; j <= pieces; ++j) {
    for (std::size_t i = 0; i <= pieces; ++i) covered(i, j) = raster.covers(frame, corner(i, j)) ? 1 : 0;
  }
  std::optional<geo::Extent> nearest;
  double distance_m = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < pieces; ++j) {
    for (std::size_t i = 0; i < pieces; ++i) {
      const Vec2d middle = corner(i, j) + side * 0.5;
      const double away_m = length(middle - wanted.centre());
      const int corners = covered(i, j) + covered(i + 1, j) + covered(i, j + 1) + covered(i + 1, j + 1);
      if (corners < 4 || away_m >= distance_m) continue;
      const Vec2d south_west = middle - side * 0.25, north_east = middle + side * 0.25;
      nearest = geo::Extent{south_west.x, south_west.y, north_east.x, north_east.y};
      distance_m = away_m;
    }
  }
  return nearest;
}

/// The outline with points so close about what is wanted that none of its edges crosses that unseen: between two of its
/// own, 8 km apart in a raster of a continent and as good as straight, a whole atlas has room.
geo::RasterOutline refined_about(const geo::RasterOutline& outline, const radar::Rectangle& wanted) {
  constexpr double share = 1.0 / 64.0;
  const double side_m = std::max(wanted.width_m(), wanted.height_m());
  return outline.with_points_in(extent_within(wanted, 0.5 * side_m),
                                share * std::min(wanted.width_m(), wanted.height_m()));
}

/// What a larger rectangle must hold of one: one that touches a bow on a side could not be made longer along it without
/// giving up something.
geo::Extent without_rim(const geo::Extent& extent) {
  constexpr double share = 1.0 / 32.0;
  const double x_m = share * (extent.east_m - extent.west_m), y_m = share * (extent.north_m - extent.south_m);
  return {extent.west_m + x_m, extent.south_m + y_m, extent.east_m - x_m, extent.north_m - y_m};
}

}  // namespace

std::optional<geo::Extent> extent_about(const geo::Raster& raster, const geo::LocalFrame& frame,
                                        const radar::Rectangle& wanted) {
  const auto piece = covered_piece(raster, frame, wanted);
  const geo::RasterOutline plain = raster.outline_in(frame), outline = refined_about(plain, wanted);
  const geo::Extent inside = plain.extent_inside(), all = extent_within(wanted, 0.0);
  if (!piece) return common(inside, all).empty() ? std::nullopt : std::optional(inside);
  if (outline.empty()) return extent_within(wanted, reach_of_globe_m);
  const geo::Extent near = extent_within(wanted, seen_from_the_air_m), far = extent_within(wanted, farthest_m);
  const geo::Extent of_wanted = outline.extent_holding(*piece, all),
                    held = of_wanted == all ? all : without_rim(of_wanted),
                    of_near = outline.extent_holding(held, near);
  // Most rasters are no larger than what is near, and lie along the frame but for a degree or two.
  constexpr double worth_it = 1.1;
  if (common(inside, held) == held && area_m2(of_near) <= worth_it * area_m2(common(inside, near))) return inside;
  const geo::Extent extent = outline.extent_holding(around_both(held, without_rim(of_near)), far);
  // Between two points of the outline a corner may reach out of it.
  const double rim_m = outline.spacing_m(far);
  return around_both(held,
                     {extent.west_m + rim_m, extent.south_m + rim_m, extent.east_m - rim_m, extent.north_m - rim_m});
}

}  // namespace sigmascape::terrain
