#include "sigmascape/geo/coordinate_transform.h"

#include <fmt/format.h>
#include <limits>
#include <ogr_spatialref.h>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {
namespace {

OGRSpatialReference horizontal_reference(const std::string& crs, const std::string& where) {
  OGRSpatialReference reference = reference_from(crs, where);
  if (reference.IsCompound()) reference.StripVertical();
  const bool is_geocentric = reference.IsGeocentric() != 0;
  if (is_geocentric || reference.IsVertical() != 0) {
    throw Error(where,
                fmt::format("'{}' counts {}", crs.substr(0, 60),
                            is_geocentric ? "places from the middle of the Earth, and none along the ground"
                                          : "heights and no places"),
                "choose a system of places on the ground, such as EPSG:25830 or EPSG:4326");
  }
  reference.DemoteTo2D(nullptr);
  return reference;
}

void transform(OGRCoordinateTransformation& way, std::span<Vec2d> positions) {
  std::vector<double> x, y;
  x.reserve(positions.size());
  y.reserve(positions.size());
  for (const Vec2d& position : positions) {
    x.push_back(position.x);
    y.push_back(position.y);
  }
  std::vector<int> found(positions.size(), FALSE);
  const QuietGdal quiet;
  way.Transform(static_cast<int>(positions.size()), x.data(), y.data(), nullptr, found.data());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = found[i] != 0 ? Vec2d{x[i], y[i]} : Vec2d{nan, nan};
}

}  // namespace

void require_known_reference(const std::string& crs, const std::string& where) {
  static_cast<void>(horizontal_reference(crs, where));
}

struct CoordinateTransform::Ways {
  ReferenceWay to_frame, to_crs;
};

CoordinateTransform::CoordinateTransform(const std::string& crs, const LocalFrame& frame, const std::string& where)
    : ways_(std::make_unique<Ways>()) {
  const QuietGdal quiet;
  const OGRSpatialReference outside = horizontal_reference(crs, where);
  const OGRSpatialReference inside = horizontal_reference(frame.proj(), where);
  *ways_ = {.to_frame = way_between(outside, inside), .to_crs = way_between(inside, outside)};
  if (!ways_->to_frame || !ways_->to_crs) {
    throw Error(where, fmt::format("no transformation is known from '{}' to the scene's frame", crs.substr(0, 60)),
                "bring the data into a common reference such as WGS 84 (EPSG:4326) first");
  }
}

CoordinateTransform::~CoordinateTransform() = default;
CoordinateTransform::CoordinateTransform(CoordinateTransform&&) noexcept = default;
CoordinateTransform& CoordinateTransform::operator=(CoordinateTransform&&) noexcept = default;

void CoordinateTransform::to_frame(std::span<Vec2d> positions) const {
  transform(*ways_->to_frame, positions);
}
void CoordinateTransform::to_crs(std::span<Vec2d> positions) const {
  transform(*ways_->to_crs, positions);
}

Vec2d position_in_frame(const LocalFrame& frame, GeographicPosition place) {
  Vec2d position{place.longitude_deg, place.latitude_deg};
  CoordinateTransform("EPSG:4326", frame, "position").to_frame({&position, 1});
  return position;
}

GeographicPosition place_on_globe(const std::string& crs, Vec2d position, const std::string& where) {
  const QuietGdal quiet;
  const OGRSpatialReference own = horizontal_reference(crs, where), globe = horizontal_reference("EPSG:4326", where);
  const ReferenceWay way = way_between(own, globe);
  if (!way || way->Transform(1, &position.x, &position.y) == 0) {
    throw Error(where, "its centre has no place on the globe",
                "check its georeference and coordinate reference system");
  }
  return {position.y, position.x};
}

GeographicPosition place_on_globe(const LocalFrame& frame, Vec2d position) {
  CoordinateTransform("EPSG:4326", frame, "position").to_crs({&position, 1});
  return {position.y, position.x};
}

}  // namespace sigmascape::geo
