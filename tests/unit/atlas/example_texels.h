#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sigmascape/atlas/store.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::atlas {

/// A made-up patch with the spread of real ones: dim ground of exponential power, a few walls 40 dB brighter, shadows
/// of nothing.
inline Array2D<radar::Channels> example_texels(std::size_t side, std::uint64_t seed) {
  Array2D<radar::Channels> texels(side, side);
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      const std::uint64_t key = hashed(seed, row, column);
      if (key % 17 == 0) continue;
      const float wall = key % 101 == 0 ? 1e4F : 1.0F;
      const float power = -0.02F * wall * std::log(1.0F - unit_float(mixed(key)));
      texels(column, row) = {power, 0.8F * power, 0.1F * power, (key % 5 == 0 ? -0.5F : 0.7F) * power};
    }
  }
  return texels;
}

/// Two patches side by side, four looks.
inline AtlasDescription example_description() {
  AtlasDescription description;
  description.name = "example";
  description.frame = {43.26, -2.93};
  description.extent = {-512.0, 0.0, 512.0, 512.0};
  description.patches = {1.0, 512};
  description.aspects = {{0.0, radians_from_deg(135.0)}, {radians_from_deg(5.0), radians_from_deg(13.0)}, {10e9}};
  description.scene_hash = "0123abcd";
  description.settings = {{"samples", "64"}, {"seed", "7"}};
  description.attribution = "made up";
  return description;
}

}  // namespace sigmascape::atlas
