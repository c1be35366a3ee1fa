#pragma once

#include <optional>
#include <string>

#include "sigmascape/geo/local_frame.h"
#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/layer_stack.h"
#include "sigmascape/radar/power_map.h"

namespace sigmascape::product {

/// The same map, north up, in another coordinate system: "EPSG:25830", a PROJ string or WKT.
///
/// Cells are squares of `cell` units of that system; by default as large as those of the map, in degrees where the
/// system counts in them. σ0 is bilinear between the map's cells, in linear power, and NaN beyond them. The metadata
/// keep what they say of the radar in the local frame, and name that as `local_frame`. Throws Error when the system is
/// not understood or does not reach there.
[[nodiscard]] radar::GroundMap reprojected(const radar::GroundMap& map, const geo::LocalFrame& frame,
                                           const std::string& crs, std::optional<double> cell = {});

/// The cells that such a map has of one of these, to know beforehand. Throws Error likewise.
[[nodiscard]] radar::GroundGrid reprojected(const radar::GroundGrid& grid, const geo::LocalFrame& frame,
                                            const std::string& crs, std::optional<double> cell = {});

/// The same for layers; classes and masks are those of the nearest cell.
[[nodiscard]] radar::LayerStack reprojected(const radar::LayerStack& stack, const geo::LocalFrame& frame,
                                            const std::string& crs, std::optional<double> cell = {});

/// The same for power.
[[nodiscard]] radar::PowerMap reprojected(const radar::PowerMap& map, const geo::LocalFrame& frame,
                                          const std::string& crs, std::optional<double> cell = {});

}  // namespace sigmascape::product
