#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "map_files.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::cli {

/// What a coherent mode is to map.
struct CoherentRequest {
  const scene::Scene& scene;
  const atlas::Atlas& atlas;
  const radar::Radar& radar;          ///< placed
  double texture_frequency_hz = 0.0;  ///< one that was baked
  const radar::GroundGrid& grid;
  int level_of_detail = 1;
  const std::vector<radar::Target>& targets;
  std::uint64_t seed = 1, dwell = 0;
  double moment_s = 0.0;  ///< as in simulate::CoherentSettings
  unsigned threads = 0;
  const Provenance& origin;     ///< what every file says of the scene and the moment
  std::string slant_file = {};  ///< for the complex image in slant geometry, of one look; none when empty
};

struct CoherentMap {
  radar::GroundMap map;  ///< not yet described
  double seconds = 0.0;
  nlohmann::ordered_json cost = {};
  Provenance provenance = {};
};

/// The map of the radar's mode, doppler-beam-sharpening, spotlight or stripmap, on the ground. Says on standard error
/// what `radar::plan_warnings` finds.
[[nodiscard]] CoherentMap coherent_map(const CoherentRequest& request);

}  // namespace sigmascape::cli
