#include "sigmascape/geo/geos_geometry.h"

#include <fmt/format.h>
#include <utility>
#include <vector>

namespace sigmascape::geo {
namespace {

struct Context {
  GEOSContextHandle_t handle = GEOS_init_r();
  std::string complaint;

  Context() {
    GEOSContext_setErrorMessageHandler_r(
        handle, [](const char* message, void* kept) { *static_cast<std::string*>(kept) = message; }, &complaint);
  }
  ~Context() { GEOS_finish_r(handle); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

Context& context() {
  thread_local Context of_thread;
  return of_thread;
}

GEOSGeometry* linear_ring(const Ring& ring) {
  const auto count = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(geos(), count + 1, 2);
  for (unsigned i = 0; i <= count; ++i) {
    const Vec2d& corner = ring[i % count];
    GEOSCoordSeq_setXY_r(geos(), sequence, i, corner.x, corner.y);
  }
  return GEOSGeom_createLinearRing_r(geos(), sequence);
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

std::string place_of(const Polygons& polygons) {
  for (const Polygon& polygon : polygons) {
    if (!polygon.outer.empty())
      return fmt::format(" at {:.1f} m east and {:.1f} m north of the origin", polygon.outer[0].x, polygon.outer[0].y);
  }
  return "";
}

}  // namespace

GEOSContextHandle_t geos() {
  return context().handle;
}

GeosGeometry geometry_of(const Polygon& polygon) {
  std::vector<GEOSGeometry*> holes;
  for (const Ring& hole : polygon.holes) {
    if (hole.size() >= 3) holes.push_back(linear_ring(hole));
  }
  return GeosGeometry(
      GEOSGeom_createPolygon_r(geos(), linear_ring(polygon.outer), holes.data(), static_cast<unsigned>(holes.size())));
}

GeosGeometry geometry_of(const Polygons& polygons) {
  std::vector<GEOSGeometry*> parts;
  for (const Polygon& polygon : polygons) parts.push_back(geometry_of(polygon).release());
  return GeosGeometry(
      GEOSGeom_createCollection_r(geos(), GEOS_MULTIPOLYGON, parts.data(), static_cast<unsigned>(parts.size())));
}

Polygons polygons_of(const GeosGeometry& geometry) {
  Polygons polygons;
  append_polygons(geometry.get(), polygons);
  return polygons;
}

Error geos_fault(const std::string& undone, const Polygons& of) {
  // Taken, so that no later fault has the words of this one.
  const std::string complaint = std::exchange(context().complaint, {});
  return Error("outline" + place_of(of), complaint.empty() ? undone : fmt::format("{} ({})", undone, complaint),
               "correct it, or leave it out");
}

}  // namespace sigmascape::geo
