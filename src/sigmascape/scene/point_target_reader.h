#pragma once

#include <array>
#include <optional>
#include <string>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// A point target before its place in the frame is known.
struct PointTargetSource {
  PointTarget target;  ///< all but its position
  std::string where;   ///< the section, as errors name it
  std::optional<std::array<double, 2>> in_frame_m, lat_lon_deg;
};

/// Reads one [[point_targets]]. `rcs_dbsm` is one number for VV and HH, or a table with vv, hh and hv; `bounces =
/// "even"` gives VV and HH opposite phases, as a dihedral does.
[[nodiscard]] PointTargetSource read_point_target_source(const TomlSection& section);

/// Throws Error when the target lies outside the scene.
void add_point_target(Scene& scene, const PointTargetSource& source);

}  // namespace sigmascape::scene
