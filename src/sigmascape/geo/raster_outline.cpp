#include "sigmascape/geo/raster_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "sigmascape/geo/polygon.h"

namespace sigmascape::geo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool by_x(Vec2d a, Vec2d b) {
  return a.x < b.x;
}
bool by_y(Vec2d a, Vec2d b) {
  return a.y < b.y;
}

Vec2d middle_of(const std::vector<Vec2d>& edge) {
  return edge[edge.size() / 2];
}

double area_m2(const Extent& extent) {
  return extent.empty() ? 0.0 : (extent.east_m - extent.west_m) * (extent.north_m - extent.south_m);
}

std::array<const std::vector<Vec2d>*, 4> edges_of(const RasterOutline& outline) {
  return {&outline.west, &outline.east, &outline.south, &outline.north};
}

/// All four, one after the other, around what they enclose.
Ring ring_along(const RasterOutline& outline) {
  Ring ring;
  const auto go_along = [&ring](std::vector<Vec2d> edge, bool is_reversed) {
    if (is_reversed) std::ranges::reverse(edge);
    ring.insert(ring.end(), edge.begin(), edge.end());
  };
  const auto& [west, east, south, north] = outline;
  go_along(south, by_x(south.back(), south.front()));
  go_along(east, by_y(east.back(), east.front()));
  go_along(north, by_x(north.front(), north.back()));
  go_along(west, by_y(west.front(), west.back()));
  return ring;
}

Extent between_innermost_points(const RasterOutline& outline) {
  return {std::ranges::max_element(outline.west, by_x)->x, std::ranges::max_element(outline.south, by_y)->y,
          std::ranges::min_element(outline.east, by_x)->x, std::ranges::min_element(outline.north, by_y)->y};
}

constexpr Extent everywhere{-infinity, -infinity, infinity, infinity};

bool holds(const Extent& extent, Vec2d point) {
  return point.x > extent.west_m && point.x < extent.east_m && point.y > extent.south_m && point.y < extent.north_m;
}

/// How far north and south a rectangle may reach that reaches so far to one side.
struct Reach {
  double aside_m = 0.0, north_m = 0.0, south_m = 0.0;

  /// Less far, so as not to take in a point above or below `held`.
  void leave_out(Vec2d point, const Extent& held) {
    if (point.y >= held.north_m) north_m = std::min(north_m, point.y);
    if (point.y <= held.south_m) south_m = std::max(south_m, point.y);
  }
};

/// All ways to reach out to one side, which is the greater x, of a rectangle, each as far as its north and south let
/// it. Points are those beside it, from the nearest on.
std::vector<Reach> ways_aside(const std::vector<Vec2d>& beside, const Extent& held, Reach reach, double farthest_m) {
  std::vector<Reach> ways;
  for (const Vec2d& point : beside) {
    const Reach before{point.x, reach.north_m, reach.south_m};
    const bool is_level = point.y < held.north_m && point.y > held.south_m;
    reach.leave_out(point, held);
    const bool is_hindered = is_level || reach.north_m < before.north_m || reach.south_m > before.south_m;
    if (is_hindered) ways.push_back(before);
    if (is_level) return ways;
  }
  ways.push_back({farthest_m, reach.north_m, reach.south_m});
  return ways;
}

std::vector<Reach> ways_east(std::vector<Vec2d> points, const Extent& held, const Reach& upright, double farthest_m) {
  std::erase_if(points, [&](Vec2d point) { return point.x < held.east_m; });
  std::ranges::sort(points, by_x);
  return ways_aside(points, held, upright, farthest_m);
}

/// Those to the west, as if it were the east.
std::vector<Reach> ways_west(std::vector<Vec2d> points, const Extent& held, const Reach& upright, double farthest_m) {
  for (Vec2d& point : points) point.x = -point.x;
  const Extent mirrored{-held.east_m, held.south_m, -held.west_m, held.north_m};
  return ways_east(std::move(points), mirrored, upright, -farthest_m);
}

/// What of the line from one point to another lies in a rectangle, as shares of its length; none where the first is not
/// less than the second.
std::pair<double, double> shares_within(Vec2d from, Vec2d to, const Extent& within) {
  double first = 0.0, last = 1.0;
  const auto cut = [&](double start, double way, double least, double greatest) {
    // Infinite of a line along the sides, and not a number of one on a side itself, which cuts nothing off.
    const auto [one, other] = std::minmax({(least - start) / way, (greatest - start) / way});
    if (one > first) first = one;
    if (other < last) last = other;
  };
  cut(from.x, to.x - from.x, within.west_m, within.east_m);
  cut(from.y, to.y - from.y, within.south_m, within.north_m);
  return {first, last};
}

std::vector<Vec2d> with_points_between(const std::vector<Vec2d>& edge, const Extent& within, double spacing_m) {
  std::vector<Vec2d> points;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    points.push_back(edge[i]);
    if (i + 1 == edge.size()) break;
    const Vec2d way = edge[i + 1] - edge[i];
    const auto [first, last] = shares_within(edge[i], edge[i + 1], within);
    if (!(first < last)) continue;
    const auto steps = static_cast<std::size_t>(std::ceil((last - first) * length(way) / spacing_m));
    for (std::size_t step = 0; step <= steps; ++step)
      points.push_back(edge[i] + way * std::lerp(first, last, static_cast<double>(step) / static_cast<double>(steps)));
  }
  return points;
}

