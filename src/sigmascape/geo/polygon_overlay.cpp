#include "sigmascape/geo/polygon_overlay.h"

#include <cmath>
#include <geos_c.h>
#include <string>
#include <tuple>
#include <utility>

#include "sigmascape/geo/geos_geometry.h"

namespace sigmascape::geo {
namespace {

constexpr double grid_m = 0.001;

Polygons made(GEOSGeometry* geometry, const std::string& undone, const Polygons& of) {
  const GeosGeometry owned(geometry);
  if (!owned) throw geos_fault(undone, of);
  return polygons_of(owned);
}

bool is_valid(const GeosGeometry& geometry) {
  return geometry && GEOSisValid_r(geos(), geometry.get()) == 1;
}

/// Whether a geometry is as large as what the rings of a polygon enclose, as it is of rings that touch themselves or
/// one another without crossing.
bool is_as_large(const GeosGeometry& geometry, const Polygon& polygon) {
  constexpr double rounding = 1e-6;
  double area = 0.0;
  const double wanted_m2 = area_m2(polygon);
  return geometry && wanted_m2 > 0.0 && GEOSArea_r(geos(), geometry.get(), &area) == 1 &&
         std::abs(area - wanted_m2) <= rounding * wanted_m2;
}

/// The outline without the courtyards.
GeosGeometry outline_less_holes(const Polygon& polygon) {
  Polygons holes;
  for (const Ring& hole : polygon.holes) {
    if (hole.size() >= 3) holes.push_back({hole, {}});
  }
  if (holes.empty()) return nullptr;
  const GeosGeometry all_holes(GEOSUnaryUnion_r(geos(), geometry_of(holes).get()));
  if (!all_holes) return nullptr;
  return GeosGeometry(GEOSDifference_r(geos(), geometry_of(Polygon{polygon.outer, {}}).get(), all_holes.get()));
}

/// A valid geometry of what the even-odd rule calls inside, and whether rings cross in the polygon.
std::pair<GeosGeometry, Rings> mended(const Polygon& polygon, const GeosGeometry& geometry) {
  GeosGeometry valid(GEOSMakeValid_r(geos(), geometry.get()));
  if (is_as_large(valid, polygon)) return {std::move(valid), Rings::Touch};
  // It fills courtyards that share a piece of the outline.
  GeosGeometry less_holes = outline_less_holes(polygon);
  if (is_valid(less_holes) && is_as_large(less_holes, polygon)) return {std::move(less_holes), Rings::Touch};
  return {std::move(valid), Rings::Cross};
}

}  // namespace

Repaired repaired(const Polygon& polygon) {
  if (polygon.outer.size() < 3) return {{}, Rings::Cross};
  const GeosGeometry geometry = geometry_of(polygon);
  Repaired result;
  GeosGeometry valid;
  if (!is_valid(geometry)) {
    std::tie(valid, result.were) = mended(polygon, geometry);
    if (!valid) throw geos_fault("cannot be repaired", {polygon});
  }
  result.polygons = made(GEOSGeom_setPrecision_r(geos(), (valid ? valid : geometry).get(), grid_m, 0),
                         "cannot be snapped to a grid", {polygon});
  return result;
}

Polygons simplified(const Polygons& polygons, double tolerance_m) {
  const GeosGeometry geometry = geometry_of(polygons);
  const GeosGeometry simple(GEOSTopologyPreserveSimplify_r(geos(), geometry.get(), tolerance_m));
  if (is_valid(simple)) return polygons_of(simple);
  if (polygons.size() == 1) return polygons;
  Polygons each_by_itself;
  for (const Polygon& polygon : polygons) {
    for (Polygon& part : simplified({polygon}, tolerance_m)) each_by_itself.push_back(std::move(part));
  }
  return is_valid(geometry_of(each_by_itself)) ? each_by_itself : polygons;
}

Polygons united(const Polygons& a, const Polygons& b) {
  return made(GEOSUnionPrec_r(geos(), geometry_of(a).get(), geometry_of(b).get(), grid_m), "cannot be united", a);
}

Polygons united_all(const Polygons& polygons) {
  return made(GEOSUnaryUnionPrec_r(geos(), geometry_of(polygons).get(), grid_m), "cannot be united", polygons);
}

Polygons subtracted(const Polygons& from, const Polygons& cut) {
  return made(GEOSDifferencePrec_r(geos(), geometry_of(from).get(), geometry_of(cut).get(), grid_m), "cannot be cut",
              from);
}

Polygons intersected(const Polygons& a, const Polygons& b) {
  return made(GEOSIntersectionPrec_r(geos(), geometry_of(a).get(), geometry_of(b).get(), grid_m),
              "cannot be laid over another", a);
}

}  // namespace sigmascape::geo
