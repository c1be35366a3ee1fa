#pragma once

#include <geos_c.h>
#include <memory>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/polygon_overlay.h"

namespace sigmascape::geo {

/// Polygons to GEOS and back. What GEOS cannot do it answers with no geometry, which is another thing than an empty
/// one.

/// GEOS state of one thread.
[[nodiscard]] GEOSContextHandle_t geos();

struct GeosDeleter {
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(geos(), geometry); }
};
using GeosGeometry = std::unique_ptr<GEOSGeometry, GeosDeleter>;

[[nodiscard]] GeosGeometry geometry_of(const Polygon& polygon);
[[nodiscard]] GeosGeometry geometry_of(const Polygons& polygons);

/// The polygons in it; none of no geometry.
[[nodiscard]] Polygons polygons_of(const GeosGeometry& geometry);

/// An Error at the place of the first of some polygons, of which GEOS made nothing. `undone` goes as "cannot be
/// united".
[[nodiscard]] Error geos_fault(const std::string& undone, const Polygons& of);

}  // namespace sigmascape::geo
