#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/geo/vector_source.h"
#include "sigmascape/scene/flaw_tally.h"
#include "sigmascape/scene/material_reader.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// Footprints in a file and how they are raised.
struct BuildingSource {
  geo::VectorSource vector;
  std::string where;  ///< the section, as errors name it
  std::optional<std::string> height_attribute, levels_attribute;
  double metres_per_plain_number = 1.0;  ///< of heights without a unit of their own
  double metres_per_level = 3.2;
  std::optional<double> default_height_m;  ///< of those without; when absent they are left out
  double min_area_m2 = 4.0;
  double simplify_m = 0.05;
  scatter::Material wall, roof;
  FlawLimit limit;
};

/// Reads one [[buildings]].
[[nodiscard]] BuildingSource read_building_source(const TomlSection& section, const MaterialTable& materials,
                                                  const FlawLimit& limit);

/// Reads the footprints of all files together, mends them, frees them of overlaps and raises them. Needs the scene's
/// extent and terrain. Throws Error for a negative height, an attribute that no feature has, or too many flaws.
void add_buildings(Scene& scene, const std::vector<BuildingSource>& sources);

}  // namespace sigmascape::scene
