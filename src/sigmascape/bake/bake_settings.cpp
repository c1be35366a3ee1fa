#include "sigmascape/bake/bake_settings.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::bake {

namespace {

/// Side of a patch at most. What lies farther from the origin of a local frame than a few of them has no place in it.
constexpr double longest_patch_m = 1e6;

void check(const Sampling& sampling, const std::string& where) {
  if (!sampling.is_adaptive()) {
    if (sampling.samples_per_texel >= 2 && sampling.samples_per_texel <= most_samples_a_cell) return;
    throw Error(where, fmt::format("{} samples a texel", sampling.samples_per_texel),
                fmt::format("use 2 to {}", most_samples_a_cell));
  }
  if (!(sampling.target_db >= least_target_db && sampling.target_db <= most_target_db)) {
    throw Error(where, fmt::format("a target of {:g} dB", sampling.target_db),
                fmt::format("use {:g} to {:g}", least_target_db, most_target_db));
  }
  if (!(sampling.floor_db >= -120.0 && sampling.floor_db <= 60.0)) {
    throw Error(where, fmt::format("a floor of {:g} dB", sampling.floor_db), "use -120 to 60");
  }
  if (sampling.most_samples < pilot_samples || sampling.most_samples > most_samples_a_cell) {
    throw Error(where, fmt::format("at most {} samples a texel", sampling.most_samples),
                fmt::format("use {} to {}", pilot_samples, most_samples_a_cell));
  }
}

}  // namespace

trace::Footing footing_of(const BakeSettings& settings) {
  return settings.shadows == Shadows::Baked ? trace::Footing::LevelPlane : settings.footing;
}

void check(const BakeSettings& settings) {
  const std::string where = "bake settings";
  check(settings.sampling, where);
  if (settings.max_bounces < 1 || settings.max_bounces > 64) {
    throw Error(where, fmt::format("{} bounces", settings.max_bounces), "use 1 to 64");
  }
  if (!(settings.patches.texel_m >= smallest_texel_m)) {
    throw Error(where, fmt::format("texels of {:g} m", settings.patches.texel_m),
                fmt::format("use texels of {:g} m or more: of smaller ones the sums of what comes back are too coarse",
                            smallest_texel_m));
  }
  if (!(settings.patches.side_m() <= longest_patch_m)) {
    throw Error(where,
                fmt::format("texels of {:g} m make patches of {:g} km", settings.patches.texel_m,
                            settings.patches.side_m() / 1000.0),
                fmt::format("use texels of {:g} m or less",
                            longest_patch_m / static_cast<double>(settings.patches.texels_per_side)));
  }
  if (settings.buildings != Buildings::Baked &&
      (settings.shadows == Shadows::Baked || settings.footing == trace::Footing::LevelPlane)) {
    throw Error(where,
                "buildings are to be kept apart from textures whose shadows are baked, or that stand on level ground",
                "leave shadows to run time and let objects stand on their own terrain, or bake the buildings");
  }
  const auto& elevations = settings.aspects.elevations_rad;
  if (const auto twice = std::ranges::adjacent_find(elevations); twice != elevations.end()) {
    throw Error(where, fmt::format("an elevation of {:.2f}° is given twice", deg_from_radians(*twice)),
                "give each once");
  }
  for (const double elevation : elevations) {
    const double degrees = deg_from_radians(elevation);
    if (!(degrees >= lowest_elevation_deg && degrees <= highest_elevation_deg)) {
      throw Error(where, fmt::format("an elevation of {:.2f}°", degrees),
                  fmt::format("use {:g}° to {:g}°: a level plane is not lit at 0° and has no ground range at 90°",
                              lowest_elevation_deg, highest_elevation_deg));
    }
  }
  atlas::check(settings.patches, where);
  atlas::check(settings.aspects, where);
}

}  // namespace sigmascape::bake