/// The largest rectangle about the middle that holds no point of the edges, of those from 32 times as high as wide to
/// 32 times as wide as high, less what its corners may reach out between two points.
Extent largest_about_middle(const RasterOutline& outline) {
  const Vec2d middle = (middle_of(outline.west) + middle_of(outline.east)) * 0.5;
  Vec2d largest;
  for (int step = -80; step <= 80; ++step) {
    const Vec2d shape{std::exp2(step / 32.0), std::exp2(-step / 32.0)};
    double size_m = infinity;
    for (const auto* edge : edges_of(outline)) {
      for (const Vec2d& point : *edge) {
        const Vec2d away = point - middle;
        size_m = std::min(size_m, std::max(std::abs(away.x) / shape.x, std::abs(away.y) / shape.y));
      }
    }
    const Vec2d half = shape * size_m;
    if (half.x * half.y > largest.x * largest.y) largest = half;
  }
  const double rim_m = 0.5 * outline.spacing_m(everywhere);
  const Vec2d half{std::max(0.0, largest.x - rim_m), std::max(0.0, largest.y - rim_m)};
  return {middle.x - half.x, middle.y - half.y, middle.x + half.x, middle.y + half.y};
}

}  // namespace

RasterOutline RasterOutline::of(std::vector<Vec2d> one, std::vector<Vec2d> opposite, std::vector<Vec2d> other,
                                std::vector<Vec2d> opposite_other) {
  for (auto* edge : {&one, &opposite, &other, &opposite_other}) {
    std::erase_if(*edge, [](Vec2d point) { return !std::isfinite(point.x) || !std::isfinite(point.y); });
    if (edge->empty()) return {};
  }
  const Vec2d across = middle_of(opposite) - middle_of(one);
  if (std::abs(across.y) > std::abs(across.x)) {
    std::swap(one, other);
    std::swap(opposite, opposite_other);
  }
  if (middle_of(one).x > middle_of(opposite).x) std::swap(one, opposite);
  if (middle_of(other).y > middle_of(opposite_other).y) std::swap(other, opposite_other);
  return {std::move(one), std::move(opposite), std::move(other), std::move(opposite_other)};
}

Extent RasterOutline::extent_inside() const {
  if (empty()) return {};
  // A rectangle that fits a raster along the frame but for a hundredth stays the one between its edges, which need not
  // lie alike about the middle.
  constexpr double worth_it = 1.01;
  const Extent between = between_innermost_points(*this), about_middle = largest_about_middle(*this);
  return area_m2(about_middle) > worth_it * area_m2(between) ? about_middle : between;
}

Extent RasterOutline::extent_holding(const Extent& held, const Extent& limit) const {
  std::vector<Vec2d> points;
  for (const auto* edge : edges_of(*this)) {
    std::ranges::copy_if(*edge, std::back_inserter(points), [&](Vec2d point) { return holds(limit, point); });
  }
  Reach upright{0.0, limit.north_m, limit.south_m};
  for (const Vec2d& point : points) {
    if (point.x > held.west_m && point.x < held.east_m) upright.leave_out(point, held);
  }
  const std::vector<Reach> westward = ways_west(points, held, upright, limit.west_m),
                           eastward = ways_east(points, held, upright, limit.east_m);
  Extent largest = held;
  for (const Reach& w : westward) {
    for (const Reach& e : eastward) {
      const Extent extent{-w.aside_m, std::max(w.south_m, e.south_m), e.aside_m, std::min(w.north_m, e.north_m)};
      if (area_m2(extent) > area_m2(largest)) largest = extent;
    }
  }
  return largest;
}

RasterOutline RasterOutline::with_points_in(const Extent& within, double spacing_m) const {
  const auto refined = [&](const std::vector<Vec2d>& edge) { return with_points_between(edge, within, spacing_m); };
  return {refined(west), refined(east), refined(south), refined(north)};
}

double RasterOutline::spacing_m(const Extent& within) const {
  double widest_m = 0.0;
  for (const auto* edge : edges_of(*this)) {
    for (std::size_t i = 0; i + 1 < edge->size(); ++i) {
      if (holds(within, (*edge)[i]) || holds(within, (*edge)[i + 1]))
        widest_m = std::max(widest_m, length((*edge)[i + 1] - (*edge)[i]));
    }
  }
  return widest_m;
}

double RasterOutline::enclosed_m2() const {
  return empty() ? 0.0 : std::abs(signed_area_m2(ring_along(*this)));
}

std::vector<double> RasterOutline::crossings_m(double y_m) const {
  if (empty()) return {};
  std::vector<double> crossings;
  const Ring ring = ring_along(*this);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d from = ring[i], to = ring[(i + 1) % ring.size()];
    // A corner on the line belongs to the edge above it.
    if ((from.y > y_m) != (to.y > y_m)) crossings.push_back(std::lerp(from.x, to.x, (y_m - from.y) / (to.y - from.y)));
  }
  std::ranges::sort(crossings);
  return crossings;
}

Extent RasterOutline::extent_around() const {
  if (empty()) return everywhere;
  Extent around{infinity, infinity, -infinity, -infinity};
  for (const auto* edge : edges_of(*this)) {
    const auto [westmost, eastmost] = std::ranges::minmax_element(*edge, by_x);
    const auto [southmost, northmost] = std::ranges::minmax_element(*edge, by_y);
    around = {std::min(around.west_m, westmost->x), std::min(around.south_m, southmost->y),
              std::max(around.east_m, eastmost->x), std::max(around.north_m, northmost->y)};
  }
  return around;
}

}  // namespace sigmascape::geo
