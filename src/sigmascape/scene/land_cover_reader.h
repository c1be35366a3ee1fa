#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/geo/raster.h"
#include "sigmascape/scene/flaw_tally.h"
#include "sigmascape/scene/material_reader.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// What lies on the ground by itself because the scene has it as objects.
struct ExplicitObjects {
  bool trees = false;
  bool buildings = false;
};

/// Where the ground's materials come from.
struct LandCoverSource {
  std::string where{};                    ///< the section, as errors name it
  std::optional<geo::RasterBand> raster;  ///< without one, all ground is of the nodata material
  std::optional<double> cell_m;           ///< by default the raster's own cell, or the terrain's spacing
  std::map<std::int32_t, scatter::Material> materials;
  scatter::Material nodata;
  std::set<std::int32_t> built_in;  ///< classes beside a table of the file's own that it does not list
  std::vector<std::int32_t> water_classes;
  FlawLimit limit;
};

/// Reads [land_cover]. Classes of ESA WorldCover are built in; under [land_cover.classes] any code may be given a
/// material.
[[nodiscard]] LandCoverSource read_land_cover_source(const TomlSection& section, const MaterialTable& materials,
                                                     ExplicitObjects objects, const FlawLimit& limit);
/// Grass everywhere: the ground of a scene file without [land_cover].
[[nodiscard]] LandCoverSource default_land_cover(const MaterialTable& materials);

/// Which cells of the scene's material map are of a water class.
using WaterMask = Array2D<std::uint8_t>;

/// Fills the scene's material map over its extent, which its terrain must have given it, and returns where the water
/// is. Throws Error when the raster and the extent do not overlap, its band is a colour of a picture, or the stated
/// cells are larger than the extent.
[[nodiscard]] WaterMask add_land_cover(Scene& scene, const LandCoverSource& source);

/// Whether a point stands in water.
[[nodiscard]] bool in_water(const radar::GroundGrid& grid, const WaterMask& water, Vec2d point);

}  // namespace sigmascape::scene
