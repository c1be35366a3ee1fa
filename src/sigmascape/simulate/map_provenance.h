#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/render/ground_renderer.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::simulate {

/// What a file says of how its map was made, for others to make it again: the way, seeds, rays, and how many targets
/// there are, those of the scene and others, and how many of them it shows (TargetsSeen). Radar and place are told by
/// others.
[[nodiscard]] std::map<std::string, std::string> provenance_of_traced(const TraceSettings& settings,
                                                                      const scene::Scene& scene,
                                                                      std::size_t targets_seen);

/// The same of a real-beam map from an atlas; with the textures' frequency where the radar has another.
[[nodiscard]] std::map<std::string, std::string> provenance_of_baked(const atlas::AtlasDescription& atlas,
                                                                     const radar::Radar& radar,
                                                                     const render::RenderSettings& settings,
                                                                     std::uint64_t seed, std::uint64_t dwell,
                                                                     std::size_t targets_seen);

/// Adds the seed of the bake, where it is known, and the frequency of the textures where it is not the radar's own.
void tell_of_textures(const atlas::AtlasDescription& atlas, const radar::Radar& radar, double texture_frequency_hz,
                      std::map<std::string, std::string>& words);

/// The latter alone.
void tell_of_frequency(const radar::Radar& radar, double texture_frequency_hz,
                       std::map<std::string, std::string>& words);

}  // namespace sigmascape::simulate
