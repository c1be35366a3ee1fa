#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command_parser.h"
#include "idle_options.h"
#include "map_files.h"

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::cli {

/// Which I/Q is to be written; an empty name asks for none.
struct IqFiles {
  std::string file;
  std::optional<double> interval_s;  ///< that of the radar's mode when absent (simulate::recording_interval_s)
  std::string unit = "m";
  std::string slant_image;
};

/// Returns those that are of --iq alone.
[[nodiscard]] std::vector<MannerOption> add_iq_options(Command command, IqFiles& files);

/// What the atlas, the scene's terrain and the radar make of it.
struct IqRequest {
  const atlas::Store* atlas = nullptr;
  const scene::Scene& scene;
  const std::vector<radar::Target>& targets;
  const radar::Radar& radar;
  const radar::Rectangle& area;
  int level_of_detail = 0;  ///< of the map beside them
  bool extrapolate = false;
  std::uint64_t seed = 1, dwell = 0;
  double moment_s = 0.0;  ///< as in simulate::CoherentSettings
  unsigned threads = 0;
  const Provenance& origin;  ///< what every file says of the scene and the moment
};

/// The frequency at which an atlas of these directions is asked for this radar: the radar's own or, when extrapolation
/// is wanted, the nearest that was baked.
[[nodiscard]] double texture_frequency_hz(const atlas::AspectGrid& aspects, const radar::Radar& radar,
                                          bool extrapolate);

/// Throws Error when pulses are asked for under a name that no kind of file has, or without an atlas.
void check(const IqFiles& files, bool has_atlas);

/// Throws Error when the radar cannot record what is asked for, or the atlas lacks its frequency: before a map is made
/// beside the pulses, which may take long. Says then on standard error what whoever records this should know.
void check(const IqFiles& files, const IqRequest& request);

/// What was recorded, for the summary.
struct RecordedPulses {
  std::string words;
  nlohmann::ordered_json numbers;
};

/// Writes the pulses that the radar records of the area, if they were asked for.
std::optional<RecordedPulses> write_iq_files(const IqFiles& files, const IqRequest& request);

}  // namespace sigmascape::cli
