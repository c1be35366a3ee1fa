#include "sigmascape/simulate/map_provenance.h"

#include <fmt/format.h>

namespace sigmascape::simulate {

std::map<std::string, std::string> provenance_of_traced(const TraceSettings& settings, const scene::Scene& scene,
                                                        std::size_t targets_seen) {
  return {{"processing", "level of detail 0: path-traced"},
          {"seed", std::to_string(settings.seed)},
          {"dwell", std::to_string(settings.dwell)},
          {"samples_per_cell", std::to_string(settings.samples_per_cell)},
          {"bounces", std::to_string(settings.max_bounces)},
          {"targets", std::to_string(scene.point_targets.size() + settings.targets.size())},
          {"targets_seen", std::to_string(targets_seen)}};
}

std::map<std::string, std::string> provenance_of_baked(const atlas::AtlasDescription& atlas, const radar::Radar& radar,
                                                       const render::RenderSettings& settings, std::uint64_t seed,
                                                       std::uint64_t dwell, std::size_t targets_seen) {
  std::map<std::string, std::string> words{
      {"processing", fmt::format("level of detail {}: from terrain and atlas", settings.level_of_detail)},
      {"seed", std::to_string(seed)},
      {"dwell", std::to_string(dwell)},
      {"targets", std::to_string(settings.targets.size())},
      {"targets_seen", std::to_string(targets_seen)}};
  tell_of_textures(atlas, radar, settings.texture_frequency_hz.value_or(radar.frequency_hz), words);
  return words;
}

void tell_of_textures(const atlas::AtlasDescription& atlas, const radar::Radar& radar, double texture_frequency_hz,
                      std::map<std::string, std::string>& words) {
  if (const auto seed = atlas.settings.find("seed"); seed != atlas.settings.end()) words["atlas_seed"] = seed->second;
  tell_of_frequency(radar, texture_frequency_hz, words);
}

void tell_of_frequency(const radar::Radar& radar, double texture_frequency_hz,
                       std::map<std::string, std::string>& words) {
  if (texture_frequency_hz != radar.frequency_hz)
    words["texture_frequency_hz"] = fmt::format("{:.0f}", texture_frequency_hz);
}

}  // namespace sigmascape::simulate
