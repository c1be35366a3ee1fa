#include "sigmascape/bake/bake_settings.h"

#include <fmt/format.h>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::bake {

void check(const BakeSettings& settings) {
  const std::string where = "bake settings";
  if (settings.samples_per_texel < 2 || settings.samples_per_texel > (1U << 24U)) {
    throw Error(where, fmt::format("{} samples a texel", settings.samples_per_texel), "use 2 to 16777216");
  }
  if (settings.max_bounces < 1 || settings.max_bounces > 64) {
    throw Error(where, fmt::format("{} bounces", settings.max_bounces), "use 1 to 64");
  }
  for (const double elevation : settings.aspects.elevations_rad) {
    const double degrees = deg_from_radians(elevation);
    if (!(degrees >= 0.5 && degrees <= 89.0)) {
      throw Error(where, fmt::format("an elevation of {:.2f}°", degrees),
                  "use 0.5° to 89°: a level plane is not lit at 0° and has no ground range at 90°");
    }
  }
}

}  // namespace sigmascape::bake
