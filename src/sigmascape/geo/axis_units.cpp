#include "sigmascape/geo/axis_units.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <ogr_spatialref.h>

#include "sigmascape/base/units.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/foot.h"
#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {
namespace {

bool is_unit(double given, double unit) {
  return std::abs(given - unit) < 1e-9 * unit;
}

/// How far a turn reaches in x of a projection, from longitudes about its central meridian; 0 where x does not grow
/// evenly with them, or with latitude as well.
double turn_of_projection(const OGRSpatialReference& projected) {
  const QuietGdal quiet;
  const std::unique_ptr<OGRSpatialReference> unprojected(projected.CloneGeogCS());
  if (!unprojected) return 0.0;
  unprojected->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const ReferenceWay projection = way_between(*unprojected, projected);
  if (!projection) return 0.0;
  const double degree = radians_from_deg(1.0) / unprojected->GetAngularUnits();
  const auto x_at = [&](double degrees_east, double latitude_deg) {
    double x = (projected.GetNormProjParm(SRS_PP_CENTRAL_MERIDIAN) + degrees_east) * degree, y = latitude_deg * degree;
    return projection->Transform(1, &x, &y) != 0 ? x : std::numeric_limits<double>::quiet_NaN();
  };
  const double middle = x_at(0.0, 0.0), quarter = x_at(90.0, 0.0) - middle;
  const auto is_even = [&](double degrees_east, double latitude_deg) {
    return std::abs(x_at(degrees_east, latitude_deg) - middle - degrees_east / 90.0 * quarter) <
           1e-9 * std::abs(quarter);
  };
  return is_even(-170.0, 0.0) && is_even(45.0, 0.0) && is_even(90.0, 60.0) ? 4.0 * std::abs(quarter) : 0.0;
}

}  // namespace

std::string axis_unit(const std::string& crs) {
  const auto reference = known_reference(crs);
  if (!reference) return "m";
  if (reference->IsGeographic() != 0)
    return is_unit(reference->GetAngularUnits(), radians_from_deg(1.0)) ? "deg" : "units";
  const double metres = reference->GetLinearUnits();
  if (is_unit(metres, 1.0)) return "m";
  if (is_unit(metres, foot_m)) return "ft";
  return is_unit(metres, us_survey_foot_m) ? "us_ft" : "units";
}

std::optional<double> metres_per_vertical_unit(const std::string& crs) {
  constexpr int vertical = 2;
  const auto reference = known_reference(crs);
  if (!reference || reference->GetAxesCount() <= vertical || reference->IsGeocentric() != 0) return std::nullopt;
  double metres = 0.0;
  const bool is_told = reference->GetAxis(nullptr, vertical, nullptr, &metres) != nullptr && metres > 0.0;
  return is_told ? std::optional(metres) : std::nullopt;
}

double ground_metres_per_unit(const std::string& crs, Vec2d place) {
  if (!known_reference(crs)) return 1.0;
  const GeographicPosition middle = place_on_globe(crs, place, "map");
  const double turn = full_turn(crs), step = turn > 0.0 ? 1e-7 * turn : 1.0;
  std::array ends{place - Vec2d{0.5 * step, 0.0}, place + Vec2d{0.5 * step, 0.0}};
  CoordinateTransform(crs, LocalFrame(middle.latitude_deg, middle.longitude_deg), "map").to_frame(ends);
  const double metres = length(ends[1] - ends[0]) / step;
  return std::isfinite(metres) && metres > 0.0 ? metres : 1.0;
}

Vec2d way_at_azimuth(const std::string& crs, Vec2d place, double azimuth_rad) {
  const Vec2d on_ground{std::sin(azimuth_rad), std::cos(azimuth_rad)};
  if (!known_reference(crs)) return on_ground;
  const GeographicPosition middle = place_on_globe(crs, place, "map");
  std::array ends{on_ground * -50.0, on_ground * 50.0};
  CoordinateTransform(crs, LocalFrame(middle.latitude_deg, middle.longitude_deg), "map").to_crs(ends);
  const double turn = full_turn(crs);
  const Vec2d way{on_turn_of(ends[1].x, ends[0].x, turn) - ends[0].x, ends[1].y - ends[0].y};
  return length(way) > 0.0 ? way * (1.0 / length(way)) : on_ground;
}

double full_turn(const std::string& crs) {
  const auto reference = known_reference(crs);
  return reference && reference->IsGeographic() != 0 ? 2.0 * pi / reference->GetAngularUnits() : 0.0;
}

double turn_of_x(const std::string& crs) {
  const double turn = full_turn(crs);
  const auto reference = known_reference(crs);
  if (turn > 0.0 || !reference || reference->IsProjected() == 0) return turn;
  return turn_of_projection(*reference);
}

double on_turn_of(double x, double other, double full_turn) {
  return full_turn > 0.0 ? x + full_turn * std::round((other - x) / full_turn) : x;
}

}  // namespace sigmascape::geo
