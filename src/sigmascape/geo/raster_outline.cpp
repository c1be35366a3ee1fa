#include "sigmascape/geo/raster_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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

Extent between_innermost_points(const RasterOutline& outline) {
  return {std::ranges::max_element(outline.west, by_x)->x, std::ranges::max_element(outline.south, by_y)->y,
          std::ranges::min_element(outline.east, by_x)->x, std::ranges::min_element(outline.north, by_y)->y};
}

/// The farthest that two neighbouring points of the edges lie apart.
double spacing_m(const RasterOutline& outline) {
  double widest_m = 0.0;
  for (const auto* edge : edges_of(outline)) {
    for (std::size_t i = 0; i + 1 < edge->size(); ++i)
      widest_m = std::max(widest_m, length((*edge)[i + 1] - (*edge)[i]));
  }
  return widest_m;
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
  const double rim_m = 0.5 * spacing_m(outline);
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

Extent RasterOutline::extent_around() const {
  if (empty()) return {-infinity, -infinity, infinity, infinity};
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
