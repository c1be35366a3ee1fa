#pragma once

#include <memory>
#include <span>
#include <string>

#include "sigmascape/base/vec.h"
#include "sigmascape/geo/local_frame.h"

namespace sigmascape::geo {

/// A place on the globe, WGS 84.
struct GeographicPosition {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
};

/// Carries positions between a coordinate reference system (CRS) and a local frame.
///
/// In the CRS, x is always the easting or longitude and y the northing or latitude, whatever order its authority states
/// (the traditional order of GIS files). Only the horizontal part of a CRS is used: heights are never touched.
class CoordinateTransform {
 public:
  /// `crs` is an authority code ("EPSG:25830"), a PROJ string or WKT. Throws Error at `where` when it is not
  /// understood.
  CoordinateTransform(const std::string& crs, const LocalFrame& frame, const std::string& where);
  ~CoordinateTransform();
  CoordinateTransform(CoordinateTransform&&) noexcept;
  CoordinateTransform& operator=(CoordinateTransform&&) noexcept;

  /// Replaces positions in the CRS by positions in the frame; those that have none become NaN.
  void to_frame(std::span<Vec2d> positions) const;
  /// Replaces positions in the frame by positions in the CRS; those that have none become NaN.
  void to_crs(std::span<Vec2d> positions) const;

 private:
  struct Ways;
  std::unique_ptr<Ways> ways_;
};

/// Throws Error at `where` unless `crs` is an authority code, PROJ string or WKT of a known reference system.
void require_known_reference(const std::string& crs, const std::string& where);

/// Where a place on the globe lies in a frame.
[[nodiscard]] Vec2d position_in_frame(const LocalFrame& frame, GeographicPosition place);
/// Where a place of another CRS lies on the globe. Throws Error at `where` when it is not understood or does not reach
/// there.
[[nodiscard]] GeographicPosition place_on_globe(const std::string& crs, Vec2d position, const std::string& where);
/// Where a point of a frame lies on the globe.
[[nodiscard]] GeographicPosition place_on_globe(const LocalFrame& frame, Vec2d position);

}  // namespace sigmascape::geo
