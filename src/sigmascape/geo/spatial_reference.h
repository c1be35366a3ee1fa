#pragma once

#include <memory>
#include <ogr_spatialref.h>
#include <optional>
#include <string>

namespace sigmascape::geo {

/// A CRS as GDAL holds it, with x before y and longitude before latitude whatever its authority says; a local frame has
/// its title. `crs` is anything that PROJ understands. Throws Error, which names `where`, when it does not.
[[nodiscard]] OGRSpatialReference reference_from(const std::string& crs, const std::string& where);

/// The same, and nothing when PROJ does not understand it.
[[nodiscard]] std::optional<OGRSpatialReference> known_reference(const std::string& crs);

/// As WKT2 (ISO 19162:2019), on one line. Throws Error when it cannot be said so.
[[nodiscard]] std::string wkt2_from(const OGRSpatialReference& reference);

struct BackToGdal {
  void operator()(OGRCoordinateTransformation* way) const { OGRCoordinateTransformation::DestroyCT(way); }
};
/// What carries positions from one CRS into another. To find it PROJ looks through all datums that it knows, which
/// takes far longer than to go: GDAL keeps what is given back to it for whoever next asks for the same.
using ReferenceWay = std::unique_ptr<OGRCoordinateTransformation, BackToGdal>;

/// nullptr where there is none.
[[nodiscard]] ReferenceWay way_between(const OGRSpatialReference& from, const OGRSpatialReference& to);

}  // namespace sigmascape::geo
