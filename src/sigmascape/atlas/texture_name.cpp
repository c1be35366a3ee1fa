#include "sigmascape/atlas/texture_name.h"

#include <fmt/format.h>

#include "sigmascape/base/units.h"

namespace sigmascape::atlas {

std::string patch_name(PatchIndex patch) {
  return fmt::format("patch_{:+04d}_{:+04d}", patch.x, patch.y);
}

std::string look_name(const radar::Look& look) {
  return fmt::format("az{:05.1f}_el{:04.1f}_f{:06.3f}GHz", deg_from_radians(look.aspect.azimuth_rad),
                     deg_from_radians(look.aspect.elevation_rad), look.frequency_hz / 1e9);
}

}  // namespace sigmascape::atlas
