#pragma once

#include <map>
#include <string>
#include <vector>

#include "command_parser.h"

#include "sigmascape/radar/obstacle.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::cli {

/// What `render --layers` asks for.
struct LayerFiles {
  std::vector<std::string> names;
  std::string file;
};

void add_layer_options(Command command, LayerFiles& files);

/// Throws Error when a layer is not known or not to be had of so few bounces, or when file or names are missing.
void check(const LayerFiles& files, int max_bounces);

/// Throws Error when a layer is not to be had at this level of detail or in this mode.
void check(const LayerFiles& files, int level_of_detail, radar::Mode mode);

/// Where layers come from: rays over the full scene, or with an atlas what levels of detail from 1 on know. Behind the
/// boxes of the trace's targets the radar sees nothing, in either.
struct LayerSource {
  std::string atlas = {};
  /// What stood on the ground when the map was made, where the atlas knows; else the scene tells, on the map's cells.
  const radar::ObstacleMap* obstacles = nullptr;
  simulate::TraceSettings trace = {};
};

/// Writes the layers asked for, if any, over the cells of the map: in its coordinate system, the scene's frame where
/// `crs` is empty. `metadata` goes with them. Those that tell bounces apart are of the radar's polarization.
void write_layers(const LayerFiles& files, const scene::Scene& scene, const radar::Radar& radar,
                  const radar::GroundGrid& grid, const std::string& crs,
                  const std::map<std::string, std::string>& metadata, const LayerSource& source);

}  // namespace sigmascape::cli
