#pragma once

#include <map>
#include <optional>
#include <string>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/geo/vector_source.h"
#include "sigmascape/scene/flaw_tally.h"
#include "sigmascape/scene/land_cover_reader.h"
#include "sigmascape/scene/material_reader.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/scene/traffic.h"

namespace sigmascape::scene {

/// Road centre lines in a file, how wide they are paved and what drives on them.
struct RoadSource {
  geo::VectorSource vector;
  std::string where;  ///< the section, as errors name it
  std::optional<std::string> width_attribute, class_attribute;
  double metres_per_plain_number = 1.0;  ///< of widths without a unit of their own
  std::map<std::string, double> width_m_by_class;
  std::map<std::string, double> carriageway_m_by_class;  ///< of those whose lines of one way are half a road
  std::optional<double> width_m;                         ///< of those without; when absent they are left out
  scatter::Material paving;
  std::optional<Traffic> traffic;
  FlawLimit limit;
};

/// Reads one [[roads]].
[[nodiscard]] RoadSource read_road_source(const TomlSection& section, const MaterialTable& materials,
                                          const FlawLimit& limit);

/// Paints roads into the material map, except over water, and sets vehicles on them.
void add_roads(Scene& scene, const RoadSource& source, const WaterMask& water);

}  // namespace sigmascape::scene
