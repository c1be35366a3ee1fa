#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/target.h"

namespace sigmascape::radar {

/// A place on the Earth, in degrees as files state it.
struct LatitudeLongitude {
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

/// Where a target is at a moment, before terrain and frame are known.
struct TargetPlace {
  double time_s = 0.0;
  std::variant<Vec2d, LatitudeLongitude> place;  ///< local frame, or on the Earth
  double height_m = 0.0;                         ///< of its phase centre
  bool above_ground = true;                      ///< rather than above mean sea level
};

/// A target of a file: all but its track.
struct TargetSource {
  Target target;
  std::vector<TargetPlace> places;  ///< one with a velocity, or way-points in the order of time
  Vec3d velocity_mps = {};
  std::string where;  ///< file and place in it, for errors
};

/// Reads a targets file; docs/target_file.md lists its keys. Throws Error, naming file and key, for what is missing,
/// unknown or out of range. `simulate::placed_targets` puts them onto the terrain.
[[nodiscard]] std::vector<TargetSource> read_target_file(const std::filesystem::path& path);

}  // namespace sigmascape::radar
