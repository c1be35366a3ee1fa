#include "sigmascape/geo/polygon_overlay.h"

#include <geos_c.h>
#include <memory>
#include <utility>

namespace sigmascape::geo {
namespace {

constexpr double grid_m = 0.001;

/// GEOS state of one thread.
GEOSContextHandle_t geos() {
  struct Context {
    GEOSContextHandle_t handle = GEOS_init_r();
    ~Context() { GEOS_finish_r(handle); }
  };
  thread_local Context context;
  return context.handle;
}

struct GeometryDeleter {
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(geos(), geometry); }
};
using Geometry = std::unique_ptr<GEOSGeometry, GeometryDeleter>;

GEOSGeometry* linear_ring(const Ring& ring) {
  const auto count = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(geos(), count + 1, 2);
  for (unsigned i = 0; i <= count; ++i) {
    const Vec2d& corner = ring[i % count];
    GEOSCoordSeq_setXY_r(geos(), sequence, i, corner.x, corner.y);
  }
  return GEOSGeom_createLinearRing_r(geos(), sequence);
}

Geometry geometry_of(const Polygon& polygon) {
  std::vector<GEOSGeometry*> holes;
  for (const Ring& hole : polygon.holes) {
    if (hole.size() >= 3) holes.push_back(linear_ring(hole));
  }
  return Geometry(
      GEOSGeom_createPolygon_r(geos(), linear_ring(polygon.outer), holes.data(), static_cast<unsigned>(holes.size())));
}

Geometry geometry_of(const Polygons& polygons) {
  std::vector<GEOSGeometry*> parts;
  for (const Polygon& polygon : polygons) parts.push_back(geometry_of(polygon).release());
  return Geometry(
      GEOSGeom_createCollection_r(geos(), GEOS_MULTIPOLYGON, parts.data(), static_cast<unsigned>(parts.size())));
}

Ring ring_of(const GEOSGeometry* line) {
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(geos(), line);
  unsigned count = 0;
  GEOSCoordSeq_getSize_r(geos(), sequence, &count);
  Ring ring(count);
  for (unsigned i = 0; i < count; ++i) GEOSCoordSeq_getXY_r(geos(), sequence, i, &ring[i].x, &ring[i].y);
  return ring;
}

Polygon polygon_of(const GEOSGeometry* geometry) {
  Polygon polygon{tidy_ring(ring_of(GEOSGetExteriorRing_r(geos(), geometry)), true), {}};
  for (int i = 0; i < GEOSGetNumInteriorRings_r(geos(), geometry); ++i) {
    polygon.holes.push_back(tidy_ring(ring_of(GEOSGetInteriorRingN_r(geos(), geometry, i)), false));
  }
  return polygon;
}

void append_polygons(const GEOSGeometry* geometry, Polygons& polygons) {
  if (geometry == nullptr) return;
  const int type = GEOSGeomTypeId_r(geos(), geometry);
  if (type == GEOS_POLYGON) {
    if (GEOSisEmpty_r(geos(), geometry) == 0) polygons.push_back(polygon_of(geometry));
  } else if (type == GEOS_MULTIPOLYGON || type == GEOS_GEOMETRYCOLLECTION) {
    for (int i = 0; i < GEOSGetNumGeometries_r(geos(), geometry); ++i) {
      append_polygons(GEOSGetGeometryN_r(geos(), geometry, i), polygons);
    }
  }
}

Polygons polygons_of(const Geometry& geometry) {
  Polygons polygons;
  append_polygons(geometry.get(), polygons);
  return polygons;
}

}  // namespace

Repaired repaired(const Polygon& polygon) {
  if (polygon.outer.size() < 3) return {{}, false};
  const Geometry geometry = geometry_of(polygon);
  Repaired result;
  result.was_valid = GEOSisValid_r(geos(), geometry.get()) == 1;
  const Geometry valid(result.was_valid ? GEOSGeom_clone_r(geos(), geometry.get())
                                        : GEOSMakeValid_r(geos(), geometry.get()));
  if (valid) result.polygons = polygons_of(Geometry(GEOSGeom_setPrecision_r(geos(), valid.get(), grid_m, 0)));
  return result;
}

Polygons simplified(const Polygons& polygons, double tolerance_m) {
  const Geometry geometry = geometry_of(polygons);
  return polygons_of(Geometry(GEOSTopologyPreserveSimplify_r(geos(), geometry.get(), tolerance_m)));
}

Polygons united(const Polygons& a, const Polygons& b) {
  return polygons_of(Geometry(GEOSUnionPrec_r(geos(), geometry_of(a).get(), geometry_of(b).get(), grid_m)));
}

Polygons united_all(const Polygons& polygons) {
  return polygons_of(Geometry(GEOSUnaryUnionPrec_r(geos(), geometry_of(polygons).get(), grid_m)));
}

Polygons subtracted(const Polygons& from, const Polygons& cut) {
  return polygons_of(Geometry(GEOSDifferencePrec_r(geos(), geometry_of(from).get(), geometry_of(cut).get(), grid_m)));
}

Polygons intersected(const Polygons& a, const Polygons& b) {
  return polygons_of(Geometry(GEOSIntersectionPrec_r(geos(), geometry_of(a).get(), geometry_of(b).get(), grid_m)));
}

std::vector<std::array<Vec2d, 3>> triangulated(const Polygon& polygon) {
  const Geometry shape = geometry_of(polygon);
  const Geometry triangles(GEOSConstrainedDelaunayTriangulation_r(geos(), shape.get()));
  std::vector<std::array<Vec2d, 3>> result;
  for (const Polygon& triangle : polygons_of(triangles)) {
    if (triangle.outer.size() == 3) result.push_back({triangle.outer[0], triangle.outer[1], triangle.outer[2]});
  }
  return result;
}

}  // namespace sigmascape::geo
