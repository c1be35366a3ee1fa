#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/radar/coherent_plan.h"
#include "sigmascape/radar/slant_image.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape::simulate {

/// What a coherent mode is to map. All must outlive the call.
struct ModeRequest {
  const atlas::Atlas& atlas;
  const terrain::HeightField& terrain;
  const radar::Radar& radar;  ///< placed
  const radar::GroundGrid& grid;
  double texture_frequency_hz = 0.0;  ///< at which the atlas is asked
  std::span<const radar::Target> targets = {};
  Windblown windblown = {};  ///< where leaves move, see CoherentScene
  int level_of_detail = 1;
  std::uint64_t seed = 1;
  std::uint64_t dwell = 0;  ///< as in CoherentSettings
  double moment_s = 0.0;    ///< likewise
  unsigned threads = 0;
};

/// What the radar's mode needs to map an area, and what it thinks of that: `plan` fills in what the radar leaves open.
struct ModePlan {
  radar::CoherentPlan plan;
  std::vector<std::string> warnings;  ///< sentences for the user
  std::size_t targets_seen = 0;       ///< TargetsSeen::count of the map
};

/// Throws Error as coherent_plan does.
[[nodiscard]] ModePlan mode_plan(const ModeRequest& request);

/// A map with the ground around it that answers in its outermost cells: what the image of the radar's mode is made of.
/// The map lies at that height.
[[nodiscard]] radar::Rectangle answering_area(const radar::Radar& radar, const radar::CoherentPlan& plan,
                                              const radar::Rectangle& map, double height_m);

/// In slant range and Doppler, or along the track for stripmap: amplitudes in metres.
using ModeImage = std::variant<radar::RangeDopplerImage, radar::StripmapImage>;

/// The image of the radar's mode, doppler-beam-sharpening, spotlight or stripmap, that covers the grid and what answers
/// in its outermost cells, look after look. Throws Error when the atlas was not baked at the frequency at which it is
/// asked.
void mode_looks(const ModeRequest& request, const radar::CoherentPlan& plan,
                const std::function<void(const ModeImage&)>& visit);
/// The same as one look of all pulses.
[[nodiscard]] ModeImage mode_image(const ModeRequest& request, const radar::CoherentPlan& plan);

/// Where what is made of the request comes from, in words that go for its map and for its complex image alike:
/// processing, mode, side of the course, what was left in, wind, targets, seed, dwell.
[[nodiscard]] std::map<std::string, std::string> source_of(const ModeRequest& request, const ModePlan& planned);

/// What the plan comes to in the complex image, which is one look of all pulses and sharper than the map of several by
/// their number: interval, looks, half-power width across range, angle off the course; units in the names.
[[nodiscard]] std::map<std::string, double> numbers_of_one_look(const radar::CoherentPlan& plan);

/// Where a map of it comes from: the source, and interval, looks, resolution and angle off the course of the finished
/// map; of one that keeps the antenna's pattern also where the beam points, unless that passes over every place.
[[nodiscard]] std::map<std::string, std::string> provenance_of(const ModeRequest& request, const ModePlan& planned);

}  // namespace sigmascape::simulate
