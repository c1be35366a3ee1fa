#pragma once

#include <optional>
#include <string>

#include "sigmascape/base/vec.h"

namespace sigmascape::geo {

/// What a coordinate reference system counts its places in, as names end in it: "m", "deg", "ft", "us_ft", and "units"
/// for all else. A system that is not known, as made-up maps have, counts in metres.
[[nodiscard]] std::string axis_unit(const std::string& crs);

/// Metres to a unit of the vertical axis that a coordinate reference system has beside its two of places, as a compound
/// one does; nothing where it has none or is not known.
[[nodiscard]] std::optional<double> metres_per_vertical_unit(const std::string& crs);

/// Metres of ground to a unit of x at a place of the system: of a degree of longitude, or of a metre of a projection
/// that stretches. 1 where the system is not known. Throws Error when it does not reach there.
[[nodiscard]] double ground_metres_per_unit(const std::string& crs, Vec2d place);

/// Where a way along the ground goes in x and y of the system, a unit vector, that leaves a place at an azimuth
/// clockwise from true north. Straight at that azimuth where the system is not known. Throws Error when it does not
/// reach there.
[[nodiscard]] Vec2d way_at_azimuth(const std::string& crs, Vec2d place, double azimuth_rad);

/// 360° of longitude in the unit of x; 0 where x is no longitude.
[[nodiscard]] double full_turn(const std::string& crs);

/// How far 360° of longitude reach in x, where x grows evenly with longitude and with nothing else: where it is the
/// longitude, and in cylindrical projections about an upright axis, as Mercator's. 0 in all others.
[[nodiscard]] double turn_of_x(const std::string& crs);

/// The same longitude, counted by whole turns more or less so that it is nearest to another. With a turn of 0 it stays
/// what it is.
[[nodiscard]] double on_turn_of(double x, double other, double full_turn);

}  // namespace sigmascape::geo
