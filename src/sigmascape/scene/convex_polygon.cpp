#include "sigmascape/scene/convex_polygon.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::scene {
namespace {

Vec2d direction_of(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

struct Span {
  double from, to;
  [[nodiscard]] double length() const { return to - from; }
};

Span span_along(const ConvexPolygon& polygon, Vec2d direction) {
  Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vec2d corner : polygon) {
    span.from = std::min(span.from, dot(corner, direction));
    span.to = std::max(span.to, dot(corner, direction));
  }
  return span;
}

/// A number in [−1, 1).
double signed_unit(std::uint64_t key, unsigned n) {
  return 2.0 * unit_float(hashed(key, n)) - 1.0;
}

void partition_into(std::vector<ConvexPolygon>& parts, const ConvexPolygon& polygon, double axis_rad,
                    const PartitionOptions& options, std::uint64_t key) {
  if (polygon.size() < 3) return;
  const double area = area_m2(polygon);
  if (area < options.target_area_m2 * (1.2 + 0.6 * signed_unit(key, 0))) {
    parts.push_back(polygon);
    return;
  }
  const bool along_is_longer = span_along(polygon, direction_of(axis_rad)).length() >
                               span_along(polygon, direction_of(axis_rad + pi / 2)).length();
  const double across_rad = axis_rad + (along_is_longer ? 0.0 : pi / 2) + options.axis_jitter_rad * signed_unit(key, 1);
  const Vec2d across = direction_of(across_rad), cut = direction_of(across_rad + pi / 2);
  const Span span = span_along(polygon, across);
  const Vec2d on_cut = across * (span.from + span.length() * (0.5 + 0.13 * signed_unit(key, 2)));
  const double turn = area > options.district_area_m2 ? options.district_turn_rad : 0.0;
  partition_into(parts, left_part(polygon, on_cut, cut), axis_rad + turn * signed_unit(key, 3), options,
                 hashed(key, 4));
  partition_into(parts, left_part(polygon, on_cut, cut * -1.0), axis_rad + turn * signed_unit(key, 5), options,
                 hashed(key, 6));
}

}  // namespace

double area_m2(const ConvexPolygon& polygon) {
  double twofold = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twofold += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twofold / 2.0;
}

Vec2d middle_of(const ConvexPolygon& polygon) {
  Vec2d sum;
  for (const Vec2d corner : polygon) sum = sum + corner;
  return sum * (1.0 / static_cast<double>(polygon.size()));
}

ConvexPolygon left_part(const ConvexPolygon& polygon, Vec2d on_line, Vec2d direction) {
  ConvexPolygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2d a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double side_a = cross(direction, a - on_line), side_b = cross(direction, b - on_line);
    if (side_a >= 0.0) kept.push_back(a);
    if ((side_a < 0.0) != (side_b < 0.0)) kept.push_back(a + (b - a) * (side_a / (side_a - side_b)));
  }
  return kept.size() < 3 ? ConvexPolygon{} : kept;
}

ConvexPolygon inset(const ConvexPolygon& polygon, double distance_m) {
  ConvexPolygon inner = polygon;
  for (std::size_t i = 0; i < polygon.size() && !inner.empty(); ++i) {
    const Vec2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (length(edge) < 1e-6) continue;
    const Vec2d along = edge * (1.0 / length(edge));
    inner = left_part(inner, polygon[i] + Vec2d{-along.y, along.x} * distance_m, along);
  }
  return inner;
}

ConvexPolygon oriented_rectangle(Vec2d centre, Vec2d along, double length_m, double width_m) {
  const Vec2d u = along * (length_m / 2.0), v = Vec2d{-along.y, along.x} * (width_m / 2.0);
  return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

ConvexPolygon strip(Vec2d from, Vec2d to, double half_width_m) {
  const double run = length(to - from);
  if (run < 1e-9) return {};
  return oriented_rectangle((from + to) * 0.5, (to - from) * (1.0 / run), run + 2.0 * half_width_m, 2.0 * half_width_m);
}

std::vector<ConvexPolygon> partitioned(const ConvexPolygon& polygon, double axis_rad, const PartitionOptions& options,
                                       std::uint64_t seed) {
  std::vector<ConvexPolygon> parts;
  partition_into(parts, polygon, axis_rad, options, seed);
  return parts;
}

}  // namespace sigmascape::scene
