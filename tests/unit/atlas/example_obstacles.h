#pragma once

#include <cmath>
#include <cstdint>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/obstacle.h"

namespace sigmascape::atlas {

/// Columns −3 … 1 and rows −1 … 0 of patches of 512² texels of a metre, whose ground is kept apart: two levels a patch
/// and two above them.
inline AtlasDescription wide_ground_apart() {
  AtlasDescription description;
  description.name = "example";
  description.frame = {43.26, -2.93};
  description.patches = {1.0, 512};
  description.extent = {-3 * 512.0, -512.0, 2 * 512.0, 512.0};
  description.aspects = {{0.0}, {radians_from_deg(13.0)}, {10e9}};
  description.scene_hash = "0123abcd";
  description.settings = {{shadows_setting, shadows_at_run_time}};
  return description;
}

/// Two by two patches of 256² texels whose ground is kept apart, and one place above them.
inline AtlasDescription small_ground_apart() {
  AtlasDescription description = wide_ground_apart();
  description.patches = {1.0, 256};
  description.extent = {0.0, 0.0, 512.0, 512.0};
  return description;
}

/// A house in eleven texels of a hundred, trees in eleven others, each of its own height: no quarter of the patch looks
/// like another, and no patch like another.
inline radar::ObstacleMap example_obstacles(const Store& atlas, PatchIndex patch) {
  const radar::GroundGrid texels = atlas.description().patches.texels_of(patch);
  radar::ObstacleMap map{texels, Array2D<radar::Obstacle>(texels.columns, texels.rows)};
  for (std::size_t row = 0; row < texels.rows; ++row) {
    for (std::size_t column = 0; column < texels.columns; ++column) {
      const Vec2d centre = texels.centre_of(column, row);
      const std::uint64_t key = hashed(4711, static_cast<std::uint64_t>(std::llround(centre.x + 1e6)),
                                       static_cast<std::uint64_t>(std::llround(centre.y + 1e6)));
      const float chance = unit_float(mixed(key));
      radar::Obstacle& obstacle = map.obstacles(column, row);
      if (key % 100 < 11) obstacle.solid_top_m = 3.0F + 27.0F * chance;
      if (key % 100 < 89) continue;
      obstacle.crown_base_m = 2.0F + chance;
      obstacle.crown_top_m = 6.0F + 12.0F * chance;
      obstacle.crown_extinction_per_m = 0.05F + 0.5F * chance;
    }
  }
  return map;
}

inline void write_all_obstacles(const Store& atlas) {
  for (const PatchIndex& patch : atlas.description().patches.covering(atlas.description().extent)) {
    write_obstacles(atlas, patch, example_obstacles(atlas, patch));
  }
}

}  // namespace sigmascape::atlas
