#include "sigmascape/geo/polygon_triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <geos_c.h>
#include <utility>

#include "sigmascape/geo/geos_geometry.h"

namespace sigmascape::geo {
namespace {

using Triangles = std::vector<std::array<Vec2d, 3>>;

/// What GEOS fills of it, which is nothing where its way to join courtyards to the outline by bridges to the west finds
/// none.
Triangles filling_of(const Polygon& polygon) {
  const GeosGeometry shape = geometry_of(polygon);
  const GeosGeometry triangles(GEOSConstrainedDelaunayTriangulation_r(geos(), shape.get()));
  Triangles result;
  for (const Polygon& triangle : polygons_of(triangles)) {
    if (triangle.outer.size() == 3) result.push_back({triangle.outer[0], triangle.outer[1], triangle.outer[2]});
  }
  return result;
}

bool fill(const Triangles& triangles, const Polygon& polygon) {
  constexpr double rounding = 1e-6;
  double filled_m2 = 0.0;
  for (const auto& [a, b, c] : triangles) filled_m2 += std::abs(cross(b - a, c - a)) / 2.0;
  const double wanted_m2 = area_m2(polygon);
  return std::abs(filled_m2 - wanted_m2) <= rounding * wanted_m2;
}

Vec2d turned(Vec2d point, int quarters) {
  for (int i = 0; i < quarters; ++i) point = {-point.y, point.x};
  return point;
}

Polygon turned(Polygon polygon, int quarters) {
  const auto turn = [&](Ring& ring) {
    for (Vec2d& corner : ring) corner = turned(corner, quarters);
  };
  turn(polygon.outer);
  std::ranges::for_each(polygon.holes, turn);
  return polygon;
}

/// Where along an edge, from 0 to 1, a point lies on it and is none of its ends; -1 where it does not.
double place_on(Vec2d from, Vec2d to, Vec2d point) {
  constexpr double touching_m = 0.0005;
  const Vec2d edge = to - from;
  const double edge_m = length(edge), along_m = dot(point - from, edge) / edge_m;
  const bool is_on_it = point != from && point != to && along_m > 0.0 && along_m < edge_m &&
                        std::abs(cross(edge, point - from)) <= touching_m * edge_m;
  return is_on_it ? along_m / edge_m : -1.0;
}

/// A ring with those corners of other rings that lie on its edges.
Ring divided(const Ring& ring, const std::vector<const Ring*>& others) {
  Ring result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d from = ring[i], to = ring[(i + 1) % ring.size()];
    std::vector<std::pair<double, Vec2d>> on_it;
    for (const Ring* other : others) {
      if (other == &ring) continue;
      for (const Vec2d& corner : *other) {
        const double place = place_on(from, to, corner);
        if (place >= 0.0) on_it.emplace_back(place, corner);
      }
    }
    std::ranges::sort(on_it, {}, [](const auto& corner) { return corner.first; });
    result.push_back(from);
    for (const auto& [place, corner] : on_it) {
      if (corner != result.back()) result.push_back(corner);
    }
  }
  return result;
}

Polygon with_divided_edges(const Polygon& polygon) {
  std::vector<const Ring*> rings{&polygon.outer};
  for (const Ring& hole : polygon.holes) rings.push_back(&hole);
  Polygon result{divided(polygon.outer, rings), {}};
  for (const Ring& hole : polygon.holes) result.holes.push_back(divided(hole, rings));
  return result;
}

}  // namespace

Triangles triangulated(const Polygon& polygon) {
  // What cannot be filled as it lies can be nearly always when it is turned: bridges to the west are others then.
  for (const bool is_divided : {false, true}) {
    const Polygon shape = is_divided ? with_divided_edges(polygon) : polygon;
    for (int quarters = 0; quarters < 4; ++quarters) {
      Triangles triangles = filling_of(turned(shape, quarters));
      if (!fill(triangles, shape)) continue;
      for (auto& triangle : triangles) {
        for (Vec2d& corner : triangle) corner = turned(corner, 4 - quarters);
      }
      return triangles;
    }
  }
  throw geos_fault("cannot be filled with triangles", {polygon});
}

}  // namespace sigmascape::geo
