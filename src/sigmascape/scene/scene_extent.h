#pragma once

#include <optional>
#include <string>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/raster.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::scene {

/// A piece of the globe between two meridians and two parallels.
struct GeographicBox {
  double west_deg = 0.0, south_deg = 0.0, east_deg = 0.0, north_deg = 0.0;

  [[nodiscard]] geo::GeographicPosition centre() const {
    return {(south_deg + north_deg) / 2.0, (west_deg + east_deg) / 2.0};
  }
};

/// Where a scene lies, as its file states it.
struct ScenePlace {
  std::string where;  ///< the section, for messages
  std::optional<geo::GeographicPosition> origin;
  std::optional<radar::Rectangle> extent_m;
  std::optional<GeographicBox> extent_deg;
};

/// Reads origin_lat_deg, origin_lon_deg and extent of [scene].
[[nodiscard]] ScenePlace read_scene_place(const TomlSection& section);

/// The scene's frame: about the stated origin, else the middle of a stated box in degrees, else the middle of the
/// terrain. Throws Error when the middle of what is then the scene lies so far from the origin that the frame is out of
/// scale there.
[[nodiscard]] geo::LocalFrame frame_of(const ScenePlace& place, const geo::RasterBand& terrain);

/// The stated extent in the frame; of a box in degrees, the rectangle about its four sides' middles. Nothing when none
/// is stated.
[[nodiscard]] std::optional<radar::Rectangle> extent_in(const ScenePlace& place, const geo::LocalFrame& frame);

}  // namespace sigmascape::scene
